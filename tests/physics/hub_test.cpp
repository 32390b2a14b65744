// Claims about a vertex of very many springs, which is solved at once and not by colours.

#include "hard/cases.hpp"

#include <numbers>

using namespace taut;
using namespace taut::hard;

namespace {

constexpr std::uint32_t kSpokes = 200;
constexpr double kCompliance = 0.01, kMass = 20; // m/N, kg

/// A weight in the middle of a wheel of radius 1 m, whose rim is held.
Scene wheel()
{
    std::vector<glm::dvec3> places = {{0, 0, 0}};
    std::vector<std::uint32_t> rim;
    for (std::uint32_t k = 0; k < kSpokes; ++k)
    {
        const double angle = 2 * std::numbers::pi * k / kSpokes;
        rim.push_back(static_cast<std::uint32_t>(places.size()));
        places.emplace_back(std::cos(angle), 0, std::sin(angle));
    }
    Body body = particles(places, kMass);
    body.pins = {hold(rim)};
    for (const std::uint32_t v : rim)
        body.springs.push_back({0, v, 1.0, kCompliance});
    Scene scene = alone(body);
    scene.gravity = {0, -9.81, 0};
    scene.damping = 4;
    return scene;
}

/// Where the springs carry the weight: n (l - 1)/c · s/l = m g, l² = 1 + s², by bisection.
double sag()
{
    double low = 0, high = 10;
    for (int k = 0; k < 60; ++k)
    {
        const double s = 0.5 * (low + high), l = std::hypot(1.0, s);
        (kSpokes * (l - 1) / kCompliance * s / l < kMass * 9.81 ? low : high) = s;
    }
    return low;
}

} // namespace

TEST_CASE("200 springs at one vertex carry its weight where statics says", "[hub]")
{
    on_every_device([](const auto& device) {
        Scene scene = wheel();
        scene.method.substeps = 20;
        World world(scene, device);
        run(world, 240);
        const double error = -world.positions()[0].y / sag() - 1;
        note("physics", *device, "sag of a wheel's hub, error", error);
        CHECK(error == Approx(0).margin(2e-3));
        CHECK(check_sound(world).status == Status::completed);
    });
}

TEST_CASE("200 springs at one vertex hold its weight under pbd", "[hub]")
{
    on_every_device([](const auto& device) {
        Scene scene = wheel();
        scene.method.type = MethodKind::pbd;
        scene.method.substeps = 20;
        World world(scene, device);
        run(world, 240);
        const StepReport report = check_sound(world);
        note("physics", *device, "stretch of a wheel's spokes under pbd", report.max_stretch);
        CHECK(report.max_stretch < 1e-3);
        CHECK(report.status == Status::completed);
    });
}
