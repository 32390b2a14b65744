// The search for the cheapest setting of solids, by their volume, and of cloth and solids together. Prices
// are priors, so nothing depends on the machine's speed.
#include "support/catch.hpp"

#include "support/scenes.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/report/volume.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

std::shared_ptr<Device> serial() { return Device::open("cpu:serial"); }

Body box(const std::string& model, double modulus, const glm::dvec3& at)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {2, 2, 2};
    body.shape.box_size = {0.3, 0.3, 0.3};
    body.material = solid_material();
    body.material.model = option_named<SolidModel>(model);
    body.material.youngs_modulus = modulus;
    body.transform.translate = at;
    return body;
}

/// A box of springs and volumes that falls on a floor.
Scene dropped()
{
    Scene scene;
    scene.name = "dropped";
    scene.bodies = {box("springs", 1e5, {0, 0.25, 0})};
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    scene.duration = 0.5;
    return resolve(scene);
}

Scene sheet()
{
    Scene scene = test::hanging(4);
    scene.name = "sheet";
    scene.bodies[0].material.stretch_stiffness = 20;
    scene.duration = 0.25;
    return scene;
}

/// A sheet and, beside it, an elastic box, both hung.
Scene mixed()
{
    Scene solid;
    solid.bodies = {box("neo_hookean", 2e4, {1, 0, 0})};
    solid.bodies[0].pins.resize(1);
    solid.bodies[0].pins[0].faces = {"top"};
    Scene out = sheet();
    out.name = "mixed";
    out.bodies.push_back(resolve(solid).bodies[0]);
    return out;
}

TuneOptions by_prior(double error, TuneCriterion by)
{
    TuneOptions options;
    options.error = error;
    options.by = by;
    options.prior_only = true;
    options.precisions = {Precision::float32};
    options.reference_steps = 5e8;
    return options;
}

} // namespace

TEST_CASE("by volume the cheapest setting keeps it in every frame, and cheaper ones did not", "[tune]")
{
    const Scene scene = dropped();
    const TuneResult result = tune(scene, serial(), by_prior(0.02, TuneCriterion::volume));
    INFO(settings_text(result.settings));
    REQUIRE(result.found);
    CHECK(result.metric == "e_V");
    CHECK(result.frames == 30);
    CHECK(result.starts == 3);
    CHECK(result.confirmed_error <= 0.8 * 0.02);
    World world(tuning::with_method(scene, result.settings), serial());
    double worst = 0;
    for (std::size_t f = 0; f < result.frames; ++f)
    {
        world.step();
        worst = std::max(worst, std::abs(measure_volume(scene, world.positions()).ratio - 1));
    }
    CHECK(worst == result.predicted_error);
    CHECK(std::any_of(result.rejected.begin(), result.rejected.end(),
                      [](const TuneRejection& r) { return r.stage == "race" && *r.error > 0.016; }));
    const auto json = nlohmann::json::parse(tune_json(result));
    CHECK(json["error_metric"] == "e_V");
    CHECK(json["reference"]["class"] == "rest volume");
}

TEST_CASE("an error of volume asks for a body that has one, and for motion", "[tune]")
{
    TuneOptions options = by_prior(0.1, TuneCriterion::volume);
    CHECK_THROWS_AS(tune(sheet(), serial(), options), Error);
    options.kind = CostKind::at_rest;
    CHECK_THROWS_AS(tune(dropped(), serial(), options), Error);
}

TEST_CASE("cloth and solids in one scene are tuned together: what cannot move both is out", "[tune]")
{
    const TuneResult result = tune(mixed(), serial(), by_prior(0.1, TuneCriterion::motion));
    INFO(result.reference.text << " " << settings_text(result.settings));
    REQUIRE(result.found);
    CHECK(result.reference.name == "R3");
    CHECK(result.confirmed_error <= 0.08);
    for (const MethodKind method :
         {MethodKind::mass_spring, MethodKind::implicit_constraints, MethodKind::acad, MethodKind::pbd})
    {
        CHECK(result.settings.type != method);
        const auto out = [&](const TuneRejection& r) {
            return r.settings.type == method && r.stage == "filter" &&
                   r.reason.find("neo_hookean") != std::string::npos;
        };
        CHECK(std::any_of(result.rejected.begin(), result.rejected.end(), out));
    }
}
