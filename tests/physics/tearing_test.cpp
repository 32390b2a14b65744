// Claims about cloth that tears: what it is made of stays, and its mesh stays a surface.

#include "hard/cases.hpp"
#include "support/methods.hpp"

#include "taut/plan/material.hpp"
#include "taut/world/hybrid.hpp"
#include "taut/world/tearing.hpp"

#include <map>
#include <numeric>

using namespace taut;
using namespace taut::hard;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

double total_mass(const Scene& scene)
{
    double sum = 0;
    for (const Body& body : scene.bodies)
        for (const double m : vertex_masses(body))
            sum += m;
    return sum;
}

glm::dvec3 momentum(const World& world)
{
    glm::dvec3 sum(0);
    const auto v = world.velocities();
    std::size_t i = 0;
    for (const Body& body : world.scene().bodies)
        for (const double m : vertex_masses(body))
            sum += m * v[i++];
    return sum;
}

/// No edge has more than two triangles, or two that run along it the same way; the triangles at a vertex
/// hang together by edges.
void check_surface(const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
    std::vector<std::vector<Triangle>> at(mesh.positions.size());
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
        {
            REQUIRE(t[k] < mesh.positions.size());
            ++ways[{t[k], t[(k + 1) % 3]}];
            at[t[k]].push_back(t);
        }
    for (const auto& [edge, count] : ways)
        REQUIRE(count == 1);
    for (std::uint32_t v = 0; v < at.size(); ++v)
    {
        REQUIRE(!at[v].empty());
        // Each triangle leads from one neighbour to the next: one chain or one ring in all.
        std::map<std::uint32_t, std::uint32_t> next, last;
        for (const Triangle& t : at[v])
            for (std::size_t k = 0; k < 3; ++k)
                if (t[k] == v)
                {
                    next[t[(k + 1) % 3]] = t[(k + 2) % 3];
                    last[t[(k + 2) % 3]] = t[(k + 1) % 3];
                }
        std::size_t ends = 0;
        for (const auto& [from, to] : next)
            ends += last.count(from) == 0;
        REQUIRE(ends <= 1);
        std::uint32_t w = next.begin()->first;
        for (const auto& [from, to] : next)
            if (last.count(from) == 0)
                w = from;
        std::size_t seen = 0;
        for (; seen < next.size() && next.count(w); ++seen)
            w = next[w];
        REQUIRE(seen == next.size());
    }
}

std::size_t parts(const Mesh& mesh)
{
    std::vector<std::uint32_t> root(mesh.positions.size());
    std::iota(root.begin(), root.end(), 0u);
    const auto find = [&](std::uint32_t v) {
        while (root[v] != v)
            v = root[v];
        return v;
    };
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t v : t)
            root[find(v)] = find(t[0]);
    std::size_t count = 0;
    for (std::uint32_t v = 0; v < root.size(); ++v)
        count += root[v] == v;
    return count;
}

/// A sheet held at its left edge, its right edge drawn away by `way` m in a second.
Scene pulled(double way, double tear_strain, std::uint32_t n = 8)
{
    Scene scene;
    Body body;
    body.shape.cells = {n, n};
    body.material.stretch_stiffness = 200;
    body.material.stretch_damping = 1e-3;
    body.material.tear_strain = tear_strain;
    Pin left, right;
    left.edges = {"left"};
    right.edges = {"right"};
    right.motion = {{0, {0, 0, 0}}, {1, {way, 0, 0}}};
    body.pins = {left, right};
    scene.bodies = {body};
    scene.gravity = {0, 0, 0};
    scene.damping = 1;
    return resolve(scene);
}

} // namespace

TEST_CASE("cloth drawn apart tears in two, and loses no triangle and no mass", "[tearing]")
{
    test::on_methods_and_devices(pulled(1.5, 0.3), [](const Scene& scene, const auto& device) {
        World world(scene, device);
        const std::size_t triangles = scene.bodies[0].mesh.triangles.size();
        const double mass = total_mass(scene);
        std::uint64_t before = 0;
        for (int i = 0; i < 90; ++i)
        {
            world.step();
            if (world.torn() == before)
                continue;
            before = world.torn();
            const Mesh& mesh = world.scene().bodies[0].mesh;
            check_surface(mesh);
            CHECK(mesh.triangles.size() == triangles);
            CHECK(total_mass(world.scene()) == Approx(mass).epsilon(1e-12));
            CHECK(mesh.positions.size() == 81 + world.torn());
        }
        const StepReport report = check_sound(world);
        const Mesh& mesh = world.scene().bodies[0].mesh;
        note("physics", *device, "vertices that came apart", double(report.torn));
        note("physics", *device, "parts", double(parts(mesh)));
        CHECK(report.torn == world.torn());
        CHECK(report.torn >= 8);
        CHECK(parts(mesh) >= 2);
        CHECK(report.max_stretch < 0.4);
        CHECK(world.positions().size() == mesh.positions.size());
    });
}

TEST_CASE("a tear changes neither places, nor velocities, nor momentum", "[tearing]")
{
    test::on_methods_and_devices(pulled(1.5, 0.3), [](Scene scene, const auto& device) {
        World torn(scene, device);
        scene.bodies[0].material.tear_strain = 0;
        World whole(scene, device);
        CHECK(torn.plan().torn != kNoBuffer);
        CHECK(whole.plan().torn == kNoBuffer);
        while (torn.torn() == 0 && torn.steps() < 90)
        {
            torn.step();
            whole.step();
        }
        REQUIRE(torn.torn() > 0);
        const auto x = torn.positions(), y = whole.positions();
        const auto v = torn.velocities(), u = whole.velocities();
        for (std::size_t i = 0; i < y.size(); ++i)
            CHECK((x[i] == y[i] && v[i] == u[i])); // bit for bit
        const glm::dvec3 p = momentum(torn), q = momentum(whole);
        CHECK(glm::length(q) > 0.01);
        CHECK(glm::length(p - q) < 1e-9 * glm::length(q));
    });
}

TEST_CASE("cloth within its tear strain moves bitwise as cloth that cannot tear", "[tearing]")
{
    test::on_methods_and_devices(pulled(0.1, 0.5), [](Scene scene, const auto& device) {
        World tough(scene, device);
        scene.bodies[0].material.tear_strain = 0;
        World whole(scene, device);
        run(tough, 30);
        run(whole, 30);
        CHECK(tough.torn() == 0);
        CHECK(tough.state().position == whole.state().position);
        CHECK(tough.state().velocity == whole.state().velocity);
    });
}

TEST_CASE("one overlong spring in the middle opens a slit; held vertices stay whole", "[tearing]")
{
    Scene scene = pulled(0, 0.3);
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    CHECK(tear(scene, x).splits == 0);
    const std::uint32_t middle = 4 * 9 + 4;
    x[middle].x += 0.06; // its neighbour to the left is 0.185 m away instead of 0.125
    const TornScene torn = tear(scene, x);
    CHECK(torn.splits >= 1);
    CHECK(torn.splits <= 2);
    CHECK(torn.origin.size() == 81 + torn.splits);
    check_surface(torn.scene.bodies[0].mesh);
    CHECK(total_mass(torn.scene) == Approx(total_mass(scene)).epsilon(1e-14));
    // Euler: V - E + F of a disc is 1, of a disc with a hole 0.
    const Mesh& mesh = torn.scene.bodies[0].mesh;
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
            edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    CHECK(int(mesh.positions.size()) - int(edges.size()) + int(mesh.triangles.size()) == 0);

    std::vector<glm::dvec3> corner = scene.bodies[0].mesh.positions;
    for (std::uint32_t row = 0; row < 9; ++row) // every held vertex of the left edge drawn out
        corner[9 * row].x -= 0.1;
    const TornScene edge = tear(scene, corner);
    CHECK(edge.splits > 0);
    check_surface(edge.scene.bodies[0].mesh);
    CHECK(edge.scene.bodies[0].pins[0].vertices.size() >= 9);
}

TEST_CASE("tearing is refused in words where springs are not the edges of cloth, and on two devices",
          "[tearing]")
{
    Scene scene = pulled(1, 0.3);
    const auto device = test_device("cpu:serial");
    CHECK(refusal_of([&] { HybridWorld(scene, device, device); }) == "unsupported");
    scene.bodies[0].springs.push_back({0, 5, 0.1, 1e-3});
    std::string text;
    CHECK(refusal_of([&] { World(scene, test_device("cpu:serial")); }, &text) == "bad_input");
    CHECK(text.find("bodies[0].material.tear_strain") != std::string::npos);
}
