// Cloth that starts flattened, collapsed, scrambled or scaled (methods 2.B B10 to B14, for cloth).
//
// Cloth without gravity has many shapes of no stretch; it has recovered when its edges have their lengths.

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

struct Course
{
    double start = 0, highest = 0; ///< mechanical energy, J
    StepReport end;
};

/// Runs `steps` and follows the energy.
Course follow(World& world, int steps)
{
    Course out;
    out.start = out.highest = energy(world);
    for (int i = 0; i < steps; ++i)
    {
        world.step();
        const double now = energy(world);
        CHECK(std::isfinite(now));
        out.highest = std::max(out.highest, now);
    }
    out.end = measure(world);
    CHECK(finite(world.positions()));
    CHECK(finite(world.velocities()));
    CHECK(to_string(out.end.status) == "completed");
    return out;
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

/// Root mean square of the same.
double mean_strain(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    const auto x = world.positions();
    double sum = 0;
    for (const StretchElement& s : model.springs)
        sum += std::pow(glm::distance(x[s.a], x[s.b]) / s.rest_length - 1, 2);
    return std::sqrt(sum / double(model.springs.size()));
}

/// Cloth that starts where `place` puts its vertices.
template <typename Place>
Scene started(Place place, double bending = 1e-3)
{
    Scene scene = free_cloth(6, 1000, bending);
    Body& body = scene.bodies[0];
    conformance::Random random(11);
    for (const glm::dvec3& x : body.mesh.positions)
        body.start_positions.push_back(place(x, random));
    return scene;
}

glm::dvec3 noise(conformance::Random& random, double size)
{
    const double x = random.uniform(-size, size), y = random.uniform(-size, size),
                 z = random.uniform(-size, size);
    return {x, y, z};
}

void check_bounded(const char* id, const Device& device, const char* what, const Course& course,
                   double gain = 1e-6)
{
    note(id, device, what, course.highest / course.start);
    CHECK(course.highest <= course.start * (1 + gain));
}

} // namespace

TEST_CASE(
    "B11: cloth flattened to a line stays on it, finite, its wings counted; with noise it recovers [hard]")
{
    const auto line = [](double size) {
        return [size](const glm::dvec3& x, conformance::Random& random) {
            return glm::dvec3(0, x.y, 0) + (size > 0 ? noise(random, size) : glm::dvec3(0));
        };
    };
    on_every_device([&](const auto& device) {
        World exact(started(line(0)), device);
        const Course held = follow(exact, 60);
        check_bounded("B11", *device, "line: highest energy / start", held);
        CHECK(held.end.warnings.count("degenerate") == 1);
        for (const glm::dvec3& x : exact.positions())
            CHECK((x.x == 0 && x.z == 0));

        Scene noisy = started(line(1e-6));
        noisy.damping = 1;
        World free(noisy, device);
        const Course freed = follow(free, steps_for(*device, 600, 300));
        check_bounded("B11", *device, "line + 1e-6: highest energy / start", freed);
        note("B11", *device, "line + 1e-6: largest strain at the end", largest_strain(free));
        note("B11", *device, "line + 1e-6: mean strain at the end", mean_strain(free));
        CHECK(mean_strain(free) < 0.005);
    });
}

TEST_CASE("B12: cloth collapsed to a point is counted as degenerate; with noise it recovers [hard]")
{
    const auto point = [](double size) {
        return [size](const glm::dvec3&, conformance::Random& random) {
            return size > 0 ? noise(random, size) : glm::dvec3(0);
        };
    };
    on_every_device([&](const auto& device) {
        World exact(started(point(0)), device);
        const WorldState before = exact.state();
        const Course held = follow(exact, 60);
        CHECK(held.end.warnings.at("degenerate") >= 60);
        CHECK(same_state(exact.state(), before));

        Scene noisy = started(point(1e-6));
        noisy.damping = 1;
        World free(noisy, device);
        const Course freed = follow(free, steps_for(*device, 600, 300));
        check_bounded("B12", *device, "point + 1e-6: highest energy / start", freed);
        note("B12", *device, "point + 1e-6: largest strain at the end", largest_strain(free));
        note("B12", *device, "point + 1e-6: mean strain at the end", mean_strain(free));
        CHECK(mean_strain(free) < 0.005);
    });
}

TEST_CASE("B10: cloth folded flat onto itself opens without a gain of energy [hard]")
{
    // Flattened to a plane means for cloth: every vertex in one plane, each half upon the other.
    const auto folded = [](const glm::dvec3& x, conformance::Random&) {
        return glm::dvec3(std::abs(x.x), x.y, 0);
    };
    on_every_device([&](const auto& device) {
        Scene scene = started(folded, 1e-2);
        scene.damping = 0.5;
        World world(scene, device);
        const Course course = follow(world, steps_for(*device, 600, 300));
        // One sweep a substep is no descent: hinges at pi, where their sign is free, hand the springs a
        // little.
        check_bounded("B10", *device, "folded: highest energy / start", course, 0.01);
        note("B10", *device, "folded: largest strain at the end", largest_strain(world));
        note("B10", *device, "folded: energy at the end / start", energy(course.end) / course.start);
        CHECK(largest_strain(world) < 0.005);
    });
}

TEST_CASE("B13: scrambled cloth stays finite, gains no energy and finds its lengths [hard]")
{
    const auto scrambled = [](const glm::dvec3&, conformance::Random& random) { return noise(random, 0.5); };
    on_every_device([&](const auto& device) {
        for (const double bending : {0.0, 1e-4})
        {
            Scene scene = started(scrambled, bending);
            scene.damping = 0.5;
            World world(scene, device);
            const Course course = follow(world, steps_for(*device, 600, 300));
            check_bounded("B13", *device, "scrambled: highest energy / start", course);
            note("B13", *device,
                 bending > 0 ? "largest strain at the end, bending" : "largest strain at the end",
                 largest_strain(world));
            note("B13", *device, bending > 0 ? "mean strain at the end, bending" : "mean strain at the end",
                 mean_strain(world));
            CHECK(mean_strain(world) < 0.005);
        }
    });
}

TEST_CASE("B14: cloth scaled x10 and x0.01 stays finite, gains no energy and recovers [hard]")
{
    on_every_device([](const auto& device) {
        for (const double scale : {10.0, 0.01})
        {
            const auto scaled = [&](const glm::dvec3& x, conformance::Random& random) {
                return x * scale + noise(random, 1e-3 * scale);
            };
            Scene scene = started(scaled);
            scene.damping = 0.5;
            World world(scene, device);
            const Course course = follow(world, steps_for(*device, 600, 300));
            check_bounded("B14", *device,
                          scale > 1 ? "x10: highest energy / start" : "x0.01: highest energy / start",
                          course);
            note("B14", *device,
                 scale > 1 ? "x10: largest strain at the end" : "x0.01: largest strain at the end",
                 largest_strain(world));
            note("B14", *device, scale > 1 ? "x10: mean strain at the end" : "x0.01: mean strain at the end",
                 mean_strain(world));
            CHECK(mean_strain(world) < 0.005);
        }
    });
}
