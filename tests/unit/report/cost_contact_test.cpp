// Errors of contact beside the errors of places (report/cost_contact.hpp).

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/cost.hpp"
#include "taut/report/errors.hpp"

using namespace taut;

namespace {

/// A cloth of 0.15 m and 0.2 kg/m^2 that falls 2 mm onto a plate that stands.
Scene sheet_on_plate()
{
    Scene scene;
    Body sheet;
    sheet.shape.cells = {8, 8};
    sheet.shape.size = {0.15, 0.15};
    sheet.material.density = 0.2;
    sheet.material.stretch_stiffness = 1000;
    sheet.material.bending_stiffness = 1e-4;
    sheet.material.thickness = 0.002;
    sheet.transform.rotate_axis = {1, 0, 0};
    sheet.transform.rotate_degrees = -90;
    Body plate = sheet;
    plate.shape.cells = {9, 9};
    plate.shape.size = {0.3, 0.3};
    plate.kinematic.used = true;
    sheet.transform.translate = {0.011, 0.006, 0.007};
    scene.bodies = {sheet, plate};
    scene.contact.between = true;
    scene.contact.friction = 0.3;
    return scene;
}

CostOptions three_settings(CostKind kind)
{
    CostOptions options;
    options.kind = kind;
    options.substeps = {2, 5, 20};
    options.iterations = {1};
    options.precisions = {Precision::float32};
    options.repeats = 1;
    return options;
}

} // namespace

TEST_CASE("errors of contact are shares of the reference's impulse")
{
    const cost::ContactTrace reference{2, 0.5, 0.001};
    const auto error = cost::contact_error({1.5, 0.75, 0.003}, reference);
    REQUIRE(error);
    CHECK(error->impulse == Approx(0.25));
    CHECK(error->friction == Approx(0.125));
    CHECK(error->depth == 0.003);
    CHECK_FALSE(cost::contact_error({1, 0, 0}, {0, 0, 0}));
}

TEST_CASE("a study at rest knows that a plate carries the weight of what lies on it")
{
    const CostStudy study =
        run_cost(sheet_on_plate(), test_device("cpu:serial"), three_settings(CostKind::at_rest));
    for (const std::string& passed : study.reference.passed)
        UNSCOPED_INFO(passed);
    REQUIRE(study.contact);
    CHECK(study.contact->impulse == Approx(0.2 * 0.0225 * 9.81 * 1).epsilon(0.01)); // N s, in a second
    CHECK(study.contact->friction < 0.02 * study.contact->impulse);
    REQUIRE(study.points.size() == 3);
    double depth = HUGE_VAL;
    for (const CostPoint& point : study.points)
    {
        INFO(point.substeps << " " << point.reason);
        REQUIRE(point.contact);
        CHECK(point.contact->impulse < 0.02);
        CHECK(point.contact->depth < depth); // as g h^2
        depth = point.contact->depth;
    }
    CHECK(depth > 0);
    CHECK_THAT(cost_csv(study), Contains(",impulse_error,friction_error,contact_depth\n"));
    CHECK_THAT(cost_json(study), Contains("\"impulse_error\": "));
}

TEST_CASE("a study of what slides over another surface knows its friction")
{
    Scene scene = sheet_on_plate();
    scene.bodies[0].velocity = {2, 0, 0};
    scene.bodies[0].transform.translate = {-0.3, 0.004, 0.007}; // where it lies
    scene.bodies[1].shape.size = {1, 0.3};
    scene.duration = 0.25;
    const CostStudy study = run_cost(scene, test_device("cpu:serial"), three_settings(CostKind::moving));
    for (const std::string& passed : study.reference.passed)
        UNSCOPED_INFO(passed);
    REQUIRE(study.contact);
    CHECK(study.contact->friction == Approx(0.3 * study.contact->impulse).epsilon(0.02)); // Coulomb's
    for (const CostPoint& point : study.points)
    {
        REQUIRE(point.contact);
        CHECK(point.contact->friction == Approx(0.3 * point.contact->impulse).margin(0.01));
    }
}

TEST_CASE("a study without surfaces that meet has no column for them")
{
    Scene scene = sheet_on_plate();
    scene.bodies.pop_back();
    scene.damping = 5;
    scene.contact = SceneContact();
    scene.bodies[0].pins.emplace_back().edges = {"top"};
    const CostStudy study = run_cost(scene, test_device("cpu:serial"), three_settings(CostKind::at_rest));
    CHECK_FALSE(study.contact);
    CHECK_THAT(cost_csv(study), !Contains("impulse_error"));
    CHECK_THAT(cost_json(study), Contains("\"contact\": null"));
}
