// Solids that nothing holds or touches do not begin to turn by themselves, whatever is done to their shape,
// and turn on as they did (docs/effects/momentum.md).

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"

#include "taut/plan/effect_names.hpp"
#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <functional>

using namespace taut;

namespace {

constexpr std::uint32_t kTangles = 60;

Scene free_cube(const std::string& method)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 3, 3};
    body.shape.box_size = {0.1, 0.1, 0.1};
    body.material = solid_material();
    if (method == "pbd")
        body.material.model = SolidModel::springs;
    scene.bodies = {body};
    scene.gravity = glm::dvec3(0);
    scene.method.type = option_named<MethodKind>(method);
    return scene;
}

/// The scene with its body where `place` puts it.
Scene started(Scene scene, const std::function<glm::dvec3(glm::dvec3)>& place)
{
    for (const glm::dvec3& x : World(scene, test_device("cpu:serial")).positions())
        scene.bodies[0].start_positions.push_back(place(x));
    return scene;
}

WorldOptions without_momentum(const Scene& scene)
{
    WorldOptions options;
    options.plan.available_effects = effect_names(resolve(scene));
    std::erase(options.plan.available_effects, "momentum");
    return options;
}

/// Of the mean rotation about the centre, in rad/s, as if the vertices had one mass.
double turning(const World& world)
{
    const std::vector<glm::dvec3> x = world.positions(), v = world.velocities();
    glm::dvec3 centre(0), speed(0), angular(0);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        centre += x[i] / double(x.size());
        speed += v[i] / double(x.size());
    }
    glm::dmat3 tensor(0);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const glm::dvec3 r = x[i] - centre;
        angular += glm::cross(r, v[i] - speed);
        tensor += glm::dot(r, r) * glm::dmat3(1) - glm::outerProduct(r, r);
    }
    return glm::length(glm::inverse(tensor) * angular);
}

} // namespace

TEST_CASE("a free solid that starts squeezed, sheared or mirrored finds its shape and does not turn",
          "[momentum]")
{
    const std::string method = GENERATE("xpbd", "pbd", "vbd", "implicit_euler");
    const auto [name, place] = GENERATE(table<std::string, glm::dvec3 (*)(glm::dvec3)>(
        {{"squeezed", [](glm::dvec3 x) { return glm::dvec3(x.x, 0.1 * x.y, x.z); }},
         {"sheared", [](glm::dvec3 x) { return glm::dvec3(x.x + 1.5 * x.y, x.y, x.z - x.y); }},
         {"mirrored", [](glm::dvec3 x) { return glm::dvec3(x.x, -x.y, x.z); }}}));
    const double modulus = GENERATE(1e5, 1e7);
    CAPTURE(method, name, modulus);
    Scene scene = free_cube(method);
    scene.bodies[0].material.youngs_modulus = modulus;
    const Scene start = started(scene, place);
    const auto rate_with = [&](const WorldOptions& options) {
        World world(start, test_device("cpu:serial"), options);
        for (int k = 0; k < 60; ++k)
            world.step();
        return glm::degrees(turning(world));
    };
    const double rate = rate_with({});
    if (environment_has("TAUT_NOTES"))
        WARN(method << ", " << name << ", " << modulus << " Pa: " << rate << " degrees a second, without "
                    << rate_with(without_momentum(start)));
    CHECK(rate < 0.1); // 20 to 800 where the solve decides
}

TEST_CASE("a solid that starts squeezed above a floor comes down as it started", "[momentum]")
{
    Scene scene = free_cube("xpbd");
    scene = started(scene, [](glm::dvec3 x) { return glm::dvec3(x.x + x.y, 0.1 * x.y, x.z); });
    scene.gravity = {0, -1, 0};
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.point = {0, -1, 0};
    scene.colliders = {floor};
    World world(scene, test_device("cpu:serial")),
        other(scene, test_device("cpu:serial"), without_momentum(scene));
    for (int k = 0; k < 30; ++k)
    {
        world.step();
        other.step();
    }
    CHECK(glm::degrees(turning(world)) < 0.1);
    CHECK(glm::degrees(turning(other)) > 10);
    scene.bodies[0].start_positions.clear();
    CHECK(World(scene, test_device("cpu:serial")).plan().owed == kNoBuffer); // not called for
}

TEST_CASE("a free solid turns on as it was turned, under every count of substeps", "[momentum]")
{
    const std::string method = GENERATE("xpbd", "pbd", "vbd", "implicit_euler");
    const std::uint32_t substeps = GENERATE(2u, 4u, 16u), iterations = GENERATE(1u, 5u);
    CAPTURE(method, substeps, iterations);
    Scene scene = free_cube(method);
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    scene.external_forces = true;
    /// rad/s after 20 steps of forces, and after 240 more without.
    const auto rates_with = [&](const WorldOptions& options) {
        World world(scene, test_device("cpu:serial"), options);
        std::vector<glm::dvec3> forces;
        for (const glm::dvec3& x : world.positions())
            forces.push_back(glm::cross(glm::dvec3(0.05, 0.2, -0.1), x)); // N
        const auto step = [&](int count) {
            for (int k = 0; k < count; ++k)
                world.step();
        };
        world.set_forces(forces);
        step(20);
        world.set_forces(std::vector<glm::dvec3>(forces.size(), glm::dvec3(0)));
        const double before = turning(world);
        step(240);
        return std::pair(before, turning(world));
    };
    const auto [before, after] = rates_with({});
    if (environment_has("TAUT_NOTES"))
    {
        const auto [had, has] = rates_with(without_momentum(scene));
        WARN(method << ", " << substeps << " substeps: keeps " << after / before << ", without "
                    << has / had);
    }
    CHECK(before > 0.1);
    CHECK(after == Approx(before).epsilon(0.01));
}

TEST_CASE("what a body is owed goes along with a state", "[momentum]")
{
    const auto device = test_device("cpu:serial");
    Scene scene = free_cube("xpbd");
    scene.bodies[0].material.youngs_modulus = 1e8;
    conformance::Random random(1470);
    scene = started(scene, [&](glm::dvec3) {
        return 0.05 * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    });
    World one(scene, device), other(scene, device), poor(scene, device);
    one.step();
    WorldState state = one.state();
    other.restore(state);
    std::fill(state.owed.begin(), state.owed.end(), std::byte(0));
    poor.restore(state);
    for (int k = 0; k < 20; ++k)
        for (World* world : {&one, &other, &poor})
            world->step();
    CHECK(one.positions() == other.positions());
    CHECK_FALSE(one.positions() == poor.positions()); // something was owed
}

TEST_CASE("a solid thrown into a tangle finds its shape, with the effect as without", "[momentum]")
{
    const auto device = test_device("cpu:serial");
    const auto recovered = [&](double ratio, bool with) {
        Scene scene = free_cube("xpbd");
        scene.bodies[0].shape.box_cells = {4, 4, 4};
        scene.bodies[0].material.youngs_modulus = 1e8;
        scene.bodies[0].material.poissons_ratio = ratio;
        const WorldOptions options = with ? WorldOptions{} : without_momentum(resolve(scene));
        int count = 0;
        for (std::uint32_t seed = 0; seed < kTangles; ++seed)
        {
            conformance::Random random(1500 + seed);
            const auto anywhere = [&](glm::dvec3) {
                return 0.05 * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
            };
            World world(started(scene, anywhere), device, options);
            for (int k = 0; k < 60; ++k)
                world.step();
            count += measure(world).volume.inverted == 0 ? 1 : 0;
        }
        return count;
    };
    int with = 0, without = 0;
    for (const double ratio : {0.3, 0.45})
    {
        with += recovered(ratio, true);
        without += recovered(ratio, false);
    }
    if (environment_has("TAUT_NOTES"))
        WARN("of " << 2 * kTangles << " tangles " << with << " come apart, without the effect " << without);
    CHECK(with >= 0.97 * 2 * kTangles); // all were measured
    CHECK(without >= 0.97 * 2 * kTangles);
}

// The more substeps, the more corners leave the floor at one time: what turns the cube is the solver's error.
TEST_CASE("a cube that is dropped flat turns less the more substeps it has", "[momentum]")
{
    const auto rate = [](std::uint32_t substeps) {
        Scene scene = free_cube("xpbd");
        scene.gravity = {0, -9.81, 0};
        scene.bodies[0].material.youngs_modulus = 2e6;
        scene.bodies[0].material.poissons_ratio = 0.45;
        scene.bodies[0].transform.translate = {0, 0.5, 0};
        Collider floor;
        floor.kind = ColliderKind::plane;
        floor.friction = 0.5;
        scene.colliders = {floor};
        scene.method.substeps = substeps;
        World world(scene, test_device("cpu:serial"));
        for (int k = 0; k < 24; ++k) // 0.4 s: just after the first bounce
            world.step();
        return turning(world);
    };
    const double few = rate(10), some = rate(40), many = rate(160);
    CAPTURE(few, some, many);
    if (environment_has("TAUT_NOTES"))
        WARN("rad/s with 10, 40, 160 substeps: " << few << ", " << some << ", " << many);
    CHECK(many < few / 10);
    CHECK(many < glm::radians(5.0));
}

TEST_CASE("a bar that is held by an edge swings about it")
{
    // Few sweeps of vbd turn a held bar too slowly.
    const std::string method = GENERATE("xpbd", "implicit_euler");
    CAPTURE(method);
    const double length = 0.3, time = 0.1;
    Scene scene = free_cube(method);
    Body& bar = scene.bodies[0];
    bar.shape.box_cells = {6, 1, 1};
    bar.shape.box_size = {length, 0.05, 0.05};
    bar.material.youngs_modulus = 5e7; // bends far faster than it swings
    Pin edge;
    edge.use_box = true;
    edge.box_min = {-1, 0.024, -1};
    edge.box_max = {-0.149, 0.026, 1};
    bar.pins = {edge};
    scene.gravity = {0, -9.81, 0};
    scene.timestep = time / 10;
    scene.method.substeps = 20;
    World world(scene, test_device("cpu:serial"));
    const double before = world.positions().back().y;
    for (int step = 0; step < 10; ++step)
        world.step();
    // Of a slender bar 3/4 g t^2, of one that falls without turning 1/2.
    const double fall = (before - world.positions().back().y) / (9.81 * time * time);
    CHECK(fall > 0.65);
    CHECK(fall < 0.8);
}
