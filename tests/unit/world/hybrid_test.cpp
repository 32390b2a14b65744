#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"
#include "taut/world/hybrid.hpp"

#include <glm/geometric.hpp>

using namespace taut;

TEST_CASE("bodies are divided so that both devices end together")
{
    const std::vector<std::uint64_t> work = {10, 40, 30, 20};
    const auto sum = [&](const std::vector<bool>& first) {
        std::uint64_t out = 0;
        for (std::size_t b = 0; b < work.size(); ++b)
            out += first[b] ? work[b] : 0;
        return out;
    };
    CHECK(sum(divide(work, 1, 1)) == 50);
    CHECK(sum(divide(work, 3, 1)) >= 70);
    CHECK(sum(divide(work, 1, 1e6)) == 0); // a device that is far too slow gets nothing
    CHECK(sum(divide(work, 1e6, 1)) == 100);
    CHECK(divide({}, 1, 1).empty());
}

namespace {

/// Cloths of different sizes over a ball each, with a moving pin on one.
Scene several_cloths()
{
    Scene scene = parse_scene(R"({"taut": 1, "duration": 1, "method": {"substeps": 4},
        "bodies": [{"grid": {"cells": [6, 6]}, "pins": [{"corners": ["top_left", "top_right"]}]},
                   {"grid": {"cells": [12, 8]}, "transform": {"translate": [3, 0, 0]},
                    "pins": [{"edge": "top",
                              "motion": [{"time": 0}, {"time": 0.5, "translate": [0, 0.2, 0.1]}]}]},
                   {"chain": {"links": 9}, "transform": {"translate": [6, 0, 0]},
                    "pins": [{"corner": "first"}]},
                   {"grid": {"cells": [3, 3]}, "transform": {"translate": [9, 0, 0]}}],
        "colliders": [{"plane": {"point": [0, -2, 0]}, "friction": 0.2}]})");
    return resolve(scene);
}

} // namespace

TEST_CASE("a hybrid world moves bit for bit as one device, also when bodies change sides")
{
    const Scene scene = several_cloths();
    const auto cpu = Device::open("cpu:serial");
    World alone(scene, cpu);
    for (const std::uint64_t every : {0, 7})
    {
        HybridOptions options;
        options.measure_every = every;
        HybridWorld hybrid(scene, cpu, Device::open("cpu"), options);
        World one(scene, cpu);
        for (int step = 0; step < 30; ++step)
        {
            hybrid.step();
            one.step();
        }
        CHECK(hybrid.positions() == one.positions());
        CHECK(hybrid.velocities() == one.velocities());
        CHECK(hybrid.time() == one.time());
        hybrid.copy_into(alone);
        CHECK(alone.positions() == one.positions());
        CHECK(measure(alone).position_hash == measure(one).position_hash);
        const std::vector<HybridPart> parts = hybrid.parts();
        REQUIRE(parts.size() == 2);
        CHECK(parts[0].bodies.size() + parts[1].bodies.size() == scene.bodies.size());
    }
}

TEST_CASE("a hybrid world works beside every device")
{
    const Scene scene = several_cloths();
    for (const std::string& name : test_devices())
    {
        INFO(name);
        const auto second = test_device(name);
        HybridWorld hybrid(scene, Device::open("cpu"), second);
        World one(scene, Device::open("cpu:serial"));
        for (int step = 0; step < 12; ++step)
        {
            hybrid.step();
            one.step();
        }
        const auto got = hybrid.positions(), want = one.positions();
        double worst = 0;
        for (std::size_t v = 0; v < got.size(); ++v)
            worst = std::max(worst, glm::length(got[v] - want[v]));
        CHECK(worst <= (second->info().hardware_gpu ? 1e-4 : 0.0));
        CHECK(hybrid.events().non_finite == 0);
    }
}

TEST_CASE("a hybrid world counts the solves of both sides, without those of its timed steps")
{
    Scene scene = several_cloths();
    scene.method.type = MethodKind::implicit_euler;
    scene.method.substeps = 2;
    scene.method.precision = Precision::float64;
    scene.method.linear_tolerance = 1e-9;
    scene.method.linear_iterations = 1000;
    for (const std::uint64_t every : {0, 3})
    {
        HybridOptions options;
        options.measure_every = every;
        HybridWorld hybrid(scene, Device::open("cpu:serial"), Device::open("cpu"), options);
        CHECK(hybrid.solver_report().solves == 0);
        CHECK(hybrid.solver_report().iterations == 0);
        World one(scene, Device::open("cpu:serial"));
        std::uint64_t expected = 0;
        for (int step = 0; step < 8; ++step)
        {
            hybrid.step();
            one.step();
            for (const HybridPart& part : hybrid.parts())
                expected += part.bodies.empty() ? 0 : scene.method.substeps;
        }
        const SolverReport both = hybrid.solver_report(), alone = one.solver_report();
        CHECK(both.solves == expected);
        CHECK(alone.solves == 8 * scene.method.substeps);
        CHECK(both.iterations > 0);
        CHECK(both.most > 0);
        CHECK(both.most <= both.iterations);
        CHECK(both.failed == 0);
        CHECK(both.last == Status::converged);
        double worst = 0;
        const auto got = hybrid.positions(), want = one.positions();
        for (std::size_t v = 0; v < got.size(); ++v)
            worst = std::max(worst, glm::length(got[v] - want[v]));
        CHECK(worst < 1e-6); // one system for all bodies: to the tolerance of the solve
    }
}

TEST_CASE("both sides of a hybrid world take the substeps of the stiffest body")
{
    Scene scene = several_cloths();
    scene.method.type = MethodKind::mass_spring;
    scene.method.stability = StabilityRule::substep;
    scene.method.substeps = 1;
    scene.bodies[2].material.stretch_stiffness = 50;
    for (const std::size_t body : {0, 1, 3})
        scene.bodies[body].material.stretch_stiffness = body == 1 ? 4000 : 50;
    HybridOptions options;
    options.measure_every = 0;
    HybridWorld hybrid(scene, Device::open("cpu:serial"), Device::open("cpu"), options);
    World one(scene, Device::open("cpu:serial"));
    REQUIRE(one.plan().substeps > 1);
    for (int step = 0; step < 10; ++step)
    {
        hybrid.step();
        one.step();
    }
    CHECK(hybrid.positions() == one.positions());
}

TEST_CASE("what cannot be divided is refused or stays whole")
{
    Scene empty;
    CHECK_THROWS_AS(HybridWorld(empty, Device::open("cpu:serial"), Device::open("cpu")), Error);
    Scene one = several_cloths();
    one.bodies.resize(1);
    HybridWorld hybrid(one, Device::open("cpu:serial"), Device::open("cpu"));
    hybrid.step();
    CHECK(hybrid.parts()[0].bodies.size() + hybrid.parts()[1].bodies.size() == 1);
}
