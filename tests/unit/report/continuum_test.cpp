// R1: the equilibrium of finer and finer meshes, extrapolated, against a closed form; and what has none.

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/continuum.hpp"
#include "taut/report/cost.hpp"

#include <cmath>

using namespace taut;

namespace {

constexpr double kLength = 0.1, kDensity = 0.2, kHeld = 0.025;

/// A level strip of a plate, held where x < 0 and free over kLength, whose density g L^3 / B is 5.
Scene strip(std::uint32_t cells)
{
    Scene scene;
    scene.gravity = {0, -9.81, 0};
    scene.damping = 6;
    Body body;
    body.shape.cells = {cells, cells / 5};
    body.shape.size = {kLength + kHeld, kHeld};
    body.transform.rotate_axis = {1, 0, 0};
    body.transform.rotate_degrees = -90;
    body.transform.translate = {(kLength + kHeld) / 2 - kHeld, 0, 0};
    Material& material = body.material;
    material.density = kDensity;
    material.stretch_stiffness = 0;
    material.bending_stiffness = kDensity * 9.81 * std::pow(kLength, 3) / 5;
    material.bending_model = BendingModel::plate;
    material.fabric.used = true;
    material.fabric.warp = material.fabric.weft = 1e6 * material.bending_stiffness / (kLength * kLength);
    material.fabric.shear = material.fabric.warp / 2;
    Pin pin;
    pin.use_box = true;
    pin.box_min = {-1, -1, -1};
    pin.box_max = {1e-6, 1, 1};
    body.pins = {pin};
    scene.bodies.push_back(body);
    return scene;
}

std::string reason(const Scene& scene) { return continuum_reference(scene).reason; }

bool has(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

} // namespace

TEST_CASE("the continuum of a plate is the heavy elastica, more closely than any of its meshes",
          "[reference]")
{
    constexpr double kElastica = 0.58572; // H / W of theta'' = -5 (1 - s) cos theta
    const ContinuumReference found = continuum_reference(strip(10));
    REQUIRE(found.reason.empty());
    CHECK((found.vertices == std::vector<std::size_t>{33, 105, 369}));
    CHECK(std::abs(found.order - 2) < 0.4);
    const glm::dvec3 tip = found.positions[21], foot = found.positions[13]; // of the middle row
    CAPTURE(tip.x, tip.y, foot.x, foot.y, found.text);
    CHECK(std::abs(-(tip.y - foot.y) / (tip.x - foot.x) / kElastica - 1) < 0.004);
    CHECK((found.mesh_error > 0.005 && found.mesh_error < 0.1));
    CHECK(found.error < 0.2 * found.mesh_error);
    const ContinuumReference coarser = continuum_reference(strip(5));
    REQUIRE(coarser.reason.empty());
    CHECK(found.mesh_error < 0.4 * coarser.mesh_error);
}

TEST_CASE("a mesh too fine to be refined twice is refined once and coarsened once", "[reference]")
{
    Scene scene = strip(10);
    scene.bodies[0].shape.cells = {100, 100}; // 400 x 400 would be 160,801 vertices
    CHECK(has(reason(scene), "more than 6000 vertices"));
    Scene chain;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 1500;
    body.material.stretch_stiffness = 100;
    body.pins.emplace_back().corners = {"first"};
    chain.bodies.push_back(body);
    const ContinuumReference found = continuum_reference(chain);
    CAPTURE(found.reason, found.text);
    CHECK((found.vertices == std::vector<std::size_t>{751, 1501, 3001}));
    CHECK(found.mesh_error <
          1e-9); // a chain's vertices hang where those of the rope do, however many there are
    chain.bodies[0].shape.links = 1501;
    CHECK(has(reason(chain), "a count of cells is odd"));
}

TEST_CASE("what has no finer mesh, and what R2 does not know, has no continuum", "[reference]")
{
    Scene scene = strip(10);
    scene.bodies[0].pins[0].vertices = {0, 1};
    CHECK(has(reason(scene), "pins that name vertices"));
    scene = strip(10);
    scene.bodies[0].vertex_masses.assign(33, 1);
    CHECK(has(reason(scene), "single vertices"));
    scene = strip(10);
    scene.bodies[0].shape.kind = ShapeKind::mesh;
    CHECK(has(reason(scene), "no finer one"));
    CHECK(has(reason(resolve(strip(10))), "resolved already"));
    scene = strip(10);
    scene.colliders.emplace_back();
    CHECK(has(reason(scene), "colliders"));
}

TEST_CASE("a study with a continuum has two errors a point, and says from where on work is lost on the mesh",
          "[cost]")
{
    const Scene scene = strip(10);
    CostOptions options;
    options.substeps = {40, 400};
    options.iterations = {1};
    options.precisions = {Precision::float64};
    options.repeats = 1;
    options.continuum = continuum_reference(scene);
    const double mesh = options.continuum->mesh_error;
    const CostStudy study = run_cost(scene, test_device("cpu:serial"), options);
    REQUIRE(study.continuum);
    const CostPoint &poor = study.points[0], &good = study.points[1];
    REQUIRE((poor.error && good.error && good.error_continuum));
    CHECK(*good.error < 0.2 * mesh);
    CHECK(*good.error_continuum == Approx(mesh).epsilon(0.3)); // the mesh's is left
    CHECK(*poor.error > *good.error);
    CHECK(has(study.points[1].floor, "mesh"));
    CHECK(has(cost_sentences(study).back(), "off the continuum: 400 substeps"));
    CHECK(has(cost_json(study), "\"mesh_error\""));
    CHECK(has(cost_csv(study), ",error_continuum\n"));
    CHECK(has(svg(cost_plot(study, CostAxis::sweeps)), "error of the mesh"));
    options.kind = CostKind::moving;
    CHECK_THROWS_AS(run_cost(scene, test_device("cpu:serial"), options), Error);
}
