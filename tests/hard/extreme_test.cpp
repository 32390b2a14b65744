// Impulses, flipped gravity, reproducibility, device limits (methods 2.G).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("G03: cloth survives 1e6 N on one vertex for one frame, and the clamp is counted [hard]")
{
    for (const double limit : {0.0, 100.0})
        on_every_device([&](const auto& device) {
            Scene scene = test::hanging(6);
            scene.external_forces = true;
            scene.damping = 1;
            scene.max_speed = limit;
            World world(scene, device);
            run(world, 5);
            world.set_force(24, {0, 0, 1e6});
            world.step();
            world.set_force(24, {0, 0, 0});
            const double shock = measure(world).max_stretch;
            run(world, 900);
            const StepReport report = check_sound(world, limit > 0 ? Words{"speed_clamp"} : Words{});
            note("G03", *device, limit > 0 ? "stretch in the frame, clamped" : "stretch in the frame", shock);
            note("G03", *device, limit > 0 ? "stretch 15 s later, clamped" : "stretch 15 s later",
                 report.max_stretch);
            CHECK(shock > 0.1);
            CHECK(report.max_stretch < 0.02);
            for (const glm::dvec3& x : world.positions())
                CHECK(glm::length(x) < 3);
        });
}

TEST_CASE("G04: gravity of 1e4, turned round every frame, gives no more than its work [hard]")
{
    on_every_device([](const auto& device) {
        for (const bool held : {true, false})
        {
            Scene scene = test::hanging(5);
            if (!held)
                scene.bodies[0].pins.clear();
            World world(scene, device);
            const PhysicalModel model = make_model(scene);
            // Inner energy: with gravity off, kinetic + elastic. It may rise by the work of gravity only.
            glm::dvec3 gravity(0, -1e4, 0);
            const auto inner = [&] {
                const StepReport r = measure(world);
                return energy(r) - gravity_energy(make_model(world.scene()), world.positions());
            };
            const auto height = [&] {
                double sum = 0;
                const auto x = world.positions();
                for (std::size_t v = 0; v < x.size(); ++v)
                    sum += model.mass[v] * x[v].y;
                return sum;
            };
            double bound = inner(), excess = -kInfinity;
            for (int i = 0; i < 60; ++i)
            {
                world.set_gravity(gravity);
                const double before = height(), energy_before = inner();
                world.step();
                const double work = gravity.y * (height() - before);
                bound += std::abs(work);
                excess = std::max(excess, inner() - energy_before - work);
                CHECK(inner() <= bound * (1 + 1e-6));
                gravity = -gravity;
            }
            const StepReport report = check_sound(world);
            note("G04", *device, held ? "energy / input work, pinned" : "energy / input work, free",
                 inner() / bound);
            note("G04", *device,
                 held ? "largest gain beyond the work of a frame, J" : "largest gain, free, J", excess);
            if (!held)
                CHECK(report.momentum_error < 1e-4);
        }
    });
}

TEST_CASE("a change of gravity is refused when it is no number, and momentum counts it [hard]")
{
    on_every_device([](const auto& device) {
        World world(free_cloth(3), device);
        run(world, 10);
        world.set_gravity({1, -2, 3});
        run(world, 30);
        world.set_timestep(1.0 / 120);
        run(world, 20);
        for (const double bad : {kNaN, kInfinity})
            CHECK(refusal_of([&] { world.set_gravity({0, bad, 0}); }) == "bad_input");
        CHECK(world.gravity_impulse().x == Approx(0.5 + 20.0 / 120));
        CHECK(check_sound(world).momentum_error < 1e-5);
        CHECK(world.velocities()[0].y == Approx(-2 * (0.5 + 20.0 / 120)).epsilon(1e-4));
    });
}

TEST_CASE("G05: a force that is no number at frame 100 leaves the state of frame 99 [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::everything(4);
        World world(scene, device), straight(scene, device);
        for (World* w : {&world, &straight})
        {
            w->set_force(5, {0.1, 0, 0});
            run(*w, steps_for(*device, 99, 30));
        }
        CHECK(refusal_of([&] { world.set_force(5, {kNaN, 0, 0}); }) == "bad_input");
        CHECK(same_state(world.state(), straight.state()));
        run(world, 10);
        run(straight, 10);
        CHECK(same_state(world.state(), straight.state()));
        check_sound(world);
    });
}

TEST_CASE("G06, G09: two runs, and a run stopped and restored halfway, end in the same bits [hard]")
{
    on_every_device([](const auto& device) {
        const Scene scene = test::everything(5);
        World once(scene, device), twice(scene, device), halves(scene, device), rest(scene, device);
        run(once, 40);
        run(twice, 40);
        run(halves, 17);
        rest.restore(halves.state());
        run(rest, 23);
        CHECK(same_state(once.state(), twice.state()));
        CHECK(same_state(once.state(), rest.state()));
        CHECK(measure(once).position_hash == measure(rest).position_hash);
        check_sound(rest);
    });
}

TEST_CASE("G07, C04: copies of a body are copies bit by bit, also beside others [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::everything(4);
        scene.bodies[0].pins.clear();
        Scene crowd = scene;
        crowd.bodies.resize(4, scene.bodies[0]);
        crowd.bodies.push_back(test::chain(7, 100, 0.01).bodies[0]);
        for (glm::dvec3& x : crowd.bodies.back().mesh.positions)
            x += glm::dvec3(2, 1, 0); // clear of the ball and the floor
        World solo(scene, device), all(crowd, device);
        run(solo, 30);
        run(all, 30);
        const auto x = solo.positions(), y = all.positions();
        for (std::size_t v = 0; v < 4 * x.size(); ++v)
            REQUIRE(y[v] == x[v % x.size()]);
        check_sound(all);
    });
}

TEST_CASE("G08: effects that exist and are not called for change no bit and cost no byte [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(5);
        scene.gravity = {0, -9.81, 0};
        scene.bodies[0].pins = {hold({0})};
        WorldOptions only;
        only.plan.available_effects = {"motion", "distance", "bending"};
        World with(scene, device), without(scene, device, only);
        run(with, 30);
        run(without, 30);
        CHECK(same_state(with.state(), without.state()));
        CHECK(with.plan().bytes_allocated() == without.plan().bytes_allocated());
        CHECK(with.plan().passes.size() == without.plan().passes.size());
        check_sound(with);
    });
}

TEST_CASE("G10: what a device cannot bind is refused with both numbers, before anything is made [hard]")
{
    on_every_device([](const auto& device) {
        const DeviceTraits traits = measure_traits(*device);
        CHECK(traits.max_buffer_bytes == device->limits().max_buffer_bytes);
        const DeviceCounters before = device->counters();
        const Scene scene = test::hanging(32);
        DeviceTraits small = traits;
        small.max_buffer_bytes = 4096;
        std::string text;
        CHECK(refusal_of([&] { make_plan(scene, small); }, &text) == "limit");
        CHECK(text.find("4096") != std::string::npos);
        CHECK(text.find(std::to_string(33 * 33 * 16)) != std::string::npos);
        small.max_buffer_bytes = 1u << 20;
        CHECK(make_plan(scene, small).vertex_count == 33 * 33);
        // The device itself refuses one byte more than it says. Sizes that only the address space limits
        // are not asked for.
        if (traits.max_buffer_bytes < (std::uint64_t(1) << 40))
            CHECK(refusal_of([&] { device->make_buffer(traits.max_buffer_bytes + 1, "too large"); }) ==
                  "limit");
        CHECK(device->counters().bytes_allocated == before.bytes_allocated);
    });
}

TEST_CASE("G10: a cloth of more bytes than the device binds is refused by the world [hard]")
{
    on_every_device([](const auto& device) {
        const std::uint64_t most = device->limits().max_buffer_bytes;
        if (most > (std::uint64_t(1) << 28))
            return; // its mesh would not fit this test's time
        const auto links = static_cast<std::uint32_t>(most / 16);
        Scene scene;
        scene.bodies = {particles(std::vector<glm::dvec3>(links + 1, glm::dvec3(0)))};
        CHECK(refusal_of([&] { World refused(scene, device); }) == "limit");
    });
}

TEST_CASE("G10: more vertices than 65,535 groups hold: every one of 4.3 million falls [hard]")
{
    const auto device = test_device("cpu");
    Scene scene;
    scene.method.substeps = 1;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 4'300'000;
    body.shape.length = 4300;
    body.material.stretch_stiffness = 0;
    scene.bodies = {body};
    World world(scene, device);
    REQUIRE(world.plan().vertex_count > 65535u * 64);
    world.step();
    const auto v = world.velocities();
    double least = kInfinity, most = -kInfinity;
    for (const glm::dvec3& u : v)
    {
        least = std::min(least, u.y);
        most = std::max(most, u.y);
    }
    CHECK(least == Approx(-9.81 / 60).epsilon(1e-6));
    CHECK(most == Approx(-9.81 / 60).epsilon(1e-6));
}
