#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "support/sphere.hpp"

#include "taut/report/load_residual.hpp"

#include <glm/geometric.hpp>

#include <cmath>

using namespace taut;

namespace {

constexpr double kSubstep = 1.0 / 600;

/// As if a solver did nothing: the whole weight is left. Its signs are those of M (x - x~) / h^2 - f.
Leftover weight_left(const PhysicalModel& model)
{
    Leftover out{{}, {}, {}, {}, kSubstep, false};
    for (const double mass : model.mass)
    {
        out.force.push_back(-mass * model.gravity);
        out.load.push_back(mass * glm::length(model.gravity));
        out.touches.push_back(false);
    }
    return out;
}

PhysicalModel free_cloth(double stiffness, std::uint32_t cells = 8)
{
    Scene scene = test::hanging(cells);
    scene.bodies[0].pins.clear();
    scene.bodies[0].material.stretch_stiffness = stiffness;
    return make_model(scene);
}

} // namespace

TEST_CASE("a solver that does nothing to what falls leaves all of its loads' motion", "[residuals]")
{
    const PhysicalModel model = free_cloth(1e4);
    Leftover left = weight_left(model);
    CHECK(load_residual(model, model.start, left).share == Approx(1));
    left.carried.assign(model.mass.size(), 0);
    left.carried[3] = 3 * glm::length(model.gravity) * kSubstep * kSubstep; // a pin moves it thrice as far
    CHECK(load_residual(model, model.start, left).share == Approx(0.25));
    left.carried.clear();
    for (glm::dvec3& r : left.force)
        r *= 0.25;
    CHECK(load_residual(model, model.start, left).share == Approx(0.25));
    for (glm::dvec3& r : left.force)
        r = glm::dvec3(0);
    CHECK(load_residual(model, model.start, left).share == 0);
}

TEST_CASE("cloth that lies in the air between its pins shows, cloth that stiff springs hold does not",
          "[residuals]")
{
    Scene scene = test::hanging(8);
    scene.bodies[0].material.stretch_stiffness = 1e9;
    const PhysicalModel model = make_model(scene);
    Leftover left = weight_left(model);
    const glm::dvec3 within = glm::normalize(model.start[1] - model.start[0]);
    const glm::dvec3 out_of = glm::normalize(glm::cross(within, model.start[9] - model.start[0]));
    const auto residual = [&](const glm::dvec3& pull) {
        for (std::size_t i = 0; i < model.mass.size(); ++i)
            left.force[i] = left.load[i] * pull;
        return load_residual(model, model.start, left).share;
    };
    const double lying = residual(out_of), hanging = residual(within);
    INFO("lying " << lying << ", held " << hanging);
    CHECK(lying > 0.9);
    CHECK(hanging < 0.1);
}

TEST_CASE("roundings of stiff springs are no residual", "[residuals]")
{
    const double stiffness = 1e9;
    const PhysicalModel model = free_cloth(stiffness);
    Leftover left = weight_left(model);
    for (glm::dvec3& r : left.force)
        r = glm::dvec3(0);
    for (const StretchElement& e : model.springs) // 60 N each, against a weight of 2 N
    {
        const glm::dvec3 pull = 6e-8 * stiffness * glm::normalize(model.start[e.a] - model.start[e.b]);
        left.force[e.a] += pull;
        left.force[e.b] -= pull;
    }
    CHECK(load_residual(model, model.start, left).share < 0.01);
}

TEST_CASE("of a body that touches something half of what is left counts, away from there", "[residuals]")
{
    const PhysicalModel model = free_cloth(1e4);
    Leftover left = weight_left(model);
    left.touches[40] = true;
    left.beside.assign(left.touches.size(), false);
    for (const StretchElement& e : model.springs)
        left.beside[e.a == 40 ? e.b : e.b == 40 ? e.a : 40] = true;
    left.beside[40] = false;
    const double frozen = load_residual(model, model.start, left).share;
    CHECK(frozen > 0.2); // some are held, the others count half
    CHECK(frozen < 0.5);
    Leftover aside = left; // whichever way it has yet to go
    for (glm::dvec3& r : aside.force)
        r = {r.y, 0, 0};
    CHECK(load_residual(model, model.start, aside).share > 0.2);
    Leftover pushed = left; // what the push itself has left
    for (std::size_t i = 0; i < pushed.force.size(); ++i)
        pushed.force[i] = left.beside[i] || left.touches[i] ? -10.0 * left.force[i] : glm::dvec3(0);
    CHECK(load_residual(model, model.start, pushed).share == 0);
    pushed.against_response = true; // in a long time a push is followed
    CHECK(load_residual(model, model.start, pushed).way > 0);
}

TEST_CASE("a body rolls about the vertex that touches, and not where a pin holds it", "[residuals]")
{
    PhysicalModel model = free_cloth(1e6);
    Leftover left = weight_left(model);
    left.time = 0.3;
    left.against_response = true;
    left.touches[0] = true;
    const glm::dvec3 across = 1e-3 * glm::normalize(model.start[1] - model.start[0]);
    for (std::size_t i = 0; i < model.mass.size(); ++i)
        left.force[i] = -left.load[i] * across;
    const double free = load_residual(model, model.start, left).way;
    model.pinned[0] = true;
    const double held = load_residual(model, model.start, left).way;
    INFO(free << " free, " << held << " held");
    CHECK(held > 1e-5);
    CHECK(free < 0.05 * held);
}

TEST_CASE("of a body that mostly lies on something only what has yet to fall counts", "[residuals]")
{
    const PhysicalModel model = free_cloth(1e4);
    Leftover left = weight_left(model);
    left.touches[40] = true;
    left.beside.assign(left.touches.size(), true);
    left.beside[40] = false;
    CHECK(load_residual(model, model.start, left).share > 0.25);
    for (glm::dvec3& r : left.force) // as if a contact had pushed from below
        r = -r;
    CHECK(load_residual(model, model.start, left).share < 1e-3);
}

TEST_CASE("a body of no size beside one that was not solved hides nothing", "[residuals]")
{
    Scene scene = test::hanging(8);
    scene.bodies[0].pins.clear();
    Body particle;
    particle.shape.kind = ShapeKind::chain;
    particle.shape.links = 0;
    particle.vertex_masses = {1};
    scene.bodies.push_back(particle);
    const PhysicalModel model = make_model(resolve(scene));
    Leftover left = weight_left(model);
    left.force.back() = glm::dvec3(0); // the particle falls as it should
    CHECK(load_residual(model, model.start, left).share == Approx(1));
}

TEST_CASE("models too large to factor say the same", "[residuals]")
{
    const PhysicalModel model = free_cloth(1e4, 104); // 33,075 unknowns
    const Leftover left = weight_left(model);
    CHECK(load_residual(model, model.start, left).share == Approx(1).epsilon(1e-2));
}

TEST_CASE("a body is followed as far where steps are too large to factor", "[residuals]")
{
    const auto way = [](std::size_t copies, double followed) { // 1,875 unknowns each
        Scene scene = test::hanging(24);
        scene.gravity = {0, 0, 0.02}; // across the cloth, which has to sag before its springs hold it
        scene.bodies.resize(copies, scene.bodies[0]);
        const PhysicalModel model = make_model(scene);
        Leftover left = weight_left(model);
        left.time = 0.5;
        left.against_response = true;
        left.followed = followed;
        std::vector<glm::dvec3> x = model.start, force(x.size(), glm::dvec3(0));
        for (std::size_t i = 0; i < x.size(); ++i) // strained at random, as sweeps leave it
        {
            const std::size_t k = i % (x.size() / copies);
            x[i] += 2e-4 * glm::sin(glm::dvec3(12.9898, 78.233, 37.719) * static_cast<double>(k * k % 1009));
        }
        add_forces(model, x, force);
        for (std::size_t i = 0; i < x.size(); ++i)
            left.force[i] = -force[i];
        return load_residual(model, x, left).way;
    };
    const double factored = way(1, 0.1), iterated = way(2, 0.1), one_step = way(1, HUGE_VAL);
    INFO(one_step << " in one step, " << factored << " by factors, " << iterated << " without");
    CHECK(factored > 1.1 * one_step);
    CHECK(iterated == Approx(factored).epsilon(0.01));
}

TEST_CASE("what a gas pushes with is a load of its own, however weak gravity is", "[residuals]")
{
    Scene scene;
    Body body;
    body.mesh = test::sphere_mesh(4, 0.5);
    body.material.stretch_stiffness = 500;
    body.material.pressure = 100;
    body.vertex_masses.assign(body.mesh.positions.size(), 1e-3);
    scene.bodies = {body};
    const PhysicalModel model = make_model(scene);
    REQUIRE(model.gases.size() == 1);
    Leftover left = weight_left(model);
    left.time = 0.3;
    left.against_response = true;
    left.gas.assign(model.mass.size(), glm::dvec3(0));
    add_gas_forces(model.gases[0], model.start, left.gas);
    for (std::size_t i = 0; i < left.gas.size(); ++i)
        left.force[i] = -left.gas[i]; // as if it pushed on nothing
    for (double& load : left.load)
        load *= 1e-9;
    CHECK(load_residual(model, model.start, left).share == Approx(1));
    for (glm::dvec3& r : left.force)
        r *= 0.1;
    CHECK(load_residual(model, model.start, left).share == Approx(0.1));
    left.gas.clear();
    CHECK(load_residual(model, model.start, left).share > 1e3);
}

TEST_CASE("a way that a strained spring holds back is followed, one that tension holds stays short",
          "[residuals]")
{
    const auto way = [](bool held_on_both_sides, double followed) {
        Scene scene;
        Body body;
        body.mesh.positions = {{-1.001, 0, 0}, {0, 0, 0}, {1.001, 0, 0}};
        body.springs = {{0, 1, 1, 1e-5}}; // 1e5 N/m, strained to 100 N where the weight is 0.1 N
        if (held_on_both_sides)
            body.springs.push_back({1, 2, 1, 1e-5});
        body.vertex_masses.assign(3, 0.01);
        body.pins.emplace_back().vertices = {0, 2};
        scene.bodies = {body};
        const PhysicalModel model = make_model(scene);
        Leftover left = weight_left(model);
        left.time = 0.3;
        left.against_response = true;
        left.followed = followed;
        add_forces(model, model.start, left.force = std::vector<glm::dvec3>(3, glm::dvec3(0)));
        for (glm::dvec3& r : left.force)
            r = -r;
        return load_residual(model, model.start, left).way;
    };
    CHECK(way(false, HUGE_VAL) < 1e-3);
    CHECK(way(false, 0.25) > 40 * way(false, HUGE_VAL)); // a pendulum, let go, as far as eight steps go
    CHECK(way(true, 0.25) == Approx(way(true, HUGE_VAL)).epsilon(0.05));
}
