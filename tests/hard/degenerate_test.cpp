// Degenerate geometry (methods 2.B B01 to B04, B18, B19) and constraint ends (2.F F16, F17).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("B01: a spring without rest length pulls with k d and comes to a point [hard]")
{
    on_every_device([](const auto& device) {
        Body body = particles({{0, 0, 0}, {0.1, 0, 0}}, 0.1);
        body.springs = {{0, 1, 0, 1.0 / 50}};
        body.pins = {hold({0})};
        Scene scene = alone(body);
        scene.timestep = 1.0 / 6000;
        scene.method.substeps = 1;
        World world(scene, device);
        world.step();
        const double force = 0.1 * -world.velocities()[1].x * 6000;
        note("B01", *device, "force / (k d)", force / 5);
        CHECK(force == Approx(5).epsilon(1e-4)); // implicit: less by h^2 k / m = 1.4e-5
        scene.timestep = 1.0 / 60;
        scene.method.substeps = 10;
        scene.damping = 5;
        World long_run(scene, device);
        run(long_run, 600);
        const double left = glm::length(long_run.positions()[1]);
        note("B01", *device, "distance left, m", left);
        CHECK(left < 1e-6);
        check_sound(long_run);
    });
}

namespace {

/// A hanging sheet with a second body beside it: two particles `apart` with a spring of 0.1 m.
Scene with_pair(double apart, std::uint32_t iterations)
{
    Scene scene = test::hanging(4);
    scene.method.iterations = iterations;
    Body pair = particles({{0, 0, 0}, {apart, 0, 0}}, 0.1);
    pair.springs = {{0, 1, 0.1, 0}};
    scene.bodies.push_back(pair);
    return scene;
}

bool same_sheet(const World& world, const World& solo)
{
    const auto x = world.positions(), y = solo.positions();
    return std::equal(y.begin(), y.end(), x.begin());
}

} // namespace

TEST_CASE("B02: coincident ends are skipped, counted and harm nobody else [hard]")
{
    for (const std::uint32_t iterations : {1u, 2u})
        on_every_device([&](const auto& device) {
            World world(with_pair(0, iterations), device);
            Scene alone_scene = test::hanging(4);
            alone_scene.method.iterations = iterations;
            World solo(alone_scene, device);
            run(world, 60);
            run(solo, 60);
            const StepReport report = check_sound(world, {"degenerate"});
            CHECK(report.warnings.at("degenerate") == 60);
            CHECK(same_sheet(world, solo));
            const auto x = world.positions();
            CHECK(x[25] == x[26]); // both fall, together
            CHECK(x[25].y < -4.9);
        });
}

TEST_CASE("B02: a vertex that coincides with its neighbours does not stop the others of its cloth [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = free_cloth(4);
        scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
        scene.bodies[0].start_positions[12] = scene.bodies[0].start_positions[13];
        World world(scene, device);
        run(world, 300);
        const StepReport report = check_sound(world); // apart before the first report
        note("B02", *device, "max stretch after 5 s", report.max_stretch);
        CHECK(report.max_stretch < 1e-4); // the neighbours pull the two apart
    });
}

TEST_CASE("B03: ends 1e-20 and 1e-30 m apart give no infinity [hard]")
{
    for (const double apart : {1e-15, 1e-20, 1e-22, 1e-30, 1e-38, 1e-45})
        for (const std::uint32_t iterations : {1u, 2u})
            on_every_device([&](const auto& device) {
                INFO(apart);
                Scene scene = with_pair(apart, iterations);
                scene.gravity = {0, 0, 0};
                World world(scene, device);
                run(world, 30);
                const auto x = world.positions();
                const double gap = glm::distance(x[25], x[26]);
                // Where squares underflow the ends count as coincident; else the rest length is there at
                // once.
                check_sound(world, gap < 1e-10 ? Words{"degenerate"} : Words{});
                CHECK((gap >= 0.099 || gap <= 2 * apart));
                if (apart >= 1e-15)
                    CHECK(gap >= 0.099);
                char what[40];
                std::snprintf(what, sizeof what, "start %.1e: gap after 30 steps, m", apart);
                note("B03", *device, what, gap);
            });
}

TEST_CASE("B04: copies of vertices 1e-9 m apart, joined by springs, stay finite and gain no energy [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(4);
        Body& body = scene.bodies[0];
        const std::uint32_t n = 25;
        for (std::uint32_t v = 0; v < n; ++v)
        {
            body.mesh.positions.push_back(body.mesh.positions[v] + glm::dvec3(1e-9, 0, 0));
            body.springs.push_back({v, n + v, 1e-9, 1e-4});
        }
        body.mesh.grid_columns = body.mesh.grid_rows = 0;
        World world(scene, device);
        const double start = energy(world);
        double highest = start;
        for (int i = 0; i < 60; ++i)
        {
            run(world, 2);
            highest = std::max(highest, energy(world));
        }
        const StepReport report = measure(world);
        CHECK(to_string(report.status) == "completed");
        CHECK(finite(world.positions()));
        double apart = 0;
        const auto x = world.positions();
        for (std::uint32_t v = 0; v < n; ++v)
            apart = std::max(apart, glm::distance(x[v], x[n + v]));
        note("B04", *device, "largest gap of copies, m", apart);
        note("B04", *device, "highest energy above the start, J", highest - start);
        // One sweep a substep lets the energy of hanging cloth swing by 0.1 % of its weight times its size
        // (tests/physics); the copies add nothing that grows.
        CHECK(highest - start < 2e-3 * 0.4 * 9.81 * std::sqrt(2.0));
        CHECK(energy(world) < start);
        CHECK(apart < 0.001);
    });
}

TEST_CASE("B18: cloth hangs 10 km from the origin as it does at the origin [hard]")
{
    Scene near = test::hanging(6);
    near.bodies[0].material.bending_stiffness = 1e-4;
    Scene exact = near;
    exact.method.precision = Precision::float64;
    World truth(exact, test_device("cpu:serial"));
    run(truth, 60);
    const auto wanted = truth.positions();
    Scene far = near;
    const glm::dvec3 away(1e4, -1e4, 1e4);
    for (glm::dvec3& x : far.bodies[0].mesh.positions)
        x += away;
    on_every_device([&](const auto& device) {
        World at_origin(near, device), at_distance(far, device);
        run(at_origin, 60);
        run(at_distance, 60);
        const double origin = largest_distance(at_origin.positions(), wanted);
        auto moved = at_distance.positions();
        for (glm::dvec3& x : moved)
            x -= away;
        const double distance = largest_distance(moved, wanted);
        note("B18", *device, "error at the origin, m", origin);
        note("B18", *device, "error at 1e4 m, m", distance);
        CHECK(distance < 10 * origin);
        CHECK(distance < 1e-6);
        CHECK(at_distance.plan().warnings.empty());
        check_sound(at_distance);
    });
    far.colliders.resize(1); // of which one float places the centre
    REQUIRE(make_plan(far).warnings.size() == 1);
    CHECK(make_plan(far).warnings[0].word == "precision");
}

namespace {

/// The scene with lengths counted in units of 1/length m and masses in units of 1/mass kg.
Scene in_units(Scene s, double length, double mass)
{
    s.gravity *= length;
    s.depenetration_speed *= length;
    for (Body& body : s.bodies)
    {
        body.material.density *= mass / (length * length);
        body.material.stretch_stiffness *= mass;
        body.material.bending_stiffness *= mass * length * length;
        body.material.thickness *= length;
        body.mesh.link_width *= length;
        for (glm::dvec3& x : body.mesh.positions)
            x *= length;
        for (Pin& pin : body.pins)
            for (Keyframe& key : pin.motion)
                key.translate *= length;
    }
    for (Collider& c : s.colliders)
    {
        c.point *= length;
        c.radius *= length;
    }
    return s;
}

} // namespace

TEST_CASE("B19: millimetres, kilometres and grams give the same motion; powers of two the same bits [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::everything(6);
        const auto moved = [&](double length, double mass) {
            World world(in_units(scene, length, mass), device);
            run(world, steps_for(*device, 30, 20));
            check_sound(world);
            auto x = world.positions();
            for (glm::dvec3& p : x)
                p /= length;
            return x;
        };
        const auto metres = moved(1, 1);
        for (const double unit : {0x1p10, 0x1p-10})
        {
            CHECK(moved(unit, 1) == metres);
            CHECK(moved(1, unit) == metres);
            CHECK(moved(unit, 1 / unit) == metres);
        }
        const auto difference = [&](const std::vector<glm::dvec3>& wanted) {
            double worst = 0;
            for (const double unit : {1e3, 1e-3})
                for (const auto& x : {moved(unit, 1), moved(1, unit)})
                    worst = std::max(worst, largest_distance(x, wanted) / std::sqrt(2.0));
            return worst;
        };
        // Other powers round every input differently; contact and friction make more of it than hanging does.
        note("B19", *device, "mm, km, g, t: difference / D, every effect, float", difference(metres));
        scene.method.precision = Precision::float64;
        const double exact = difference(moved(1, 1));
        scene = test::hanging(6);
        scene.bodies[0].material.bending_stiffness = 1e-5;
        const double hanging = difference(moved(1, 1));
        note("B19", *device, "mm, km, g, t: difference / D, every effect, double", exact);
        note("B19", *device, "mm, km, g, t: difference / D, hanging, float", hanging);
        CHECK(exact < 1e-5);
        CHECK(hanging < 1e-5);
    });
}

TEST_CASE("F16: a rigid spring between ends without inverse mass divides by nothing [hard]")
{
    on_every_device([](const auto& device) {
        // The plan leaves such springs out; the hinges of a cloth with one free vertex still meet them.
        Scene scene = free_cloth(2, kInfinity, 1e30);
        scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
        scene.bodies[0].start_positions[4].z = 0.1;
        scene.bodies[0].pins = {hold({0, 1, 2, 3, 5, 6, 7, 8})};
        scene.bodies[0].springs = {{0, 1, 0.7, 0}, {2, 6, 0, 0}};
        for (const std::uint32_t iterations : {1u, 3u})
        {
            scene.method.iterations = iterations;
            World world(scene, device);
            const auto start = world.positions();
            run(world, 60);
            const auto end = world.positions();
            CHECK(glm::length(end[4]) < 1e-6);
            check_sound(world, {"conflict"});
            for (std::size_t v = 0; v < 9; ++v)
                if (v != 4)
                    CHECK(end[v] == start[v]);
            REQUIRE(world.plan().warnings.size() == 1);
            CHECK(world.plan().warnings[0].count == 2);
        }
    });
}

TEST_CASE("F17: compliance 0 is rigid, 1e12 is free flight, between them the static length is right [hard]")
{
    on_every_device([](const auto& device) {
        for (const double compliance : {0.0, 1e-12, 1.0, 1e12})
        {
            INFO(compliance);
            Body body = particles({{0, 0, 0}, {0, -1, 0}}, 0.1);
            body.springs = {{0, 1, 1, compliance}};
            body.pins = {hold({0})};
            Scene scene = alone(body);
            scene.gravity = {0, -9.81, 0};
            if (compliance > 1)
            {
                World world(scene, device);
                run(world, 60);
                const double fall = 9.81 * world.time() * world.time() / 2;
                const double error = std::abs(-world.positions()[1].y - 1 - fall) / fall;
                note("F17", *device, "1e12: error of free flight", error);
                CHECK(error < 1e-4);
                check_sound(world);
                continue;
            }
            scene.damping = 3;
            World world(scene, device);
            run(world, 600);
            const double stretch = -world.positions()[1].y - 1, exact = 0.1 * 9.81 * compliance;
            note("F17", *device, "static length, error, m", std::abs(stretch - exact));
            CHECK(std::abs(stretch - exact) < 1e-5 * (1 + exact));
            check_sound(world);
        }
    });
}
