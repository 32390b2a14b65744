// Hard cases for vertex block descent with springs and hinges (methods 2.A to 2.G).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Scene by_vbd(Scene scene, std::uint32_t substeps = 10, std::uint32_t iterations = 2)
{
    scene.method.type = "vbd";
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return scene;
}

double centre_height(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    double sum = 0, mass = 0;
    const auto x = world.positions();
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        sum += model.mass[v] * x[v].y;
        mass += model.mass[v];
    }
    return sum / mass;
}

/// Largest |l - L| / L over the springs.
double largest_strain(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    const auto x = world.positions();
    double worst = 0;
    for (const StretchElement& s : model.springs)
        worst = std::max(worst, std::abs(glm::distance(x[s.a], x[s.b]) / s.rest_length - 1));
    return worst;
}

} // namespace

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
            scene.method.start = "inertial"; // one sweep from the adaptive start swings for long (docs)
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
            note("A16", *device, "fall after a pin / right - 1", fall / 4.98675 - 1);
            CHECK(fall == Approx(4.98675).epsilon(1e-3));
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
            World world(by_vbd(scene, 1, 4), device);
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
        for (const double apart : {0.0, 1e-15, 1e-20, 1e-30, 1e-45})
        {
            INFO(apart);
            Scene two = by_vbd(test::hanging(4));
            Body pair = particles({{0, 0, 0}, {apart, 0, 0}}, 0.1);
            pair.springs = {{0, 1, 0.1, 1e-6}};
            two.bodies.push_back(pair);
            World both(two, device), solo(by_vbd(test::hanging(4)), device);
            run(both, 30);
            run(solo, 30);
            const auto x = both.positions(), y = solo.positions();
            const double gap = glm::distance(x[25], x[26]);
            check_sound(both, gap < 1e-10 ? Words{"degenerate"} : Words{});
            if (apart == 0)
                CHECK(measure(both).warnings.at("degenerate") == 30);
            CHECK(gap < 0.3);
            CHECK(std::equal(y.begin(), y.end(), x.begin()));
        }
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

TEST_CASE("B16: what is at rest stays at rest under vertex block descent, from every start [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* start : {"adaptive", "inertial", "previous"})
        {
            Scene scene = by_vbd(free_cloth(6, 1e4, 1e-3));
            scene.method.start = start;
            scene.bodies[0].material.stretch_damping = 1e-3;
            World world(scene, device);
            const auto before = world.positions();
            run(world, steps_for(*device, 1000, 100));
            const StepReport report = check_sound(world);
            const double drift = largest_distance(world.positions(), before) / std::sqrt(2.0);
            note("B16", *device, start, drift);
            CHECK(drift < 1e-6);
            CHECK(report.kinetic_energy < 1e-10 * 0.2 * 9.81 * std::sqrt(2.0));
        }
    });
}

TEST_CASE("B18, B19: far away and in other units vertex block descent moves cloth as here [hard]")
{
    Scene near = by_vbd(test::hanging(6));
    near.bodies[0].material.bending_stiffness = 1e-4;
    near.bodies[0].material.stretch_damping = 1e-3;
    Scene exact = near;
    exact.method.precision = "double";
    World truth(exact, test_device("cpu:serial"));
    run(truth, 60);
    Scene far = near, large = near;
    for (glm::dvec3& x : far.bodies[0].mesh.positions)
        x += glm::dvec3(1e4, -1e4, 1e4);
    large.gravity *= 1024.0;
    large.bodies[0].material.density /= 1024.0 * 1024;
    large.bodies[0].material.bending_stiffness *= 1024.0 * 1024;
    for (glm::dvec3& x : large.bodies[0].mesh.positions)
        x *= 1024.0;
    on_every_device([&](const auto& device) {
        World at_origin(near, device), at_distance(far, device), in_units(large, device);
        for (World* world : {&at_origin, &at_distance, &in_units})
            run(*world, 60);
        auto moved = at_distance.positions(), scaled = in_units.positions();
        for (std::size_t v = 0; v < moved.size(); ++v)
        {
            moved[v] -= glm::dvec3(1e4, -1e4, 1e4);
            scaled[v] /= 1024.0;
        }
        const double origin = largest_distance(at_origin.positions(), truth.positions());
        const double distance = largest_distance(moved, truth.positions());
        note("B18", *device, "error at the origin, m", origin);
        note("B18", *device, "error at 1e4 m, m", distance);
        CHECK(distance < 10 * origin + 1e-7);
        CHECK(scaled == at_origin.positions());
    });
}

TEST_CASE("C01 to C08: fans, stars, loners and twins under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        std::vector<glm::dvec3> places = {{0, 0, 0}};
        for (int k = 0; k < 10000; ++k)
            places.emplace_back(std::cos(k * 0.1), std::sin(k * 0.1), 1e-4 * k);
        Body star = particles(places, 1e-3);
        star.vertex_masses[0] = 100;
        for (std::uint32_t k = 1; k <= 10000; ++k)
            star.springs.push_back({0, k, 1, 1e-3});
        World world(by_vbd(alone(star), 2, 1), device);
        CHECK(world.plan().passes.size() <= 2u * (4 + 3)); // two colours
        run(world, 5);
        check_sound(world);

        Body loner = particles({{0, 3, 0}}), twins = particles({{0, 0, 0}, {1.5, 0, 0}});
        twins.springs = {{0, 1, 1, 1e-2}, {0, 1, 1, 1e-2}};
        Body one = particles({{0, 0, 0}, {1.5, 0, 0}});
        one.springs = {{0, 1, 1, 0.5e-2}};
        Scene scene = by_vbd(alone(loner), 10, 2);
        scene.gravity = {0, -9.81, 0};
        scene.bodies = {loner, twins, one};
        World several(scene, device);
        run(several, 60);
        const auto x = several.positions();
        CHECK(3 - x[0].y == Approx(9.81 * 601 / 1200).epsilon(1e-5));
        CHECK(glm::distance(x[1], x[2]) == Approx(glm::distance(x[3], x[4])).epsilon(1e-5));
        check_sound(several);
        World nothing(by_vbd(Scene{}), device);
        nothing.step();
        CHECK(nothing.plan().passes.empty());
    });
}

TEST_CASE("E03, E05, E10: a fast ball, a floor, a pin inside, under vertex block descent [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(free_cloth(8, 1e4, 1e-4), 10, 2);
        scene.gravity = {0, 0, -9.81};
        Collider floor;
        floor.kind = ColliderKind::plane;
        floor.normal = {0, 0, 1};
        floor.point = {0, 0, -0.01};
        floor.friction = 0.5;
        scene.colliders = {floor};
        World lying(scene, device);
        run(lying, steps_for(*device, 600, 120));
        const auto before = lying.positions();
        run(lying, 60);
        const StepReport rest = check_sound(lying);
        note("E05", *device, "jitter", rest.max_speed / std::sqrt(9.81 * std::sqrt(2.0)));
        CHECK(rest.max_speed / std::sqrt(9.81 * std::sqrt(2.0)) < 1e-3);
        CHECK(largest_distance(lying.positions(), before) < 1e-3);
        CHECK(rest.penetration < 1e-6);

        Collider ball;
        ball.point = {0, 0, -1.2};
        ball.radius = 0.3;
        ball.friction = 0.3;
        ball.motion = {{0, {0, 0, 0}}, {0.05, {0, 0, 1}}, {1, {0, 0, 1}}};
        scene.colliders = {ball};
        scene.bodies[0].pins = {hold({0, 8})};
        World hit(scene, device);
        run(hit, 60);
        const StepReport report = check_sound(hit);
        note("E03", *device, "stretch after 1 s", report.max_stretch);
        CHECK(report.penetration < 0.01 * 0.3);

        scene.colliders[0].motion.clear();
        scene.colliders[0].point = scene.bodies[0].mesh.positions[0];
        World pinned(scene, device);
        run(pinned, 60);
        check_sound(pinned, {"conflict"});
        CHECK(pinned.positions()[0] == scene.bodies[0].mesh.positions[0]);
    });
}

TEST_CASE("E06, E07: friction under vertex block descent slides and sticks as Coulomb says [hard]")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t iterations : {1u, 5u})
            for (const double friction : {0.1, 0.5})
            {
                Scene scene = by_vbd(free_cloth(2, 1e5, 1e-3), 10, iterations);
                scene.gravity = {0, 0, -9.81};
                scene.bodies[0].velocity = {10, 0, 0};
                Collider floor;
                floor.kind = ColliderKind::plane;
                floor.normal = {0, 0, 1};
                floor.point = {0, 0, -scene.bodies[0].material.thickness};
                floor.friction = friction;
                scene.colliders = {floor};
                World world(scene, device);
                const double from = world.positions()[4].x, exact = 100 / (2 * friction * 9.81);
                run(world, static_cast<int>(60 * 1.2 * 10 / (friction * 9.81)));
                const double way = world.positions()[4].x - from;
                note("E07", *device, "way / exact - 1", way / exact - 1);
                CHECK(std::abs(way - exact) < std::max(0.02 * exact, 10.0 / 60));
            }
        for (const double friction : {0.49, 0.5, 0.7})
        {
            const double angle = std::atan(0.5);
            Scene scene = by_vbd(free_cloth(2, 1e5, 1e-3), 10, 2);
            scene.method.start = "inertial"; // from where it was, a stiff sheet starts to slide late (docs)
            scene.gravity = {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)};
            Collider floor;
            floor.kind = ColliderKind::plane;
            floor.normal = {0, 0, 1};
            floor.point = {0, 0, -scene.bodies[0].material.thickness};
            floor.friction = friction;
            scene.colliders = {floor};
            World world(scene, device);
            const double from = world.positions()[4].x;
            run(world, 60);
            const double way = world.positions()[4].x - from;
            note("E06", *device, "way in 1 s", way);
            if (friction == 0.49)
                CHECK(way == Approx(0.043872).epsilon(0.2));
            else
                CHECK(std::abs(way) < 1e-3);
        }
    });
}

TEST_CASE("G03 to G09 under vertex block descent: blows, flips, twins, copies, halves of a run [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = by_vbd(test::everything(4), 4, 2);
        scene.bodies[0].material.stretch_damping = 1e-4;
        World once(scene, device), twice(scene, device), rest(scene, device);
        CHECK(refusal_of([&] { once.set_force(5, {kNaN, 0, 0}); }) == "bad_input");
        run(once, 40);
        run(twice, 17);
        rest.restore(twice.state());
        run(twice, 23);
        run(rest, 23);
        CHECK(same_state(once.state(), twice.state()));
        CHECK(same_state(once.state(), rest.state()));
        check_sound(rest);

        Scene crowd = scene, single = scene;
        single.bodies[0].pins.clear();
        crowd.bodies.clear();
        crowd.bodies.resize(3, single.bodies[0]);
        crowd.bodies.push_back(test::chain(7, 100, 0.01).bodies[0]);
        World solo(single, device), all(crowd, device);
        run(solo, 30);
        run(all, 30);
        const auto x = solo.positions(), y = all.positions();
        bool copies = true;
        for (std::size_t v = 0; v < 3 * x.size(); ++v)
            copies = copies && y[v] == x[v % x.size()];
        CHECK(copies);

        World blown(scene, device);
        run(blown, 10);
        blown.set_force(12, {0, 0, 1e6});
        run(blown, 1);
        blown.set_force(12, {0, 0, 0});
        run(blown, 120);
        CHECK(finite(blown.positions()));
        CHECK(to_string(measure(blown).status) == "completed");
        glm::dvec3 gravity = {0, -1e4, 0};
        for (int i = 0; i < 60; ++i)
        {
            blown.set_gravity(gravity);
            blown.step();
            gravity = -gravity;
        }
        CHECK(finite(blown.positions()));
        CHECK(finite(blown.velocities()));
    });
}

TEST_CASE("a Chebyshev radius that is far too high ends in no explosion, at any number of iterations [hard]")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t iterations : {4u, 8u, 12u, 30u})
            for (const double radius : {0.5, 0.99, 0.99999})
            {
                INFO(iterations << ", " << radius);
                Scene scene = by_vbd(test::everything(4), 1, iterations);
                scene.method.spectral_radius = radius;
                World world(scene, device);
                run(world, 60);
                CHECK(finite(world.positions()));
                const StepReport report = measure(world);
                CHECK(to_string(report.status) == "completed");
                CHECK(report.max_stretch < 1);
                CHECK(report.max_speed < 20);
            }
    });
}

TEST_CASE("any stiffness, any step, any start: vertex block descent stays finite [hard]")
{
    on_every_device([](const auto& device) {
        conformance::Random random(5);
        for (int draw = 0; draw < 12; ++draw)
        {
            Scene scene =
                free_cloth(4, std::pow(10.0, random.uniform(-3, 14)), std::pow(10.0, random.uniform(-8, 4)));
            scene.gravity = {0, -random.uniform(0, 1000), 0};
            scene.timestep = std::pow(10.0, random.uniform(-6, 0));
            const std::uint32_t substeps = 1 + random.below(20), iterations = 1 + random.below(4);
            const double size = std::pow(10.0, random.uniform(-3, 3));
            for (std::size_t v = 0; v < 25; ++v)
            {
                const double x = random.uniform(-size, size), y = random.uniform(-size, size);
                scene.bodies[0].start_positions.emplace_back(x, y, random.uniform(-size, size));
            }
            INFO("draw " << draw);
            World world(by_vbd(scene, substeps, iterations), device);
            run(world, 30);
            check_sound(world);
        }
    });
}
