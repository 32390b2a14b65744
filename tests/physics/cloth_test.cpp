// Cloth as a material: stretch, bending, energy, friction.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

constexpr std::uint32_t kLinks = 10;
constexpr double kLinkMass = 0.01, kStiffness = 1000;
/// m g n (n + 1) / (2 k)
constexpr double kExtension = kLinkMass * 9.81 * kLinks * (kLinks + 1) / (2 * kStiffness);

/// Static extension of a hanging chain against its exact value, relative.
double static_error(const std::shared_ptr<Device>& device, std::uint32_t substeps, std::uint32_t iterations,
                    const char* precision = "float")
{
    Scene scene = test::chain(kLinks, kStiffness, kLinkMass);
    scene.damping = 20;
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    scene.method.precision = option_named<Precision>(precision);
    World world(scene, device);
    run(world, 180);
    check_sound(world);
    return std::abs(-world.positions()[kLinks].y - 1 - kExtension) / kExtension;
}

} // namespace

TEST_CASE("a hanging strip is longer by m g n (n + 1) / (2 k) at 1, 4 and 16 iterations")
{
    on_every_device([](const auto& device) {
        // One iteration leaves an error of second order in the substep, so 200 of them; more iterations
        // need fewer. What remains is the rounding of a state at rest.
        const bool quick = device->info().executor == "cpu:serial";
        const double one = static_error(device, quick ? 200 : 50, 1);
        const double four = static_error(device, quick ? 200 : 50, 4);
        const double sixteen = static_error(device, quick ? 200 : 25, 16);
        note("physics", *device, "hanging strip, 1 iteration", one);
        note("physics", *device, "hanging strip, 4 iterations", four);
        note("physics", *device, "hanging strip, 16 iterations", sixteen);
        CHECK(one < (quick ? 1e-3 : 1.6e-2)); // 16 times: four times the substep, squared
        CHECK(four < 1e-5);
        CHECK(sixteen < 1e-5);
    });
}

TEST_CASE("the static error of one iteration falls by four when substeps double")
{
    const auto device = test_device("cpu:serial");
    double before = static_error(device, 25, 1, "double");
    for (const std::uint32_t substeps : {50u, 100u, 200u})
    {
        const double now = static_error(device, substeps, 1, "double");
        const double order = std::log2(before / now);
        note("physics", *device, "order of the static error", order);
        CHECK(order == Approx(2).margin(0.15));
        before = now;
    }
}

namespace {

/// Two triangles folded by an angle about their common edge.
Body folded_pair(double angle)
{
    Body body;
    body.shape.kind = ShapeKind::mesh;
    body.mesh.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, 0}, {-std::cos(angle), 0.5, std::sin(angle)}};
    body.mesh.triangles = {{0, 2, 1}, {0, 1, 3}};
    body.material.stretch_stiffness = 1e4;
    body.material.bending_stiffness = 0.1;
    return body;
}

} // namespace

TEST_CASE("a bent pair at rest feels no force")
{
    on_every_device([](const auto& device) {
        for (const double angle : {0.0, 0.3, -1.0, 2.5})
        {
            World world(alone(folded_pair(angle)), device);
            run(world, 120);
            CHECK(largest_distance(world.positions(), folded_pair(angle).mesh.positions) < 1e-6);
            CHECK(check_sound(world).max_speed < 1e-5);
        }
    });
}

TEST_CASE("bending does not see rigid motion: a turning, flying bent pair keeps its shape")
{
    on_every_device([](const auto& device) {
        Body body = folded_pair(0.7);
        const glm::dvec3 axis = glm::normalize(glm::dvec3(1, 2, -1));
        for (glm::dvec3& x : body.start_positions = body.mesh.positions)
        {
            const double c = std::cos(1.1), s = std::sin(1.1); // turned and moved, not bent
            x = x * c + glm::cross(axis, x) * s + axis * glm::dot(axis, x) * (1 - c) + glm::dvec3(3, -2, 5);
        }
        body.velocity = {0.5, 0.25, -1};
        const auto start = body.start_positions;
        World world(alone(body), device);
        run(world, 64);
        auto x = world.positions();
        for (glm::dvec3& p : x)
            p -= body.velocity * (64.0 / 60);
        note("physics", *device, "bent pair, turned and flying: change of shape, m",
             largest_distance(x, start));
        CHECK(largest_distance(x, start) < 1e-5);
        check_sound(world);
    });
}

TEST_CASE("a rolled strip wants to be flat")
{
    on_every_device([](const auto& device) {
        Scene scene;
        Body body;
        body.shape.cells = {12, 2};
        body.shape.size = {1, 0.2};
        body.material.stretch_stiffness = 1e4;
        body.material.bending_stiffness = 0.01;
        scene.bodies = {body};
        scene.gravity = {0, 0, 0};
        scene.damping = 2;
        scene = resolve(scene);
        const double radius = 0.25; // an arc of 4 rad
        for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
            scene.bodies[0].start_positions.emplace_back(radius * std::sin(x.x / radius), x.y,
                                                         radius * (1 - std::cos(x.x / radius)));
        World world(scene, device);
        const double rolled = energy(world);
        run(world, 300);
        const StepReport report = check_sound(world);
        const auto x = world.positions();
        note("physics", *device, "rolled strip: energy left / start", energy(report) / rolled);
        note("physics", *device, "rolled strip: distance of its ends, m", glm::distance(x[0], x[12]));
        CHECK(energy(report) < 1e-3 * rolled);
        CHECK(glm::distance(x[0], x[12]) == Approx(1).epsilon(0.005));
    });
}

namespace {

struct EnergyCourse
{
    double highest = -1e30; ///< J above the start
    double late = -1e30;    ///< the same, in the last of four seconds
    double fall = 0;        ///< J, from the start to the lowest
};

EnergyCourse energy_of_hanging(const std::shared_ptr<Device>& device, std::uint32_t substeps,
                               std::uint32_t iterations, int steps)
{
    Scene scene = test::hanging(6);
    scene.bodies[0].material.bending_stiffness = 1e-4;
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    World world(scene, device);
    const double start = energy(world);
    EnergyCourse out;
    for (int i = 0; i < steps; ++i)
    {
        world.step();
        const double now = energy(world) - start;
        out.highest = std::max(out.highest, now);
        out.fall = std::max(out.fall, -now);
        if (i >= 3 * steps / 4)
            out.late = std::max(out.late, now);
    }
    return out;
}

} // namespace

TEST_CASE("the energy of hanging cloth does not grow")
{
    // Weight times size is 2.8 J. Several sweeps a substep come near to implicit Euler, which only loses
    // energy; one sweep lets it swing by what falls to nothing with the substep, and loses it over time.
    constexpr double kScale = 0.2 * 9.81 * 1.414;
    on_every_device([&](const auto& device) {
        const int steps = steps_for(*device, 240, 80);
        const EnergyCourse four = energy_of_hanging(device, 10, 4, steps);
        note("physics", *device, "hanging cloth, 4 iterations: energy above the start / (m g D)",
             four.highest / kScale);
        CHECK(four.highest < 1e-5 * kScale);
        CHECK(four.late < 0);
        const EnergyCourse one = energy_of_hanging(device, 10, 1, steps);
        note("physics", *device, "hanging cloth, 1 iteration: energy above the start / (m g D)",
             one.highest / kScale);
        CHECK(one.highest < 2e-3 * kScale);
        CHECK(one.late < 0);
    });
    const EnergyCourse fine = energy_of_hanging(test_device("cpu:serial"), 40, 1, 240);
    note("physics", *test_device("cpu:serial"), "the same, 40 substeps", fine.highest / kScale);
    CHECK(fine.highest < 2e-3 / 4 * kScale);
}

TEST_CASE("friction on a plane stops a vertex after v^2 / (2 mu g), at 1 and 4 iterations")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t iterations : {1u, 4u})
        {
            Body body = particles({{0, 0.001, 0}});
            body.velocity = {3, 0, 4};
            Scene scene = alone(body);
            scene.gravity = {0, -9.81, 0};
            scene.method.iterations = iterations;
            Collider floor;
            floor.kind = ColliderKind::plane;
            floor.friction = 0.5;
            scene.colliders = {floor};
            World world(scene, device);
            run(world, 90);
            const double slid = glm::length(glm::dvec2(world.positions()[0].x, world.positions()[0].z));
            const double exact = 25 / (2 * 0.5 * 9.81);
            note("physics", *device, "stop distance / exact", slid / exact);
            CHECK(slid == Approx(exact).epsilon(0.005)); // v h / 2 of a substep is 0.16 %
            CHECK(check_sound(world).max_speed < 1e-6);
        }
    });
}
