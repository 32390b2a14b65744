// Contact does not depend on the frame that it is seen from, nor on the unit of length.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include "taut/scene/scene.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <functional>
#include <utility>

using namespace taut;

namespace {

/// Two sheets that collide in free space: 0.14 s from their start, so that they touch and part.
struct Collision
{
    std::vector<glm::dvec3> start, end;
    double seconds = 0;      ///< that it took
    std::uint64_t pairs = 0; ///< that were listed at most
    bool clean = false;
};

Collision collide(const std::function<void(Scene&)>& change)
{
    Scene scene = resolve(suite("06_collision"));
    scene.bodies[0].velocity.y = -0.5;
    scene.bodies[1].velocity.y = 0.5;
    change(scene);
    JudgedRun run(scene);
    Collision out;
    out.start = run.before;
    run.run(0.14, [&] { out.pairs = std::max(out.pairs, run.world.contacts().pairs); });
    out.end = run.before;
    out.seconds = run.world.time();
    out.clean = run.crossed == 0;
    return out;
}

double furthest(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b)
{
    double most = 0;
    for (std::size_t v = 0; v < a.size(); ++v)
        most = std::max(most, glm::distance(a[v], b[v]));
    return most;
}

void place_all(Scene& scene, const std::function<glm::dvec3(const glm::dvec3&)>& to)
{
    for (Body& body : scene.bodies)
    {
        body.start_positions = body.mesh.positions;
        for (glm::dvec3& x : body.start_positions)
            x = to(x);
    }
}

} // namespace

TEST_CASE("suite 06: sheets collide in a frame that flies at 50 m/s as at rest")
{
    const glm::dvec3 wind(30, -40, 0);
    const Collision still = collide([](Scene&) {});
    Collision flying = collide([&](Scene& scene) {
        for (Body& body : scene.bodies)
            body.velocity += wind;
    });
    for (glm::dvec3& x : flying.end)
        x -= wind * flying.seconds;
    CHECK(still.clean);
    CHECK(flying.clean);
    CHECK(still.pairs > 100);
    CHECK(furthest(still.end, still.start) > 0.02); // they have moved, and
    CHECK(furthest(flying.end, still.end) < 1e-3 * 0.28);
}

TEST_CASE("suite 06: sheets that are turned collide as those that are not")
{
    const glm::dquat turn = glm::angleAxis(glm::radians(37.0), glm::normalize(glm::dvec3(1, 2, 3)));
    const Collision straight = collide([](Scene&) {});
    Collision turned = collide([&](Scene& scene) {
        place_all(scene, [&](const glm::dvec3& x) { return turn * x; });
        for (Body& body : scene.bodies)
            body.velocity = turn * body.velocity;
    });
    for (glm::dvec3& x : turned.end)
        x = glm::inverse(turn) * x;
    CHECK(turned.clean);
    CHECK(furthest(turned.end, straight.end) < 1e-3 * 0.28);
}

TEST_CASE("suite 06: sheets of a thousandth and a thousand times the size collide as the others do")
{
    const auto [scale, precision] =
        GENERATE(std::pair(1e-3, Precision::float64), std::pair(1e3, Precision::float64),
                 std::pair(1e-2, Precision::float32), std::pair(1e3, Precision::float32));
    CAPTURE(scale, to_string(precision));
    const Collision as_they_are = collide([&](Scene& scene) { scene.method.precision = precision; });
    // As heavy for their size, and as slow to swing: stiffnesses are to masses as before.
    Collision scaled = collide([&](Scene& scene) {
        scene.method.precision = precision;
        scene.depenetration_speed *= scale;
        for (Body& body : scene.bodies)
        {
            for (glm::dvec3& x : body.mesh.positions)
                x *= scale;
            body.velocity *= scale;
            body.material.thickness *= scale;
            body.material.stretch_stiffness *= std::pow(scale, 2);
            body.material.bending_stiffness *= std::pow(scale, 4);
        }
    });
    for (glm::dvec3& x : scaled.end)
        x /= scale;
    CHECK(scaled.clean);
    // In float at 1e-3 they are 1.5e-3 of their size apart: forces of bending are near the least numbers that
    // there are.
    CHECK(furthest(scaled.end, as_they_are.end) < (precision == Precision::float64 ? 2e-4 : 1e-3) * 0.28);
}
