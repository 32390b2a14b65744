// Vertex block descent: stiffness, masses, steps, degenerate geometry (methods 2.A, 2.B).

#include "hard/shared_cases.hpp"
#include "hard/vbd_cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("A02: a step beyond any explicit limit is no trouble for vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {0.1, 0, 0}});
        body.springs = {{0, 1, 0, 1e-3}};
        body.pins = {hold({0})};
        Scene scene = by_vbd(alone(body), 1, 1);
        scene.timestep = 1.01 * 0.06324555320336758;
        World world(scene, device);
        run(world, 200);
        CHECK(glm::length(world.positions()[1]) < 1e-6);
        check_sound(world);
    });
}

TEST_CASE("A04: cloth of k = 1e8 hung by one edge stretches little and comes to rest [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(8);
        scene.bodies[0].material.stretch_stiffness = 1e8;
        scene.bodies[0].pins[0].vertices = {0, 1, 2, 3, 4, 5, 6, 7, 8};
        World world(by_vbd(scene, 10, 4), device);
        run(world, steps_for(*device, 300, 60));
        const StepReport report = check_sound(world);
        note("A04", *device, "stretch", report.max_stretch);
        note("A04", *device, "jitter", report.max_speed / std::sqrt(9.81 * std::sqrt(2.0)));
        CHECK(report.max_stretch < 0.05);
        if (steps_for(*device, 1, 0) == 1) // at rest after 5 s; the shorter runs still swing
            CHECK(report.max_speed / std::sqrt(9.81 * std::sqrt(2.0)) < 1e-2);
    });
}

TEST_CASE("A05: springs of 1e3 and 1e6 by turns carry the same tension [hard]")
{
    on_every_device([](const auto& device) {
        std::vector<glm::dvec3> places;
        for (int k = 0; k < 8; ++k)
            places.emplace_back(0, -4.0 * k, 0);
        Body body = particles(places, 1);
        for (std::uint32_t k = 0; k + 1 < 8; ++k)
            body.springs.push_back({k, k + 1, 4, k % 2 == 0 ? 1e-3 : 1e-6});
        body.pins = {hold({0, 7})};
        body.start_positions = places;
        for (std::uint32_t k = 1; k < 8; ++k)
            body.start_positions[k].y -= 0.1 * k; // stretched between its ends
        Scene scene = by_vbd(alone(body), 10, 10);
        scene.damping = 2;
        World world(scene, device);
        double highest = energy(world);
        const double start = highest;
        for (int i = 0; i < steps_for(*device, 60, 20); ++i)
        {
            run(world, 20);
            highest = std::max(highest, energy(world));
        }
        const auto x = world.positions();
        double least = kInfinity, most = 0;
        for (std::uint32_t k = 0; k + 1 < 8; ++k)
        {
            const double tension = (k % 2 == 0 ? 1e3 : 1e6) * (glm::distance(x[k], x[k + 1]) - 4);
            least = std::min(least, tension);
            most = std::max(most, tension);
        }
        note("A05", *device, "tension, most / least", most / least);
        note("A05", *device, "highest energy / start", highest / start);
        if (steps_for(*device, 1, 0) == 1)
            CHECK(most < 1.01 * least);
        CHECK(highest <= start * (1 + 1e-5));
        check_sound(world);
    });
}

TEST_CASE("A06, A07, A08: heavy ropes hang by their springs at every mass ratio, and stay finite [hard]")
{
    on_every_device([](const auto& device) {
        double before = 0;
        for (const double ratio : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5})
        {
            Scene scene = by_vbd(test::chain(20, 1e5, 0.01), 16, 1);
            scene.bodies[0].vertex_masses[20] = 0.01 * ratio;
            scene.damping = 2;
            // One sweep from the adaptive start swings for long (docs).
            scene.method.start = SweepStart::inertial;
            World world(scene, device);
            run(world, steps_for(*device, 600, 60));
            const StepReport report = check_sound(world);
            note("A08", *device, "strain", report.max_stretch);
            if (steps_for(*device, 1, 0) == 1)
                CHECK(report.max_stretch > before);
            before = report.max_stretch;
            CHECK(report.max_stretch < 10);
        }
        for (const auto& [links, mass, end] :
             {std::tuple{20u, 0.5, 900.0}, std::tuple{50u, 0.1, 20.0}}) // AVBD's rope and hanging rope
        {
            Scene scene = by_vbd(test::chain(links, 1e6, mass, links * 0.1), 10, 4);
            scene.bodies[0].vertex_masses[links] = end;
            scene.damping = 1;
            World world(scene, device);
            run(world, steps_for(*device, 300, 30));
            note("A06", *device, "stretch", check_sound(world).max_stretch);
        }
    });
}

TEST_CASE("A10, A13: bad steps are refused; what is held stays bit by bit and costs nothing [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(test::hanging(4));
        scene.bodies[0].material.bending_stiffness = 1e-3;
        World world(scene, device);
        run(world, 3);
        const WorldState before = world.state();
        for (const double bad : {0.0, -1.0 / 60, kNaN, 1e30})
            CHECK(refusal_of([&] { world.set_timestep(bad); }) == "bad_timestep");
        CHECK(same_state(world.state(), before));
        for (std::uint32_t v = 0; v < 25; ++v)
            scene.bodies[0].pins[0].vertices.push_back(v);
        World still(scene, device);
        CHECK(still.plan().passes.size() == 2 * still.plan().substeps);
        const WorldState held = still.state();
        run(still, 30);
        CHECK(same_state(still.state(), held));
        check_sound(still);
    });
}

TEST_CASE("A15: no stiffness, heavy and light masses, under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        Scene soft = by_vbd(test::hanging(4));
        soft.bodies[0].material.stretch_stiffness = 0;
        soft.bodies[0].velocity = {0.3, 1, -0.2};
        Scene limp = soft;
        limp.bodies[0].springs = {{7, 8, 0.1, 1e30}, {8, 9, 0.1, 1e30}};
        World zero(soft, device), loose(limp, device);
        run(zero, 60);
        run(loose, 60);
        CHECK(largest_distance(zero.positions(), loose.positions()) < 1e-6);
        check_sound(loose);
        double worst = 0;
        for (const double heavy : {1.0, 1e12})
            for (const double light : {1.0, 1e-12})
            {
                Body body = particles({{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}});
                body.vertex_masses = {heavy, light, heavy};
                body.springs = {{0, 1, 0.9, 1e-3}, {1, 2, 1.2, 1e-3}};
                body.velocity = {1, 2, 0};
                World world(by_vbd(alone(body), 10, 20), device);
                run(world, 120);
                worst = std::max(worst, check_sound(world).momentum_error);
            }
        note("A15", *device, "momentum error, 20 iterations", worst);
        CHECK(worst < 1e-3);
    });
}

TEST_CASE("A16: a stiff sheet that hung for 2 s and is let go falls as everything does [hard]")
{
    on_every_device([](const auto& device) {
        for (const double stiffness : {1e6, 1e8})
        {
            Scene held = test::hanging(6);
            held.bodies[0].material.stretch_stiffness = stiffness;
            held.damping = 1;
            World rest(by_vbd(held, 1, 4), device);
            run(rest, 120);
            Scene free = held;
            free.damping = 0;
            free.bodies[0].pins.clear();
            free.bodies[0].start_positions = rest.positions();
            World world(by_vbd(free, 1, 4), device);
            const double before = centre_height(world);
            run(world, 60);
            const double fall = before - centre_height(world);
            note("A16", *device, "fall after a pin / right - 1", fall / 4.905 - 1);
            CHECK(fall == Approx(4.905).epsilon(1e-3));
        }
    });
}

TEST_CASE("A16: a stiff sheet on a table that drops away falls at once, also one that a pin holds [hard]")
{
    on_every_device([](const auto& device) {
        for (const bool pinned : {false, true})
        {
            Scene scene = free_cloth(6, 1e7, 1e-3);
            scene.gravity = {0, 0, -9.81};
            if (pinned)
                scene.bodies[0].pins = {hold({0})};
            Collider table;
            table.kind = ColliderKind::plane;
            table.normal = {0, 0, 1};
            table.point = {0, 0, -scene.bodies[0].material.thickness};
            table.motion = {{0, {0, 0, 0}}, {1, {0, 0, 0}}, {1.05, {0, 0, -50}}};
            scene.colliders = {table};
            World world(by_vbd(scene, 1, 6), device);
            run(world, 60);
            const auto before = world.positions();
            CHECK(std::abs(before[48].z) < 1e-4);
            run(world, 6); // two or three of them until the table is gone, then 0.05 s of fall at least
            const double drop = before[48].z - world.positions()[48].z;
            note("A16", *device, pinned ? "drop of the far corner, pinned, m" : "drop, free, m", drop);
            CHECK(drop > 0.8 * 9.81 * 0.05 * 0.05 / 2);
            check_sound(world);
        }
    });
}

TEST_CASE("B01 to B04: no length, no direction, copies a hair apart, under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        Body point = particles({{0, 0, 0}, {0.1, 0, 0}}, 0.1);
        point.springs = {{0, 1, 0, 1.0 / 50}};
        point.pins = {hold({0})};
        Scene scene = by_vbd(alone(point));
        scene.damping = 5;
        World world(scene, device);
        run(world, 600);
        CHECK(glm::length(world.positions()[1]) < 1e-6);
        check_sound(world);
        check_pair_beside_cloth([](const Scene& one) { return by_vbd(one); }, 1e-6, device);
        Scene copies = test::hanging(4);
        Body& body = copies.bodies[0];
        for (std::uint32_t v = 0; v < 25; ++v)
        {
            body.mesh.positions.push_back(body.mesh.positions[v] + glm::dvec3(1e-9, 0, 0));
            body.springs.push_back({v, 25 + v, 1e-9, 1e-4});
        }
        body.mesh.grid_columns = body.mesh.grid_rows = 0;
        World welded(by_vbd(copies), device);
        const double start = energy(welded);
        run(welded, 120);
        CHECK(energy(welded) < start);
        check_sound(welded);
    });
}

TEST_CASE(
    "B10 to B14: folded, collapsed, scrambled and scaled cloth gains no energy and finds its lengths [hard]")
{
    on_every_device([](const auto& device) {
        struct Start
        {
            const char* name;
            double scale, noise;
            bool fold;
        };
        for (const Start& s : {Start{"folded", 1, 0, true}, Start{"point + 1e-6", 0, 1e-6, false},
                               Start{"scrambled", 0, 0.5, false}, Start{"x10", 10, 1e-2, false},
                               Start{"x0.01", 0.01, 1e-5, false}})
        {
            INFO(s.name);
            Scene scene = by_vbd(free_cloth(6, 1000, s.fold ? 1e-2 : 1e-3), 10, 1);
            scene.damping = 0.5;
            conformance::Random random(11);
            for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            {
                const double a = random.uniform(-s.noise, s.noise), b = random.uniform(-s.noise, s.noise);
                const glm::dvec3 place = s.fold ? glm::dvec3(std::abs(x.x), x.y, 0) : x;
                scene.bodies[0].start_positions.push_back(
                    place * s.scale + glm::dvec3(a, b, random.uniform(-s.noise, s.noise)));
            }
            World world(scene, device);
            const double start = energy(world);
            double highest = start;
            for (int i = 0; i < steps_for(*device, 600, 100); ++i)
            {
                world.step();
                highest = std::max(highest, energy(world));
            }
            note("B10..B14", *device, (std::string(s.name) + ": highest energy / start").c_str(),
                 highest / start);
            note("B10..B14", *device, (std::string(s.name) + ": largest strain at the end").c_str(),
                 largest_strain(world));
            CHECK(highest <= start * 1.01);
            CHECK(finite(world.positions()));
            CHECK(to_string(measure(world).status) == "completed");
        }
    });
}
