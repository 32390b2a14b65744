// Matrices read back from a plan's buffers (tests/support/plan_matrix.hpp), against what is known of them.

#include "support/plan_matrix.hpp"

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Scene with_method(Scene scene, const char* type)
{
    scene.timestep = 1.0 / 60;
    scene.method = {};
    scene.method.type = option_named<MethodKind>(type);
    scene.method.precision = Precision::float64;
    scene.method.substeps = 1;
    return scene;
}

/// Stretched by a tenth along x, so that springs pull.
Scene stretched_cloth(std::uint32_t n)
{
    Scene scene = with_method(free_cloth(n), "implicit_euler");
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x.x *= 1.1;
    return scene;
}

/// kg: every vertex has a third of each of its triangles.
std::vector<double> thirds_of_triangles(const Body& body)
{
    std::vector<double> mass(body.mesh.positions.size(), 0);
    for (const auto& triangle : body.mesh.triangles)
    {
        const auto& x = body.mesh.positions;
        const glm::dvec3 twice = glm::cross(x[triangle[1]] - x[triangle[0]], x[triangle[2]] - x[triangle[0]]);
        for (const std::uint32_t v : triangle)
            mass[v] += body.material.density * glm::length(twice) / 6;
    }
    return mass;
}

/// Four masses of half a kilogram a metre apart in a line, the first held, joined by rigid rods.
Scene chain()
{
    Body body = particles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, 0.5);
    body.springs = {{0, 1, 1.0, 0.0}, {1, 2, 1.0, 0.0}, {2, 3, 1.0, 0.0}};
    body.pins = {hold({0})};
    return with_method(alone(body), "implicit_constraints");
}

} // namespace

TEST_CASE("the matrix of implicit Euler is symmetric, and a translation feels the mass alone",
          "[plan_matrix]")
{
    const Scene scene = stretched_cloth(8);
    const linear::SparseMatrix a = test::matrix_of(scene, 2);
    REQUIRE(a.rows == 3 * 81);
    std::vector<double> dense(std::size_t{a.rows} * a.rows, 0);
    for (const linear::Triplet& entry : linear::to_triplets(a))
        dense[std::size_t{entry.row} * a.rows + entry.column] = entry.value;
    const double size = *std::max_element(dense.begin(), dense.end());
    double apart = 0;
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t j = 0; j < i; ++j)
            apart = std::max(
                apart, std::abs(dense[std::size_t{i} * a.rows + j] - dense[std::size_t{j} * a.rows + i]));
    CHECK(apart <= 1e-14 * size);

    std::vector<double> up(a.rows, 0), moved(a.rows);
    for (std::uint32_t v = 0; v < 81; ++v)
        up[3 * v + 1] = 1;
    linear::multiply(a, up, moved);
    const std::vector<double> mass = thirds_of_triangles(scene.bodies[0]);
    const double unit = moved[1] / mass[0]; // the matrix is stored times a power of two
    CHECK(std::exp2(std::round(std::log2(unit))) == Approx(unit).epsilon(1e-12));
    for (std::uint32_t v = 0; v < 81; ++v)
    {
        CHECK(std::abs(moved[3 * v]) < 1e-12 * size);
        CHECK(std::abs(moved[3 * v + 1] - unit * mass[v]) < 1e-12 * size);
        CHECK(std::abs(moved[3 * v + 2]) < 1e-12 * size);
    }
}

TEST_CASE("held vertices are left out of the matrix", "[plan_matrix]")
{
    CHECK(test::matrix_of(with_method(test::hanging(8), "implicit_euler"), 1).rows == 3 * (81 - 2));
}

TEST_CASE("the matrix of rigid rods in a line is known", "[plan_matrix]")
{
    const linear::SparseMatrix a = test::matrix_of(chain(), 1);
    const std::vector<std::uint32_t> columns = {0, 1, 0, 1, 2, 1, 2};
    const double values[] = {2, -2, -2, 4, -2, -2, 4}; // sums of inverse masses; the shared vertex's
    REQUIRE(a.column == columns);
    for (std::size_t k = 0; k < columns.size(); ++k)
        CHECK(a.value[k] == Approx(values[k]).epsilon(1e-12));
}

TEST_CASE("a plan that stores no matrix is refused in words", "[plan_matrix]")
{
    Scene scene = with_method(test::hanging(2), "implicit_euler");
    scene.method.linear_operator = LinearOperator::matrix_free;
    CHECK_THROWS_WITH(test::matrix_of(scene, 1), Contains("stores no matrix"));
}
