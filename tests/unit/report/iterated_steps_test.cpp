#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/report/iterated_steps.hpp"
#include "taut/report/rigid_coarse.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <glm/geometric.hpp>

#include <cmath>
#include <random>

using namespace taut;
using reference::BlockMatrix;
using reference::Columns;
using reference::Curvature;
using reference::StaticEnergy;

namespace {

using Motion = std::vector<glm::dvec3>;

/// Folded and pulled about: springs in tension and slack, and a few noisy forces in each direction.
struct Case
{
    PhysicalModel model;
    Motion x, noise, weight;
    Leftover left;

    Case(const Scene& scene, double time) : model(make_model(scene))
    {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> any(-1, 1);
        for (const glm::dvec3& p : model.start)
            x.push_back(p + glm::dvec3(0.002 * any(random), 0.002 * any(random), 0.03 * std::sin(40 * p.x)));
        for (const double mass : model.mass)
        {
            const double load = mass * glm::length(model.gravity);
            noise.push_back(100 * load * glm::dvec3(any(random), any(random), any(random)));
            weight.push_back(mass * model.gravity);
            left.load.push_back(load);
        }
        left.touches.assign(x.size(), false);
        left.time = time;
    }

    double moved(const Motion& d) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < d.size(); ++i)
            sum += model.pinned[i] ? 0 : model.mass[i] * glm::length(d[i]);
        return sum;
    }

    /// By factoring, touching vertices left out as the pinned ones are.
    Motion exact(const Motion& force) const
    {
        PhysicalModel held = model;
        for (std::size_t i = 0; i < x.size(); ++i)
            held.pinned[i] = held.pinned[i] || left.touches[i];
        const StaticEnergy energy(held);
        reference::State at;
        for (const glm::dvec3& p : x)
            at.push_back({p.x, p.y, p.z});
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(
            energy.hessian(at, Curvature::projected, 1 / (left.time * left.time)));
        Eigen::VectorXd b(energy.unknowns());
        for (std::size_t i = 0; i < x.size(); ++i)
            for (int c = 0; c < 3 && energy.unknown(i) >= 0; ++c)
                b[energy.unknown(i) + c] = force[i][c];
        const Eigen::VectorXd d = factors.solve(b);
        Motion out(x.size(), glm::dvec3(0));
        for (std::size_t i = 0; i < x.size(); ++i)
            for (int c = 0; c < 3 && energy.unknown(i) >= 0; ++c)
                out[i][c] = d[energy.unknown(i) + c];
        return out;
    }
};

void check_steps(const Case& c)
{
    const auto steps = iterated_steps(c.model, StaticEnergy(c.model), c.x, c.left, {c.noise, c.weight});
    const double noise = c.moved(c.exact(c.noise)), weight = c.moved(c.exact(c.weight));
    INFO("by factoring the noise moves " << noise << " kg m, the weight " << weight);
    CHECK(c.moved(steps[0]) == Approx(noise).epsilon(0.03).margin(2 * kStepFloor * weight));
    CHECK(c.moved(steps[1]) == Approx(weight).epsilon(0.03));
}

} // namespace

TEST_CASE("iterated Newton steps move what factored ones do", "[residuals]")
{
    SECTION("cloth in the time of a fall") { check_steps(Case(test::hanging(80), 0.3)); }
    SECTION("cloth of 1e8 N/m")
    {
        Scene scene = test::hanging(80);
        scene.bodies[0].material.stretch_stiffness = 1e8;
        check_steps(Case(scene, 0.3));
    }
    SECTION("cloth that bends, in a substep")
    {
        Scene scene = test::hanging(80);
        scene.bodies[0].material.bending_stiffness = 1e-3;
        check_steps(Case(scene, 1.0 / 600));
    }
    SECTION("a bar of tetrahedra that is held at one end")
    {
        Scene scene;
        Body bar;
        bar.shape.kind = ShapeKind::box;
        bar.shape.box_cells = {24, 4, 4};
        bar.material = solid_material();
        bar.shape.box_size = {1.2, 0.2, 0.2};
        bar.material.youngs_modulus = 1e6;
        bar.material.poissons_ratio = 0.3;
        Pin pin;
        pin.faces = {"left"};
        bar.pins = {pin};
        scene.bodies = {bar};
        check_steps(Case(resolve(scene), 0.3));
    }
    SECTION("cloth some of whose vertices touch something")
    {
        Case touching(test::hanging(80), 0.3);
        for (std::size_t i = 2000; i < 2060; ++i)
            touching.left.touches[i] = true;
        check_steps(touching);
        const auto steps = iterated_steps(touching.model, StaticEnergy(touching.model), touching.x,
                                          touching.left, {touching.noise, touching.weight});
        CHECK(steps[0][2010] == glm::dvec3(0));
        CHECK(steps[1][2010] == glm::dvec3(0));
    }
}

TEST_CASE("iterated Newton steps of each body are as near as those of the heaviest", "[residuals]")
{
    Scene scene = test::hanging(24);
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].material.density = 1e-4 * scene.bodies[0].material.density;
    scene = resolve(scene);
    const Case both(scene, 0.3);
    const auto steps = iterated_steps(both.model, StaticEnergy(both.model), both.x, both.left, {both.weight});
    const Motion exact = both.exact(both.weight);
    double light = 0, light_exact = 0;
    for (std::size_t i = both.model.body_start[1]; i < both.model.body_start[2]; ++i)
    {
        light += glm::length(steps[0][i]);
        light_exact += glm::length(exact[i]);
    }
    CHECK(light == Approx(light_exact).epsilon(0.03));
}

TEST_CASE("a small system gives back the rigid motions of its groups", "[residuals]")
{
    // A ring of 12 springs with a spring to the ground at each vertex; groups of 4, and one alone.
    BlockMatrix a(13, [](const BlockMatrix::Pair& pair) {
        for (std::uint32_t i = 0; i < 12; ++i)
        {
            pair(i, (i + 1) % 12);
            pair((i + 1) % 12, i); // as often as it likes
        }
    });
    Columns place(3, 13), motion(3, 13);
    const Eigen::Matrix3d k = Eigen::Vector3d(3, 2, 1).asDiagonal();
    for (std::uint32_t i = 0; i < 13; ++i)
    {
        place.col(i) << std::cos(0.5 * i), std::sin(0.5 * i), 0.1 * i;
        a.add(i, i, (i == 12 ? 1.0 : 3.0) * k);
        if (i == 12)
            continue;
        const std::uint32_t next = (i + 1) % 12;
        a.add(i, next, -k);
        a.add(next, i, -k);
    }
    const reference::RigidCoarse coarse(a, place, 20);
    REQUIRE(coarse.groups() == 2);
    const Eigen::Vector3d shift(1, 2, 3), turn(0.5, -1, 2);
    for (std::uint32_t i = 0; i < 13; ++i)
        motion.col(i) = shift + turn.cross(Eigen::Vector3d(place.col(i)));
    Columns back = Columns::Zero(3, 13);
    coarse.add_motion(a.times(motion), back);
    CHECK((back - motion).norm() < 1e-12 * motion.norm());
}

TEST_CASE("products of block matrices are those of the whole matrix", "[residuals]")
{
    BlockMatrix a(3, [](const BlockMatrix::Pair& pair) {
        pair(0, 2);
        pair(2, 1);
    });
    Eigen::Matrix3d turned = Eigen::Matrix3d::Zero();
    turned(0, 1) = 5; // not symmetric: a block and its transpose are two things
    for (std::uint32_t i = 0; i < 3; ++i)
        a.add(i, i, (1.0 + i) * Eigen::Matrix3d::Identity());
    a.add(2, 0, turned);
    a.add(0, 2, turned.transpose());
    a.add(2, 1, 7 * Eigen::Matrix3d::Identity());
    Columns x(3, 3);
    x << 1, 4, 7, 2, 5, 8, 3, 6, 9;
    Columns whole(3, 3), below = Columns::Zero(3, 3);
    whole.col(0) = 1 * x.col(0) + turned.transpose() * x.col(2);
    whole.col(1) = 2 * x.col(1) + 7 * x.col(2);
    whole.col(2) = 3 * x.col(2) + turned * x.col(0) + 7 * x.col(1);
    below.col(2) = turned * x.col(0) + 7 * x.col(1);
    CHECK(a.times(x) == whole);
    CHECK(a.below_times(x) == below);
}
