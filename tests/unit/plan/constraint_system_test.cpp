// The systems of implicit constraints that plans build, against J W J^T + compliance from Eigen.

#include "taut/plan/implicit_constraints.hpp"

#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/devices.hpp"
#include "support/hinge_net.hpp"
#include "support/scenes.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/reals.hpp"
#include "taut/plan/plan.hpp"

#include <Eigen/SparseCore>
#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>

using namespace taut;

namespace {

using EigenRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
constexpr double kStep = 1.0 / 240;

/// A real mesh, a metre tall, its uppermost vertices held; every edge a row.
std::optional<Scene> real_scene(double bending)
{
    const auto path = find_data("meshes/cactus.off");
    if (!path)
        return {};
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.shape.file = *path;
    body.material.stretch_stiffness = 500;
    body.material.bending_stiffness = bending;
    scene.bodies = {body};
    scene = resolve(scene);
    std::vector<glm::dvec3>& x = scene.bodies[0].mesh.positions;
    double low = x[0].y, high = x[0].y;
    for (const glm::dvec3& p : x)
    {
        low = std::min(low, p.y);
        high = std::max(high, p.y);
    }
    Pin pin;
    for (std::uint32_t v = 0; v < x.size(); ++v)
        if (x[v].y > high - 0.1 * (high - low))
            pin.vertices.push_back(v);
    for (glm::dvec3& p : x)
        p /= high - low;
    scene.bodies[0].pins = {pin};
    scene.timestep = kStep;
    scene.method.type = MethodKind::implicit_constraints;
    scene.method.substeps = 1;
    scene.method.precision = Precision::float64;
    scene.method.linear_iterations = 3000;
    scene.method.linear_tolerance = 1e-9;
    return scene;
}

/// J W J^T + compliance / h^2 at the start of the scene, by definition.
EigenRows system_of(const Scene& scene)
{
    const DeviceTraits traits; // the builder keeps references
    const PlanOptions plan_options;
    PlanBuilder b(scene, traits, plan_options);
    const auto springs = all_springs(b);
    const auto compliances = row_compliances(b, springs);
    const CornerSet set = corner_set(b);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> soft;
    const auto put = [&](std::uint32_t v, const glm::dvec3& g) {
        for (int k = 0; k < 3; ++k)
            entries.emplace_back(int(soft.size()), int(3 * v) + k, g[k]);
    };
    for (std::size_t r = 0; r < springs.size(); ++r)
    {
        const glm::dvec3 n = glm::normalize(b.start[springs[r].a] - b.start[springs[r].b]);
        put(springs[r].a, n);
        put(springs[r].b, -n);
        soft.push_back(compliances[r] / (kStep * kStep));
    }
    for (const BendElement& e : set.hinges)
    {
        const auto vertex = corners_of(e);
        conformance::HingeCorners x;
        for (std::size_t v = 0; v < 4; ++v)
            x[v] = b.start[vertex[v]];
        const auto angle = conformance::dual_angle(x);
        const auto& g = angle.slope;
        for (std::size_t v = 0; v < 4; ++v)
            put(vertex[v], double(set.scale) * glm::dvec3(g[3 * v], g[3 * v + 1], g[3 * v + 2]));
        soft.push_back(e.compliance / (kStep * kStep));
    }
    const int rows = int(soft.size()), columns = 3 * int(b.plan.vertex_count);
    EigenRows j(rows, columns), w(columns, columns), c(rows, rows);
    j.setFromTriplets(entries.begin(), entries.end());
    w.setIdentity();
    c.setIdentity();
    for (int k = 0; k < columns; ++k)
        w.coeffRef(k, k) = b.inverse_mass[std::size_t(k / 3)];
    for (int k = 0; k < rows; ++k)
        c.coeffRef(k, k) = soft[std::size_t(k)];
    EigenRows a = j * w * EigenRows(j.transpose());
    return a + c;
}

/// The matrix that the plan's pass filled, in the pattern that the plan gave it.
linear::SparseMatrix pattern_of(const Scene& scene)
{
    const DeviceTraits traits; // the builder keeps references
    const PlanOptions plan_options;
    PlanBuilder b(scene, traits, plan_options);
    const auto springs = all_springs(b);
    const Incidence at = incidence_of(b.plan.vertex_count, springs);
    const std::vector<std::uint32_t> corners = corner_set(b).corners();
    if (corners.empty())
        return constraint_pattern(springs, at, b.inverse_mass);
    return constraint_terms(springs, at, corners, incidence_of(b.plan.vertex_count, corners, 4),
                            b.inverse_mass)
        .pattern;
}

/// One step of a plan, without a world.
struct Stepped
{
    Plan plan;
    std::shared_ptr<Device> device;
    std::vector<BufferPtr> buffers;

    Stepped(const Scene& scene, const std::string& selector)
        : plan(make_plan(scene)),
          device(test_device(selector))
    {
        for (const PlanBuffer& buffer : plan.buffers)
        {
            buffers.push_back(device->make_buffer(buffer.bytes, buffer.name));
            if (!buffer.initial.empty())
                device->write(buffers.back(), 0, buffer.initial);
        }
        layout::StepValues<double> values{};
        values.substep = kStep;
        values.inverse_substep = 1 / kStep;
        values.gravity_y = -9.81;
        values.damping_factor = 1;
        values.max_speed = 1e9;
        device->write(buffers[plan.step_values], 0, std::as_bytes(std::span(&values, 1)));
        device->compile({buffers, plan.passes, plan.barrier_before})->replay();
    }
    std::vector<double> read(const std::string& name, std::size_t count) const
    {
        for (std::size_t k = 0; k < plan.buffers.size(); ++k)
            if (plan.buffers[k].name == name)
                return linear::read_reals(*device, buffers[k], std::uint32_t(count), plan.precision);
        FAIL("no buffer \"" << name << "\"");
        return {};
    }
};

} // namespace

TEST_CASE("the matrix of constraints on a real mesh is Eigen's J W J^T", "[constraint_system]")
{
    const double bending = GENERATE(0.0, 1e-4);
    std::optional<Scene> scene = real_scene(bending);
    if (!scene)
        return;
    scene->method.linear_operator = LinearOperator::assembled;
    const EigenRows exact = system_of(*scene);
    const linear::SparseMatrix pattern = pattern_of(*scene);
    REQUIRE(int(pattern.rows) == exact.rows());
    REQUIRE(pattern.rows > 1000);
    for (const std::string& selector : test_devices())
    {
        CAPTURE(bending, selector);
        const Stepped step(*scene, selector);
        const linear::UploadOptions options{linear::Format::csr, Precision::float64, false, 0, false, true};
        const auto slots = linear::DeviceMatrix::upload(step.device, pattern, options)->slots(pattern);
        const auto values = step.read("matrix values", *std::max_element(slots.begin(), slots.end()) + 1u);
        EigenRows found(int(pattern.rows), int(pattern.rows));
        std::vector<Eigen::Triplet<double>> entries;
        for (std::uint32_t r = 0; r < pattern.rows; ++r)
            for (std::uint32_t k = pattern.row_start[r]; k < pattern.row_start[r + 1]; ++k)
                entries.emplace_back(int(r), int(pattern.column[k]), values[slots[k]]);
        found.setFromTriplets(entries.begin(), entries.end());
        CHECK(EigenRows(found - exact).norm() < 1e-12 * exact.norm());
        CHECK(EigenRows(found - exact).coeffs().abs().maxCoeff() < 1e-12 * exact.coeffs().abs().maxCoeff());
        CHECK(EigenRows(found - EigenRows(found.transpose())).norm() < 1e-13 * found.norm());
    }
}

TEST_CASE("what constraints on a real mesh are solved to solves Eigen's system, with a matrix and without",
          "[constraint_system]")
{
    const double bending = GENERATE(0.0, 1e-4);
    const std::string linear_operator = GENERATE("assembled", "matrix_free");
    std::optional<Scene> scene = real_scene(bending);
    if (!scene)
        return;
    scene->method.linear_operator = option_named<LinearOperator>(linear_operator);
    const EigenRows exact = system_of(*scene);
    for (const std::string& selector : test_devices())
    {
        CAPTURE(bending, linear_operator, selector);
        const Stepped step(*scene, selector);
        const auto rows = std::size_t(exact.rows());
        const auto x = step.read("cg solution", rows), b = step.read("cg b", rows);
        const Eigen::Map<const Eigen::VectorXd> solution(x.data(), exact.rows());
        const Eigen::Map<const Eigen::VectorXd> right(b.data(), exact.rows());
        CHECK(right.norm() > 0);
        CHECK((right - exact * solution).norm() < 2e-9 * right.norm());
    }
}
