// Energy, force and reference of a gas within a closed surface.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/sphere.hpp"

#include "taut/plan/surface.hpp"
#include "taut/report/model.hpp"
#include "taut/report/reference_dynamic.hpp"
#include "taut/report/reference_static.hpp"
#include "taut/report/report.hpp"
#include "taut/report/soundness.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

/// A sphere of cloth of 1 kg, let go a little larger than it is at rest.
Scene balloon(const std::string& law, double pressure = 200, bool inwards = false)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh = test::sphere_mesh(4, 0.5);
    if (inwards)
        for (auto& t : body.mesh.triangles)
            std::swap(t[1], t[2]);
    body.material.stretch_stiffness = 500;
    body.material.pressure = pressure;
    body.material.pressure_law = option_named<PressureLaw>(law);
    body.vertex_masses.assign(body.mesh.positions.size(),
                              1.0 / static_cast<double>(body.mesh.positions.size()));
    body.start_positions = body.mesh.positions;
    for (glm::dvec3& x : body.start_positions)
        x *= 1.1;
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    scene.method.type = MethodKind::mass_spring;
    scene.method.precision = Precision::float64;
    return scene;
}

/// Places at which an isothermal gas is usable, next to none, and of the other sign.
std::vector<glm::dvec3> squeezed(const Scene& scene, double share)
{
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        const auto angle = static_cast<double>(v);
        x[v].y *= share;
        x[v] += 0.01 * std::min(std::abs(share), 1.0) *
                glm::dvec3(std::sin(3 * angle), std::sin(5 * angle), 0);
    }
    return x;
}

struct Spread
{
    double whole = 0, without_gas = 0; ///< largest change of the energy over the largest kinetic one
};

Spread energy_spread(const std::string& law, std::uint32_t substeps)
{
    Scene scene = balloon(law);
    scene.method.substeps = substeps;
    World world(scene, test_device("cpu:serial"));
    const PhysicalModel model = make_model(world.scene());
    double kinetic = 0, first = 0, first_bare = 0;
    Spread out;
    for (int frame = 0; frame <= 40; ++frame)
    {
        if (frame > 0)
            world.step();
        const StepReport r = measure(world);
        const double energy = r.kinetic_energy + r.potential_energy;
        const double bare = energy - gas_energy(model, world.positions());
        if (frame == 0)
        {
            first = energy;
            first_bare = bare;
        }
        kinetic = std::max(kinetic, r.kinetic_energy);
        out.whole = std::max(out.whole, std::abs(energy - first));
        out.without_gas = std::max(out.without_gas, std::abs(bare - first_bare));
    }
    out.whole /= kinetic;
    out.without_gas /= kinetic;
    return out;
}

} // namespace

TEST_CASE("the force of a gas is minus the slope of its energy", "[gas]")
{
    for (const std::string law : {"constant", "isothermal"})
        for (const bool inwards : {false, true})
            for (const double share : {1.2, 0.5, 0.004, -0.5})
            {
                CAPTURE(law, inwards, share);
                const Scene scene = balloon(law, 200, inwards);
                const PhysicalModel model = make_model(scene);
                REQUIRE(model.gases.size() == 1);
                std::vector<glm::dvec3> x = squeezed(scene, share);
                std::vector<glm::dvec3> force(x.size(), glm::dvec3(0));
                add_gas_forces(model.gases[0], x, force);
                double largest = 0, worst = 0;
                for (std::size_t v = 0; v < x.size(); v += 7)
                    for (int k = 0; k < 3; ++k)
                    {
                        const double h = 1e-5, at = x[v][k];
                        x[v][k] = at + h;
                        const double more = gas_energy(model, x);
                        x[v][k] = at - h;
                        const double less = gas_energy(model, x);
                        x[v][k] = at;
                        largest = std::max(largest, std::abs(force[v][k]));
                        worst = std::max(worst, std::abs(force[v][k] + (more - less) / (2 * h)));
                    }
                CHECK(largest > 0.01);
                CHECK(worst < 1e-6 * largest + 1e-8);
            }
}

TEST_CASE("a gas has the energy of its law", "[gas]")
{
    const Scene constant = balloon("constant", 300), isothermal = balloon("isothermal", 300);
    const std::vector<glm::dvec3> x = squeezed(constant, 0.7);
    const auto& mesh = constant.bodies[0].mesh;
    const double rest = enclosed_volume(mesh.triangles, mesh.positions);
    const double now = enclosed_volume(mesh.triangles, x);
    CHECK(gas_energy(make_model(constant), x) == Approx(-300 * now).epsilon(1e-12));
    CHECK(gas_energy(make_model(isothermal), x) == Approx(-300 * rest * std::log(now / rest)).epsilon(1e-12));
    CHECK(gas_energy(make_model(isothermal), mesh.positions) == Approx(0).margin(1e-12));
    // The same whichever way the surface looks; nothing without a gas.
    CHECK(gas_energy(make_model(balloon("isothermal", 300, true)), x) ==
          Approx(gas_energy(make_model(isothermal), x)).epsilon(1e-12));
    CHECK(make_model(balloon("constant", 0)).gases.empty());
}

TEST_CASE("a balloon that swings keeps its energy only with that of its gas", "[gas]")
{
    for (const std::string law : {"constant", "isothermal"})
    {
        CAPTURE(law);
        const Spread coarse = energy_spread(law, 40), fine = energy_spread(law, 80);
        CHECK(fine.whole < 0.02);
        CHECK(fine.whole < 0.6 * coarse.whole); // semi-implicit Euler: of first order in the substep
        CHECK(fine.without_gas > 0.3);
    }
}

TEST_CASE("the reference by small steps knows a gas as the methods do", "[gas]")
{
    for (const std::string law : {"constant", "isothermal"})
    {
        CAPTURE(law);
        Scene scene = balloon(law);
        scene.duration = 0.1;
        const PhysicalModel model = make_model(scene);
        const DynamicReference reference = solve_dynamic(model);
        INFO(reference.reason);
        REQUIRE(reference.verified);
        scene.method.substeps = 400;
        World world(scene, test_device("cpu:serial"));
        const std::size_t frames = reference.frames.size() - 1;
        for (std::size_t f = 0; f < frames; ++f)
            world.step();
        double moved = 0, apart = 0;
        const auto x = world.positions();
        for (std::size_t v = 0; v < x.size(); ++v)
        {
            moved = std::max(moved, glm::distance(x[v], model.start[v]));
            apart = std::max(apart, glm::distance(x[v], reference.frames.back()[v]));
        }
        CHECK_FALSE(solve_static(model, model.start).converged); // R2 says that it does not know it
        CHECK(solve_static(model, model.start).reason.find("gas") != std::string::npos);
        CHECK(moved > 0.01);
        CHECK(apart < 5e-3 * moved);
    }
}

TEST_CASE("the bound on frequencies counts a gas", "[gas]")
{
    const PhysicalModel with = make_model(balloon("isothermal", 5000));
    PhysicalModel without = with;
    without.gases.clear();
    const auto& x = with.start;
    const double more = std::pow(frequency_bound(with, x), 2) - std::pow(frequency_bound(without, x), 2);
    // The direction in which all vertices swell at once: f'= -p g g^T / V there, over the mass.
    std::vector<glm::dvec3> slope(x.size(), glm::dvec3(0));
    add_volume_gradient(with.gases[0].triangles, x, 1, slope);
    double square = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
        square += glm::dot(slope[v], slope[v]) / with.mass[v];
    const double volume = enclosed_volume(with.gases[0].triangles, x);
    const double pressure = 5000 * with.gases[0].rest_volume / volume;
    CHECK(more > pressure * square / volume);
}

TEST_CASE("closed cloth with a suction that has turned inside out is unconverged")
{
    const bool inwards = GENERATE(false, true);
    Scene scene = balloon("isothermal", -100, inwards);
    scene.bodies[0].material.stretch_stiffness = 1e-6; // what is strained has next to no energy
    const auto judged = [&](double share) {
        std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
        for (glm::dvec3& p : x)
            p.y *= share;
        const std::vector<glm::dvec3> still(x.size(), glm::dvec3(0));
        return judge_state(EnergyBudget(scene),
                           {scene, x, still, {1, 1.0 / 600, 0, true, 0}, Precision::float32, {}, 0});
    };
    CHECK(judged(1).sound());
    CHECK(judged(-0.05).sound()); // two layers that lie on each other, and cross a little
    const Soundness turned = judged(-0.5);
    CHECK(turned.status == Status::unconverged);
    CHECK_THAT(turned.reason, Contains("inside out: it encloses -0.5"));
}
