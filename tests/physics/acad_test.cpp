// ACAD: springs that become constraints beyond a strain (docs/methods/acad.md; F09 to F13 of
// docs/hard-cases.md).

#include "hard/cases.hpp"

#include "taut/plan/plan.hpp"

#include <cstring>

using namespace taut;
using namespace taut::hard;

namespace {

Scene acad(Scene scene)
{
    scene.method.type = MethodKind::acad;
    scene.method.substeps = 1;
    scene.method.constraint_compliance = 0;
    return scene;
}

/// F09: a weight on one spring whose static strain is 0.196.
Scene one_spring(double h)
{
    Body body = particles({{0, 0, 0}, {0, -1, 0}});
    body.springs = {{0, 1, 1, 1.0 / 50}};
    body.pins = {hold({0})};
    Scene scene = acad(alone(body));
    scene.gravity = {0, -9.81, 0};
    scene.timestep = h;
    scene.method.precision = Precision::float64;
    scene.method.activate_strain = scene.method.release_strain = 0.1;
    return scene;
}

/// A square metre and a kilogram of cloth of n x n vertices, hung by two corners, in a network of springs.
Scene square(std::uint32_t n, double stiffness, double h)
{
    Scene scene;
    Body body;
    body.shape.cells = {n - 1, n - 1};
    body.shape.network = {true, stiffness, stiffness, stiffness};
    body.vertex_masses.assign(std::size_t(n) * n, 1.0 / (n * n));
    Pin pin;
    pin.corners = {"top_left", "top_right"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.timestep = h;
    return resolve(scene);
}

double worst_strain(const World& world, SpringKind kind = SpringKind::structural)
{
    const auto x = world.positions();
    double worst = 0;
    for (const StretchElement& e : stretch_elements(world.scene().bodies[0]))
        if (e.kind == kind)
            worst = std::max(worst, glm::distance(x[e.a], x[e.b]) / e.rest_length - 1);
    return worst;
}

/// The flags as they are kept from step to step.
std::vector<std::uint32_t> flags_of(const World& world)
{
    const auto bytes = world.state().kept.at(0);
    std::vector<std::uint32_t> flags(bytes.size() / 4);
    std::memcpy(flags.data(), bytes.data(), bytes.size());
    flags.pop_back();
    return flags;
}

} // namespace

TEST_CASE("a weight beyond its spring's threshold settles there, without chatter (F09)")
{
    on_every_device([](const auto& device) {
        for (const char* release : {"multiplier", "strain"})
        {
            Scene scene = one_spring(1.0 / 60);
            scene.method.release = option_named<ReleaseRule>(release);
            if (std::string(release) == "strain")
                scene.method.release_strain = 0.05;
            World world(scene, device);
            int toggles = 0;
            double fastest = 0;
            auto before = flags_of(world);
            for (int step = 0; step < 120; ++step)
            {
                world.step();
                const auto now = flags_of(world);
                toggles += step >= 60 && now != before;
                before = now;
                if (step >= 60)
                    fastest = std::max(fastest, glm::length(world.velocities()[1]));
            }
            const double strain = -world.positions()[1].y - 1;
            note("F09", *device, (std::string("strain, ") + release).c_str(), strain);
            CHECK(strain == Approx(0.1).epsilon(1e-9));
            CHECK(toggles == 0);
            CHECK(fastest < 1e-12);
            CHECK(measure(world).active_share == 1);
        }
    });
}

TEST_CASE("a constraint that is switched on injects no speed (F10)")
{
    const auto device = test_device("cpu:serial");
    for (const double h : {1.0 / 60, 1.0 / 240})
    {
        World world(one_spring(h), device);
        double before = 0, jump = 0;
        for (int step = 0; step < 2 / h; ++step)
        {
            world.step();
            const double speed = glm::length(world.velocities()[1]);
            jump = std::max(jump, speed - before);
            before = speed;
        }
        note("F10", *device, "largest gain of speed in a step, m/s", jump);
        // Falling alone gains g h a step; pulled back to L it would be tau L / h: 6 and 24 m/s.
        CHECK(jump < 1.5 * 9.81 * h);
    }
}

TEST_CASE("with no constraint it is mass-spring, bit for bit (F11)")
{
    on_every_device([](const auto& device) {
        for (const char* precision : {"float", "double"})
        {
            Scene scene = square(10, 100, 1e-3);
            scene.bodies[0].material.stretch_damping = 1e-3;
            scene.method.precision = option_named<Precision>(precision);
            Scene free = acad(scene);
            free.method.activate_strain = free.method.release_strain = 1e6;
            Scene plain = free;
            plain.method.type = MethodKind::mass_spring;
            World a(free, device), b(plain, device);
            run(a, 40);
            run(b, 40);
            CHECK(same_state(a.state(), b.state()));
            CHECK(measure(a).active_share == 0);
            CHECK(a.solver_report().solves == 0);
        }
    });
}

TEST_CASE("with every spring a constraint it is implicit constraints, bit for bit (F11)")
{
    on_every_device([](const auto& device) {
        for (const char* precision : {"float", "double"})
            for (const std::uint32_t solves : {1u, 2u})
            {
                Scene scene = square(10, 100, 1e-3);
                scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
                for (glm::dvec3& x : scene.bodies[0].start_positions)
                    x *= 1.002;
                scene.method.precision = option_named<Precision>(precision);
                scene.method.iterations = solves;
                Scene all = acad(scene);
                all.method.constraint_compliance = 1e-4; // the network has more springs than freedom
                all.method.activate_strain = 1e-3; // all stay stretched by about that; none is released
                all.method.release_strain = 0;
                all.method.release = ReleaseRule::strain;
                Scene plain = all;
                for (Body::Spring& s : plain.bodies[0].springs)
                    s.rest_length *= 1 + all.method.activate_strain;
                plain.method.type = MethodKind::implicit_constraints;
                plain.method.linear_operator = LinearOperator::matrix_free;
                World a(all, device), b(plain, device);
                for (int step = 0; step < 15; ++step)
                {
                    a.step();
                    b.step();
                    CHECK(measure(a).active_share == 1);
                }
                const WorldState one = a.state(), other = b.state();
                CHECK(a.positions() == b.positions());
                CHECK(a.velocities() == b.velocities());
                CHECK(a.solver_report().iterations == b.solver_report().iterations);
                CHECK(one.position == other.position);
            }
    });
}

namespace {

/// A run of 2 s of a hung cloth, every tenth step.
struct Hung
{
    double strain = 0;     ///< worst of a structural spring
    double share = 0;      ///< mean, of springs that are constraints
    double iterations = 0; ///< of a solve
};

Hung hang(const Scene& scene, const std::shared_ptr<Device>& device)
{
    World world(scene, device);
    Hung out;
    for (int step = 0; step < 2000; ++step)
    {
        world.step();
        if (step % 10 != 0)
            continue;
        out.strain = std::max(out.strain, worst_strain(world));
        out.share += world.active_share() / 200;
    }
    const SolverReport solver = world.solver_report();
    out.iterations = double(solver.iterations) / double(std::max<std::uint64_t>(solver.solves, 1));
    check_sound(world);
    return out;
}

} // namespace

TEST_CASE("strain stays near the threshold where mass-spring stretches on (seed 3.4)")
{
    const auto device = test_device("cpu:serial");
    for (const double stiffness : {20.0, 100.0, 500.0})
    {
        Scene scene = acad(square(16, stiffness, 1e-3));
        scene.method.stability = StabilityRule::ignore;
        scene.method.constrained = ConstrainedSprings::structural;
        Scene plain = scene, at_three = scene, at_five = scene;
        plain.method.type = MethodKind::mass_spring;
        at_three.method.release = at_five.method.release = ReleaseRule::strain;
        at_three.method.release_strain = 0.03;
        const double springs = hang(plain, device).strain;
        note("3.4", *device, "k", stiffness);
        note("3.4", *device, "mass-spring, worst strain", springs);
        for (const auto& [name, with] :
             {std::pair{"multiplier", scene}, {"strain, 3 %", at_three}, {"strain, 5 %", at_five}})
        {
            const Hung found = hang(with, device);
            note("3.4", *device, (std::string(name) + ": worst strain").c_str(), found.strain);
            note("3.4", *device, "mean active share", found.share);
            note("3.4", *device, "iterations a solve", found.iterations);
            CAPTURE(stiffness, name);
            CHECK(found.strain < 0.05 + 0.05);
            CHECK(found.strain < springs);
            CHECK(found.share > 0);
            CHECK(found.share < 1);
        }
    }
}

TEST_CASE("the system has as many rows as springs are constraints (F12)")
{
    on_every_device([](const auto& device) {
        Scene scene = acad(square(12, 60, 1e-3));
        scene.method.constrained = ConstrainedSprings::structural;
        scene.method.release = ReleaseRule::strain; // flags then stay as they were in the substep
        scene.method.release_strain = 0.01;
        World world(scene, device);
        bool some = false;
        for (int step = 0; step < 150; ++step)
        {
            world.step();
            if (step % 10 != 9)
                continue;
            const auto flags = flags_of(world);
            const double rows = static_cast<double>(std::count(flags.begin(), flags.end(), 1u));
            CHECK(world.active_share() == rows / (2 * 12 * 11));
            some = some || (rows > 0 && rows < 2 * 12 * 11);
        }
        CHECK(some);
        for (const Dispatch& pass : world.plan().passes)
        {
            const std::string_view kernel = pass.kernel->name;
            const bool of_rows = kernel.starts_with("constraint") || kernel == "acad_rows" ||
                                 kernel == "acad_store" || kernel.starts_with("cg_");
            if (of_rows)
                CHECK(pass.indirect.buffer != kNoBuffer);
        }
    });
}

TEST_CASE("a continuation from a saved state is the same to the last bit, flags and multipliers too (G09)")
{
    on_every_device([](const auto& device) {
        Scene scene = acad(square(8, 40, 1e-3));
        scene.method.constrained = ConstrainedSprings::structural;
        World whole(scene, device), first(scene, device), second(scene, device);
        run(whole, 160);
        run(first, 150);
        CHECK(first.active_share() > 0);
        second.restore(first.state());
        run(second, 10);
        CHECK(same_state(whole.state(), second.state()));
    });
}
