// Topology (methods 2.C C01, C02, C05 to C08).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Body mesh_body(std::vector<glm::dvec3> places, std::vector<std::array<std::uint32_t, 3>> triangles)
{
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh.positions = std::move(places);
    body.mesh.triangles = std::move(triangles);
    body.material.stretch_stiffness = 1000;
    body.material.bending_stiffness = 1e-3;
    return body;
}

/// Triangles round a vertex, closed.
Body fan(std::uint32_t triangles)
{
    std::vector<glm::dvec3> places = {{0, 0, 0}};
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::uint32_t k = 0; k < triangles; ++k)
    {
        const double angle = 2 * 3.14159265358979323846 * k / triangles;
        places.emplace_back(std::cos(angle), 0, std::sin(angle));
        faces.push_back({0, k + 1, (k + 1) % triangles + 1});
    }
    return mesh_body(std::move(places), std::move(faces));
}

std::size_t dispatches_per_substep(const World& world)
{
    return world.plan().passes.size() / world.plan().substeps;
}

} // namespace

TEST_CASE("C01: an edge of three triangles bends by three hinges and repeats itself [hard]")
{
    Body body = mesh_body({{0, 0, 0}, {1, 0, 0}, {0.5, -1, 0}, {0.5, 0.5, 0.9}, {0.5, 0.5, -0.9}},
                          {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
    body.pins = {hold({0, 1})};
    body.start_positions = body.mesh.positions;
    body.start_positions[3].y += 0.2;
    Scene scene = alone(body);
    scene.gravity = {0, -9.81, 0};
    scene.damping = 1;
    on_every_device([&](const auto& device) {
        World world(scene, device), again(scene, device);
        CHECK(world.plan().constraint_counts().at("bending") == 3);
        CHECK(world.plan().constraint_counts().at("distance") == 6);
        run(world, 300);
        run(again, 300);
        CHECK(same_state(world.state(), again.state()));
        const StepReport report = check_sound(world);
        note("C01", *device, "max stretch", report.max_stretch);
        CHECK(report.max_stretch < 0.005);
    });
}

TEST_CASE("C02: a fan of 1000 triangles takes few dispatches and stays finite [hard]")
{
    for (const bool bends : {false, true})
        on_every_device([&](const auto& device) {
            Body body = fan(1000);
            body.material.bending_stiffness = bends ? 1e-4 : 0;
            body.pins = {hold({1, 501})};
            Scene scene = alone(body);
            scene.gravity = {0, -9.81, 0};
            scene.method.substeps = 4;
            World world(scene, device);
            run(world, steps_for(*device, 60, 5));
            const StepReport report = measure(world);
            CHECK(finite(world.positions()));
            const char* with = bends ? "dispatches a substep, bending" : "dispatches a substep";
            note("C02", *device, with, double(dispatches_per_substep(world)));
            note("C02", *device, bends ? "colours, bending" : "colours",
                 double(world.plan().colour_counts().at(bends ? "bending" : "distance")));
            note("C02", *device, "max stretch", report.max_stretch);
            CHECK(world.plan().colour_counts().at("distance") <= 3);
            CHECK(dispatches_per_substep(world) <= (bends ? 1100u : 6u));
            // Its rim is two chains of 500 links at two pins, which so few sweeps cannot carry: bounded, not
            // small, and the run says so.
            CHECK(report.max_stretch < 100);
            CHECK(rank(report.status) >= (device->info().executor == "cpu:serial" ? 1 : 0));
        });
}

TEST_CASE("C05: a particle alone falls the exact discrete parabola [hard]")
{
    on_every_device([](const auto& device) {
        for (const char* precision : {"float", "double"})
            for (const glm::dvec3 speed : {glm::dvec3(0), glm::dvec3(1.5, 3, -2)})
            {
                Body body = particles({{0, 2, 0}});
                body.velocity = speed;
                Scene scene = alone(body);
                scene.gravity = {0, -9.81, 0};
                scene.method.precision = option_named<Precision>(precision);
                scene.method.substeps = 1;
                World world(scene, device);
                const double h = scene.timestep;
                double worst = 0;
                for (int n = 1; n <= 60; ++n)
                {
                    world.step();
                    const glm::dvec3 fall(0, -9.81 * h * h * n * n / 2, 0);
                    const glm::dvec3 exact = glm::dvec3(0, 2, 0) + speed * (n * h) + fall;
                    worst = std::max(worst, glm::distance(world.positions()[0], exact) / 4.905);
                }
                note("C05", *device, precision, worst);
                CHECK(worst < (precision[0] == 'd' ? 1e-12 : 1e-6));
                CHECK(world.plan().constraints.empty());
                check_sound(world);
            }
    });
}

TEST_CASE("C06: a doubled spring is a spring of double stiffness [hard]")
{
    const auto hanging_mass = [](std::vector<double> compliances, std::uint32_t iterations) {
        Body body = particles({{0, 0, 0}, {0, -1, 0}}, 0.1);
        for (const double c : compliances)
            body.springs.push_back({0, 1, 1, c});
        body.pins = {hold({0})};
        Scene scene = alone(body);
        scene.gravity = {0, -9.81, 0};
        scene.damping = 4;
        scene.method.iterations = iterations;
        return scene;
    };
    for (const std::uint32_t iterations : {1u, 20u})
        on_every_device([&](const auto& device) {
            World twice(hanging_mass({0.02, 0.02}, iterations), device),
                stiff(hanging_mass({0.01}, iterations), device);
            const int steps = steps_for(*device, 400, iterations == 1 ? 400 : 200);
            run(twice, steps);
            run(stiff, steps);
            const double exact = 0.1 * 9.81 * 0.01;
            const double error = std::abs(-twice.positions()[1].y - 1 - exact) / exact;
            note("C06", *device,
                 iterations == 1 ? "static error, 1 iteration" : "static error, 20 iterations", error);
            CHECK(error < 1e-3);
            CHECK(std::abs(twice.positions()[1].y - stiff.positions()[1].y) < 1e-3 * exact);
            check_sound(twice);
            World rigid(hanging_mass({0, 0}, iterations), device);
            run(rigid, 100);
            CHECK(std::abs(rigid.positions()[1].y + 1) < 1e-6);
            check_sound(rigid);
        });
}

TEST_CASE("C07: a spring to itself, to no vertex or without a length is refused with its place [hard]")
{
    const std::vector<Body::Spring> bad = {{1, 1, 0.1, 0},    {0, 9, 0.1, 0},       {4000000000u, 0, 0.1, 0},
                                           {0, 1, kNaN, 0},   {0, 1, kInfinity, 0}, {0, 1, -0.1, 0},
                                           {0, 1, 0.1, kNaN}, {0, 1, 0.1, -1e-3}};
    on_every_device([&](const auto& device) {
        for (const Body::Spring& spring : bad)
            for (const bool by_hand : {false, true})
            {
                INFO(spring.a << ' ' << spring.b << ' ' << spring.rest_length << ' ' << spring.compliance);
                Scene scene = test::hanging(2);
                scene.bodies[0].springs = {{0, 4, 0.5, 0}, spring};
                if (!by_hand)
                    scene.bodies[0].mesh = {};
                std::string text;
                CHECK(refusal_of([&] { World refused(scene, device); }, &text) == "bad_input");
                CHECK(text.find("springs[1]") != std::string::npos);
            }
    });
}

TEST_CASE("C07: what else a scene made by hand can get wrong is refused too [hard]")
{
    const auto refused = [](auto change) {
        Scene scene = test::hanging(2);
        change(scene.bodies[0]);
        return refusal_of([&] { make_plan(scene); });
    };
    CHECK(refused([](Body&) {}) == "nothing");
    CHECK(refused([](Body& b) { b.pins[0].vertices = {9}; }) == "bad_input");
    CHECK(refused([](Body& b) { b.vertex_masses = {1, 2}; }) == "bad_input");
    CHECK(refused([](Body& b) { b.vertex_masses.assign(9, 0.0); }) == "bad_input");
    CHECK(refused([](Body& b) { b.start_positions.resize(3); }) == "bad_input");
    CHECK(refused([](Body& b) { b.mesh.positions[4].y = kNaN; }) == "bad_input");
    CHECK(refused([](Body& b) { b.mesh.triangles[0] = {0, 0, 1}; }) == "bad_input");
    CHECK(refused([](Body& b) { b.mesh.triangles[0] = {0, 1, 77}; }) == "bad_input");
}

TEST_CASE(
    "C08: nothing, one and two particles, and a body without constraints run without a solver pass [hard]")
{
    on_every_device([](const auto& device) {
        World nothing(Scene{}, device);
        run(nothing, 3);
        CHECK(nothing.plan().passes.empty());
        CHECK(to_string(measure(nothing).status) == "completed");

        Scene gravity;
        for (const std::size_t count : {1u, 2u, 100u})
        {
            gravity.bodies = {particles(std::vector<glm::dvec3>(count, {1, 2, 3}))};
            World loose(gravity, device);
            run(loose, 10);
            CHECK(loose.plan().passes.size() == 2 * loose.plan().substeps);
            CHECK(loose.positions()[count - 1].y < 2);
            check_sound(loose);
        }
        gravity.bodies = {particles({{0, 0, 0}, {0, -1, 0}})};
        gravity.bodies[0].springs = {{0, 1, 1, 0}};
        World pair(gravity, device);
        run(pair, 10);
        CHECK(pair.plan().passes.size() == 3 * pair.plan().substeps);
        check_sound(pair);

        gravity.bodies[0].pins = {hold({0, 1})};
        World held(gravity, device);
        run(held, 10);
        CHECK(held.plan().passes.size() == 2 * held.plan().substeps);
        CHECK(held.positions()[1] == glm::dvec3(0, -1, 0));
        check_sound(held);
    });
}
