// Hard cases of position-based dynamics (methods 2.A, 2.B, 2.C, 2.F, 2.G), under every scheme.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

constexpr const char* kSchemes[] = {"coloured", "node_centric", "constraint_centric"};

Scene as_pbd(Scene scene, const char* scheme, std::uint32_t iterations = 4)
{
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = option_named<ElementScheme>(scheme);
    scene.method.substeps = 2;
    scene.method.iterations = iterations;
    scene.method.stretch = 0.9;
    scene.method.bend = 0.5;
    scene.accept.stretch = 2; // tests of what sweeps do, not of what they solve
    return scene;
}

/// Calls f(device, scheme) for each executor and scheme.
template <typename F>
void under_every_scheme(F&& f)
{
    on_every_device([&](const auto& device) {
        for (const char* scheme : kSchemes)
        {
            INFO(scheme);
            f(device, scheme);
        }
    });
}

} // namespace

TEST_CASE("pbd A06, A08: heavy ropes stretch far, stay finite, and further with the mass ratio [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        double before = -1;
        for (const double ratio : {1.0, 100.0, 1e4})
        {
            Scene scene = as_pbd(test::chain(20, 1e5, 0.01), scheme);
            scene.bodies[0].vertex_masses.back() = 0.01 * ratio;
            scene.damping = 2;
            World world(scene, device);
            run(world, steps_for(*device, 600, 120));
            const StepReport report = check_lasting(world);
            note("pbd A06", *device, "largest strain", report.max_stretch);
            CHECK(report.max_stretch > before);
            CHECK(report.max_stretch < 1e4);
            before = report.max_stretch;
        }
    });
}

TEST_CASE("pbd A10: time steps of zero, below zero, NaN and 1e30 are refused [hard]")
{
    for (const double h : {0.0, -1.0, kNaN, 1e30})
    {
        Scene scene = as_pbd(free_cloth(2), "node_centric");
        scene.timestep = h;
        CHECK(refusal_of([&] { World world(scene, test_device("cpu:serial")); }) == "bad_timestep");
    }
}

TEST_CASE("pbd A13, F07: a body whose vertices are all held keeps its bits and costs no pass [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene scene = as_pbd(test::hanging(2), scheme);
        for (std::uint32_t v = 0; v < 9; ++v)
            scene.bodies[0].pins[0].vertices.push_back(v);
        scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
        scene.bodies[0].start_positions[0].x -= 0.5;
        World world(scene, device);
        CHECK(world.plan().passes.size() == 2 * 2);
        const auto start = world.positions();
        run(world, 30);
        CHECK(world.positions() == start);
        check_sound(world, {"conflict"});
    });
}

TEST_CASE("pbd A15: no stiffness is free flight, bit for bit; masses of 1e12 and 1e-12 do no harm [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene scene = as_pbd(test::hanging(3), scheme);
        scene.method.stretch = 0;
        Scene loose = scene;
        loose.bodies[0].material.stretch_stiffness = 0;
        World world(scene, device), free(loose, device);
        run(world, 30);
        run(free, 30);
        CHECK(same_state(world.state(), free.state()));
        for (const double mass : {1e12, 1e-12})
        {
            Scene odd = as_pbd(test::hanging(3), scheme);
            odd.bodies[0].vertex_masses.assign(16, mass);
            World heavy(odd, device);
            run(heavy, 60);
            CHECK(check_sound(heavy).max_stretch < 1);
        }
    });
}

TEST_CASE("pbd B01 to B03: no rest length, coincident ends and ends a hair apart stay finite [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Body point = particles({{0, 0, 0}, {0.1, 0, 0}}, 0.1);
        point.springs = {{0, 1, 0, 1e-3}};
        point.pins = {hold({0})};
        World together(as_pbd(alone(point), scheme), device);
        run(together, 300);
        CHECK(glm::length(together.positions()[1]) < 1e-6);
        check_sound(together);
        for (const double apart : {0.0, 1e-30, 1e-20, 1e-15})
        {
            Scene scene = test::hanging(4);
            Body pair = particles({{0, 0, 0}, {apart, 0, 0}}, 0.1);
            pair.springs = {{0, 1, 0.1, 0}};
            scene.bodies.push_back(pair);
            World world(as_pbd(scene, scheme), device), solo(as_pbd(test::hanging(4), scheme), device);
            run(world, 30);
            run(solo, 30);
            const auto x = world.positions(), y = solo.positions();
            const bool skipped = glm::distance(x[25], x[26]) < 1e-10;
            check_sound(world, skipped ? Words{"degenerate"} : Words{});
            CHECK((skipped || glm::distance(x[25], x[26]) > 0.09));
            if (apart == 0 || apart >= 1e-15) // between them squares may underflow
                CHECK(skipped == (apart == 0));
            CHECK(std::equal(y.begin(), y.end(), x.begin())); // the sheet does not notice
        }
    });
}

TEST_CASE("pbd B17: hinges without an edge or an area, flat and folded ones stay finite [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        struct Fold
        {
            glm::dvec3 wing;
            bool counted, bursts;
        };
        // Rest: flat. Flat, folded onto itself (half of a turn in a step, which is called what it is), on the
        // edge, at a corner.
        for (const Fold& fold : {Fold{{-1, 0.5, 0}, false, false}, Fold{{1, 0.5, 1e-9}, false, true},
                                 Fold{{0, 0.5, 0}, true, false}, Fold{{0, 0, 0}, true, false}})
        {
            Body body;
            body.shape.kind = ShapeKind::mesh;
            body.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-1, 0.5, 0}};
            body.mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
            body.material.bending_stiffness = 0.1;
            body.start_positions = body.mesh.positions;
            body.start_positions[3] = fold.wing;
            Scene scene = as_pbd(alone(body), scheme);
            scene.method.stretch = 0;
            World world(scene, device);
            run(world, 10);
            if (!fold.bursts)
                check_sound(world, fold.counted ? Words{"degenerate"} : Words{});
            CHECK(finite(world.positions()));
            CHECK((measure(world).status == Status::diverged) == fold.bursts);
        }
    });
}

TEST_CASE("pbd B18: cloth hangs 10 km from the origin as it does at the origin [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene near = as_pbd(test::hanging(5), scheme), far = near;
        const glm::dvec3 away(1e4, -1e4, 1e4);
        for (glm::dvec3& x : far.bodies[0].mesh.positions)
            x += away;
        World at_origin(near, device), at_distance(far, device);
        run(at_origin, 60);
        run(at_distance, 60);
        auto moved = at_distance.positions();
        for (glm::dvec3& x : moved)
            x -= away;
        const double apart = largest_distance(moved, at_origin.positions());
        note("pbd B18", *device, "distance of the two, m", apart);
        CHECK(apart < 1e-6);
        check_sound(at_distance);
    });
}

TEST_CASE("pbd B19: lengths and masses in units of powers of two give the same bits [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        const auto moved = [&](double length, double mass) {
            Scene scene = as_pbd(free_cloth(4), scheme);
            scene.gravity = {0, -9.81 * length, 0};
            Body& body = scene.bodies[0];
            body.pins = {hold({0})};
            body.material.density *= mass / (length * length);
            body.material.thickness *= length;
            for (glm::dvec3& x : body.mesh.positions)
                x *= length;
            World world(scene, device);
            run(world, 30);
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
        }
    });
}

TEST_CASE("pbd C03: a star of 10,000 springs takes few passes and stays finite [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Body body = particles(std::vector<glm::dvec3>(10001, glm::dvec3(0)), 0.01);
        for (std::uint32_t v = 1; v <= 10000; ++v)
        {
            body.mesh.positions[v] = {std::cos(0.1 * v), std::sin(0.1 * v), 1e-4 * v};
            body.springs.push_back({0, v, 1.0, 0.0});
        }
        Scene scene = as_pbd(alone(body), scheme, 2);
        World world(scene, device);
        note("pbd C03", *device, "passes a step", double(world.plan().passes.size()));
        CHECK(world.plan().passes.size() < 100);
        run(world, 2);
        check_sound(world);
    });
}

TEST_CASE("pbd C06, F04: a doubled spring gives no NaN and hangs as a single one does [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Body body = particles({{0, 0, 0}, {0, -1, 0}}, 0.1);
        body.springs = {{0, 1, 1, 1e-3}, {0, 1, 1, 1e-3}};
        body.pins = {hold({0})};
        Scene scene = as_pbd(alone(body), scheme);
        scene.gravity = {0, -9.81, 0};
        World world(scene, device);
        run(world, 60);
        CHECK(std::abs(world.positions()[1].y + 1) < 1e-3);
        check_sound(world);
    });
}

TEST_CASE("pbd F06: three lengths that cannot all hold share what is left [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Body body = particles({{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}}, 0.1);
        body.springs = {{0, 1, 1, 0}, {1, 2, 1, 0}, {2, 0, 3, 0}};
        Scene scene = as_pbd(alone(body), scheme);
        scene.damping = 5;
        World world(scene, device);
        run(world, 600);
        const auto x = world.positions();
        const double left[] = {glm::distance(x[0], x[1]) - 1, glm::distance(x[1], x[2]) - 1,
                               glm::distance(x[2], x[0]) - 3};
        for (const double c : left)
        {
            note("pbd F06", *device, "what is left, m", c);
            CHECK(std::abs(c) < 1.1);
        }
        check_sound(world);
    });
}

TEST_CASE("pbd F13: a corner dragged ten times the cloth's size in a second leaves it finite [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene scene = test::hanging(6);
        Pin pin = hold({48});
        pin.motion = {{0, {0, 0, 0}}, {1, {10, 0, 0}}};
        scene.bodies[0].pins.push_back(pin);
        World world(as_pbd(scene, scheme), device);
        run(world, 90);
        const StepReport report = check_lasting(world);
        note("pbd F13", *device, "largest strain", report.max_stretch);
        CHECK(report.max_stretch < 100);
    });
}

TEST_CASE("pbd G03, G04: a blow of 1e6 N s / kg and a gravity that flips stay finite [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene scene = as_pbd(test::hanging(4), scheme);
        scene.external_forces = true;
        scene.max_speed = 100;
        World world(scene, device);
        world.set_force(12, {0, 0, 1e6});
        world.step();
        world.set_force(12, {0, 0, 0});
        run(world, 120);
        CHECK(check_sound(world, {"speed_clamp"}).max_stretch < 1);
        World flipped(as_pbd(test::hanging(4), scheme), device);
        for (int i = 0; i < 60; ++i)
        {
            flipped.set_gravity({0, i % 2 == 0 ? -1e4 : 1e4, 0});
            flipped.step();
        }
        CHECK(to_string(measure(flipped).status) == "completed");
    });
}

TEST_CASE("pbd G06, G07, G09: runs, copies of a body and restarts repeat bit for bit [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        Scene scene = as_pbd(test::hanging(5), scheme, 3); // odd: Jacobi ends in the other buffer
        scene.method.substeps = 1;
        scene.bodies[0].material.bending_stiffness = 1e-3;
        scene.bodies.push_back(scene.bodies[0]);
        World world(scene, device), again(scene, device);
        run(world, 20);
        run(again, 20);
        CHECK(same_state(world.state(), again.state()));
        const auto x = world.positions();
        CHECK(std::equal(x.begin(), x.begin() + 36, x.begin() + 36));
        World restarted(scene, device);
        restarted.restore(world.state());
        run(world, 10);
        run(restarted, 10);
        CHECK(same_state(world.state(), restarted.state()));
    });
}

TEST_CASE("pbd: contacts and friction act on the newest iterate of Jacobi [hard]")
{
    under_every_scheme([](const auto& device, const char* scheme) {
        for (const std::uint32_t iterations : {1u, 3u, 4u})
        {
            Scene scene = as_pbd(test::everything(6), scheme, iterations);
            World world(scene, device);
            run(world, 60);
            const StepReport report = measure(world);
            note("pbd contact", *device, "deepest, m", report.penetration);
            CHECK(to_string(report.status) == "completed");
            CHECK(report.penetration < 1e-3);
        }
    });
}
