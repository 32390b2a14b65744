// The scenes of examples/contact with a few triangles, each by the criterion that its README names: a vertex
// on a face, an edge and a corner, edges that cross and edges that are parallel. The judge looks at every
// step.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace taut;

namespace {

constexpr double kGap = 0.004;

/// N, of all pairs that have the vertex.
double push_at(const World& world, std::uint32_t vertex)
{
    double out = 0;
    for (const SurfacePair& p : world.contact_pairs())
        if (std::count(p.vertex.begin(), p.vertex.end(), vertex) > 0)
            out += p.push;
    return out;
}

/// N, upwards, on the body that is the last.
double carried(const World& world)
{
    double out = 0;
    for (const BodyContactForce& f : world.contact_forces())
        out -= f.b + 1 == world.scene().bodies.size() ? f.force.y : 0;
    return out;
}

Scene moved_feet(double way, const char* precision)
{
    Scene scene = suite("01_feet");
    for (Body& body : scene.bodies)
        body.transform.translate.x += way;
    scene.method.precision = option_named<Precision>(precision);
    return scene;
}

void check_feet(const Scene& scene)
{
    JudgedRun run(scene);
    run.run(1);
    CHECK(run.crossed == 0);
    const auto first = run.world.plan().body_start[1];
    for (std::uint32_t foot = 3; foot < 6; ++foot)
    {
        CAPTURE(foot);
        CHECK(run.body(1)[foot].y == Approx(kGap).epsilon(0.02));
        CHECK(push_at(run.world, first + foot) == Approx(9.81 * 0.02).epsilon(0.01));
    }
}

} // namespace

TEST_CASE("suite 01: feet stand a gap above a face, an edge and a corner, and each carries its third")
{
    check_feet(suite("01_feet"));
}

TEST_CASE("suite 01: what stops a tripod and carries it adds up to the impulse of its weight")
{
    Scene scene = suite("01_feet");
    scene.timestep = 1.0 / 1200; // one substep each, whose forces are those that the world has
    scene.method.substeps = 1;
    JudgedRun run(scene);
    double impulse = 0;
    run.run(0.8, [&] { impulse += carried(run.world) * scene.timestep; });
    CHECK(run.crossed == 0);
    CHECK(impulse == Approx(9.81 * 0.06 * 0.8).epsilon(0.01));
}

TEST_CASE("suite 47: feet stand far from the origin as they do at it, or are refused")
{
    const double way = GENERATE(100.0, 1e3, 1e4);
    CAPTURE(way);
    check_feet(moved_feet(way, "double"));
    if (way == 100)
        check_feet(moved_feet(way, "float"));
    else
        CHECK_THROWS_WITH(World(moved_feet(way, "float"), test_device("cpu:serial")),
                          Contains("contact.thickness") && Contains("method.precision"));
}

TEST_CASE("suite 02: edges that meet crosswise in free space stop each other, and keep gap and momentum")
{
    JudgedRun run(suite("02_crossed_edges"));
    const double energy = measure(run.world).kinetic_energy;
    double impulse = 0;
    run.run(0.1, [&] { impulse += carried(run.world) * run.world.scene().timestep; });
    const StepReport after = measure(run.world);
    CHECK(run.crossed == 0);
    CHECK(run.nearest_parts == Approx(kGap).epsilon(0.02));
    CHECK(impulse == Approx(0.003 * 0.5).epsilon(0.01)); // all of its speed, and no rebound
    CHECK(after.momentum_error >= 0);
    CHECK(after.momentum_error < 1e-6);
    CHECK(after.kinetic_energy < 0.01 * energy);
}

TEST_CASE("suite 02: a triangle lies with its edges across two blades, which carry it")
{
    JudgedRun run(suite("02_blades"));
    run.run(1);
    CHECK(run.crossed == 0);
    for (const glm::dvec3& x : run.body(2))
        CHECK(x.y == Approx(kGap).epsilon(0.02));
    CHECK(carried(run.world) == Approx(9.81 * 0.2 * 0.5 * 0.18 * 0.06).epsilon(0.01));
    for (const SurfacePair& p : run.world.contact_pairs())
        CHECK((p.edges || p.push == 0));
}

TEST_CASE("suite 03: a square lies along two blades alike, however nearly parallel its edges are to theirs")
{
    const char* precision = GENERATE("float", "double");
    CAPTURE(precision);
    std::vector<glm::dvec3> parallel;
    for (const double angle : {0.0, 1e-9, 1e-8, 3e-8, 1e-7})
    {
        CAPTURE(angle);
        Scene scene = resolve(suite("03_parallel_edges"));
        scene.method.precision = option_named<Precision>(precision);
        scene.bodies[2].start_positions = scene.bodies[2].mesh.positions;
        for (glm::dvec3& x : scene.bodies[2].start_positions)
            x = {x.x - angle * x.z, x.y, x.z + angle * x.x};
        JudgedRun run(scene);
        run.run(0.3);
        std::vector<glm::dvec3> last = run.body(2);
        double jump = 0;
        const auto furthest = [&](const std::vector<glm::dvec3>& from) {
            for (std::size_t v = 0; v < from.size(); ++v)
                jump = std::max(jump, glm::distance(from[v], run.body(2)[v]));
        };
        run.run(0.8, [&] {
            furthest(last);
            last = run.body(2);
        });
        if (parallel.empty())
            parallel = last;
        furthest(parallel);
        CHECK(run.crossed == 0);
        CHECK(jump < 1e-3 * kGap);
        CHECK(run.nearest_parts == Approx(kGap).epsilon(0.02));
        CHECK(carried(run.world) == Approx(9.81 * 0.2 * 0.01).epsilon(0.01));
    }
}
