// Claims about solids under implicit Euler. Golden numbers: methods study A5.

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/report.hpp"
#include "taut/world/world.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <cstdlib>
#include <string>

using namespace taut;

namespace {

Scene solid(const std::string& model, glm::uvec3 cells, glm::dvec3 size, double modulus, double ratio)
{
    Scene scene;
    scene.gravity = {0, 0, 0};
    scene.method.type = MethodKind::implicit_euler;
    scene.method.substeps = 1;
    scene.method.iterations = 1;
    scene.method.linear_iterations = 400;
    scene.method.precision = Precision::float64;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = cells;
    body.shape.box_size = size;
    body.shape.split = BoxSplit::six;
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.density = 1000;
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = ratio;
    scene.bodies = {body};
    return scene;
}

void hold(Scene& scene, const std::string& face)
{
    Pin pin;
    pin.faces = {face};
    scene.bodies[0].pins = {pin};
}

/// Mean displacement of the vertices whose rest place is furthest along x.
glm::dvec3 tip(const World& world)
{
    const auto& rest = world.scene().bodies[0].mesh.positions;
    const auto now = world.positions();
    double far = -1e300;
    for (const glm::dvec3& x : rest)
        far = std::max(far, x.x);
    glm::dvec3 sum(0);
    double count = 0;
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (rest[v].x > far - 1e-9)
        {
            sum += now[v] - rest[v];
            ++count;
        }
    return sum / count;
}

void settle(World& world, int frames)
{
    for (int frame = 0; frame < frames; ++frame)
        world.step();
    const StepReport report = measure(world);
    CHECK(report.status == Status::completed);
    CHECK(report.max_speed < 1e-9);
}

} // namespace

TEST_CASE("the neo-Hookean cantilever comes to rest at the golden drop", "[solid][implicit_euler]")
{
    const std::string way = GENERATE("assembled", "matrix_free");
    for (const auto& [cells, drop] :
         {std::pair{glm::uvec3(4, 1, 1), 0.006393940413}, {glm::uvec3(8, 2, 2), 0.012903837800}})
    {
        Scene scene = solid("neo_hookean_simple", cells, {1, 0.25, 0.25}, 1e7, 0.3);
        scene.gravity = {0, 0, -9.81};
        scene.damping = 5;
        scene.method.linear_operator = option_named<LinearOperator>(way);
        hold(scene, "left");
        World world(resolve(scene), test_device("cpu:serial"));
        settle(world, 600);
        const double off = -tip(world).z / drop - 1;
        if (std::getenv("TAUT_NOTES"))
            WARN(way << " " << cells.x << " cells: drop / golden - 1 = " << off);
        CHECK(std::abs(off) < 1e-6);
    }
}

TEST_CASE("solids at rest stay at rest under implicit Euler", "[solid][implicit_euler]")
{
    const std::string model = GENERATE("neo_hookean", "neo_hookean_simple", "springs");
    const double ratio = GENERATE(0.3, 0.49);
    for (const std::string& selector : test_devices())
    {
        CAPTURE(model, ratio, selector);
        Scene scene = solid(model, {3, 3, 3}, {1, 1, 1}, 1e6, ratio);
        scene.method.precision = Precision::float32;
        scene.method.linear_iterations = 20;
        World world(resolve(scene), test_device(selector));
        for (int frame = 0; frame < 60; ++frame)
            world.step();
        const StepReport report = measure(world);
        CHECK(report.status == Status::completed);
        CHECK(report.max_speed < 1e-4);
        CHECK(std::abs(report.volume.ratio - 1) < 1e-5);
    }
}

TEST_CASE("a stretched block under implicit Euler comes back, with a line search and without",
          "[solid][implicit_euler]")
{
    const std::string model = GENERATE("neo_hookean", "neo_hookean_simple", "springs");
    const std::uint32_t search = GENERATE(0u, 6u);
    const std::string way = GENERATE("assembled", "matrix_free");
    CAPTURE(model, search, way);
    Scene scene = solid(model, {3, 3, 3}, {1, 1, 1}, 1e5, 0.3);
    scene.damping = 2;
    scene.method.iterations = 3;
    scene.method.line_search = search;
    scene.method.linear_operator = option_named<LinearOperator>(way);
    scene = resolve(scene);
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    for (glm::dvec3& x : scene.bodies[0].start_positions)
        x.x *= 2;
    World world(scene, test_device("cpu:serial"));
    const double before = measure(world).potential_energy;
    double energy = before;
    for (int frame = 0; frame < 300; ++frame)
    {
        world.step();
        const StepReport report = measure(world);
        const double now = report.kinetic_energy + report.potential_energy;
        CHECK(now < energy + 1e-9 * before);
        energy = now;
    }
    const StepReport report = measure(world);
    CHECK(report.status == Status::completed);
    CHECK(report.volume.inverted == 0);
    CHECK(std::abs(report.volume.ratio - 1) < 1e-6);
}

TEST_CASE("the two operators take the same steps of solids", "[solid][implicit_euler]")
{
    const std::string model = GENERATE("neo_hookean", "springs");
    std::vector<glm::dvec3> places[2];
    for (int k = 0; k < 2; ++k)
    {
        Scene scene = solid(model, {4, 2, 2}, {1, 0.5, 0.5}, 1e5, 0.3);
        scene.gravity = {0, 0, -9.81};
        scene.method.linear_operator = k == 0 ? LinearOperator::assembled : LinearOperator::matrix_free;
        scene.method.linear_tolerance = 1e-12;
        hold(scene, "left");
        World world(resolve(scene), test_device("cpu:serial"));
        for (int frame = 0; frame < 20; ++frame)
            world.step();
        places[k] = world.positions();
    }
    double worst = 0;
    for (std::size_t v = 0; v < places[0].size(); ++v)
        worst = std::max(worst, glm::distance(places[0][v], places[1][v]));
    CAPTURE(model, worst);
    CHECK(worst < 1e-9);
}

TEST_CASE("one scene of Young's moduli from 1e2 to 1e11 Pa stays finite", "[solid][implicit_euler]")
{
    Scene scene = solid("neo_hookean", {2, 2, 2}, {0.5, 0.5, 0.5}, 1e2, 0.3);
    scene.gravity = {0, 0, -9.81};
    scene.method.precision = GENERATE(Precision::float32, Precision::float64);
    scene.method.linear_iterations = 100;
    hold(scene, "left");
    for (int power = 3; power <= 11; ++power)
    {
        Body body = scene.bodies[0];
        body.material.youngs_modulus = std::pow(10.0, power);
        body.transform.translate = {0, 2.0 * power, 0};
        scene.bodies.push_back(body);
    }
    World world(resolve(scene), test_device("cpu"));
    for (int frame = 0; frame < 120; ++frame)
        world.step();
    for (const glm::dvec3& x : world.positions())
        CHECK(std::isfinite(x.x + x.y + x.z));
    CHECK(rank(measure(world).status) <= rank(Status::unconverged)); // the softest hangs through itself
}
