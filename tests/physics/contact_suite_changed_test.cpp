// Contact of what changes its shape for good (examples/contact, 58): cloth that tears, a solid that flows.
// What sleeps is in tests/unit/world/sleep_contact_test.cpp.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include <algorithm>
#include <array>
#include <map>

using namespace taut;

namespace {

/// Surfaces that may touch where they were one.
struct Torn
{
    judging::Surface surface;
    std::map<std::array<double, 3>, std::uint32_t> places; ///< m, at rest
    std::vector<std::uint32_t> was; ///< per vertex, equal where it was one with another

    explicit Torn(const Scene& scene)
    {
        for (const Body& body : scene.bodies)
            for (const glm::dvec3& x : body.mesh.positions)
            {
                const auto fresh = static_cast<std::uint32_t>(places.size());
                was.push_back(places.try_emplace({x.x, x.y, x.z}, fresh).first->second);
            }
        auto all = judging::scene_triangles(scene);
        surface = judging::make_surface(was.size(), std::move(all.triangles), std::move(all.led));
    }
    std::size_t crossed(const std::vector<glm::dvec3>& x) const
    {
        std::size_t out = 0;
        for (const auto& [s, t] : judging::intersecting_triangles(surface, x))
        {
            const auto &a = surface.triangles[s], &b = surface.triangles[t];
            out += std::none_of(a.begin(), a.end(), [&](std::uint32_t v) {
                return std::any_of(b.begin(), b.end(), [&](std::uint32_t w) { return was[v] == was[w]; });
            });
        }
        return out;
    }
};

/// m: the lowest vertex of a bar across the ridge after it has come to hang, clean all the way.
double hangs(double yield)
{
    Scene scene = suite("58_moulded");
    scene.bodies[1].material.plastic_yield = yield;
    JudgedRun run(scene);
    run.run(3);
    CHECK(run.crossed == 0);
    const auto forces = run.world.contact_forces();
    const BodyContactForce* carried = force_between(forces, 0, 1);
    REQUIRE(carried);
    CHECK(-carried->force.y == Approx(9.81 * solid_mass(run.world.scene(), 1)).epsilon(0.02));
    const auto bar = run.body(1);
    return std::min_element(bar.begin(), bar.end(), [](auto a, auto b) { return a.y < b.y; })->y;
}

} // namespace

TEST_CASE("suite 58: cloth that tears apart above a plate comes to lie on it, and crosses nothing")
{
    World world(suite("58_torn"), test_device("cpu:serial"));
    const std::size_t whole = world.positions().size();
    while (world.time() < 0.5) // while it tears, what has come apart touches where it was one
        world.step();
    const std::size_t torn = world.positions().size();
    CHECK(torn >= whole + 9); // one cut through and more
    const Torn cloth(world.scene());
    for (; world.time() < 3; world.step())
    {
        REQUIRE(world.positions().size() == torn);
        CHECK(cloth.crossed(world.positions()) == 0);
    }
    const auto x = world.positions();
    std::size_t lie = 0;
    for (std::size_t v = world.plan().body_start[1]; v < x.size(); ++v)
    {
        CHECK(x[v].y > 0.95 * 0.006);
        lie += x[v].y < 1.05 * 0.006;
    }
    CHECK(lie > 30);
}

TEST_CASE(
    "suite 58: a bar that flows over a ridge hangs lower than one that springs back, and crosses nothing")
{
    CHECK(hangs(0.02) < hangs(0) - 0.1);
}
