// Numbers of an effect that another key would have to switch on are warned of, and only then.

#include "support/catch.hpp"
#include "taut/scene/scene.hpp"

#include <functional>

using namespace taut;

namespace {

Scene with_body(ShapeKind kind)
{
    Scene scene;
    scene.bodies.resize(1);
    scene.bodies[0].shape.kind = kind;
    if (kind == ShapeKind::box)
        scene.bodies[0].material = solid_material();
    return scene;
}

} // namespace

TEST_CASE("numbers of plasticity, gas and attachments that nothing switches on are warned of", "[scene]")
{
    struct Case
    {
        const char* field;
        const char* missing;
        std::function<void(Body&)> set, switch_on;
    };
    const Case cases[] = {
        {"plastic_creep", "plastic_yield", [](Body& b) { b.material.plastic_creep = 3; },
         [](Body& b) { b.material.plastic_yield = 0.1; }},
        {"plastic_limit", "plastic_yield", [](Body& b) { b.material.plastic_limit = 0.5; },
         [](Body& b) { b.material.plastic_yield = 0.1; }},
        {"pressure_law", "pressure", [](Body& b) { b.material.pressure_law = PressureLaw::isothermal; },
         [](Body& b) { b.material.pressure = 100; }},
        {"attachment_slack", "no pins", [](Body& b) { b.material.attachment_slack = 0; },
         [](Body& b) { b.pins.emplace_back().vertices = {0}; }},
    };
    for (const ShapeKind kind : {ShapeKind::grid, ShapeKind::box})
        for (const Case& c : cases)
        {
            CAPTURE(c.field, kind == ShapeKind::box);
            Scene scene = with_body(kind);
            REQUIRE(check(scene).empty());
            c.set(scene.bodies[0]);
            const auto issues = check(scene);
            REQUIRE(issues.size() == 1);
            CHECK(!issues[0].error);
            CHECK(issues[0].field == std::string("bodies[0].material.") + c.field);
            CHECK_THAT(issues[0].text, Contains("does nothing") && Contains(c.missing));
            c.switch_on(scene.bodies[0]);
            CHECK(check(scene).empty());
        }
}

TEST_CASE("a gravity and readings in other units are warned of", "[scene]")
{
    Scene scene = with_body(ShapeKind::grid);
    scene.gravity = {0, -98.1, 0};
    CHECK(check(scene).empty());
    scene.gravity = {0, -981, 0};
    REQUIRE(check(scene).size() == 1);
    CHECK(!check(scene)[0].error);
    CHECK(check(scene)[0].field == "gravity");
    CHECK_THAT(check(scene)[0].text, Contains("981 m/s^2") && Contains("in m"));

    const auto warned = [](double extension) {
        const Scene read = parse_scene(R"({"taut": 1, "duration": 1, "bodies": [{"grid": {"cells": [2, 2]},
            "material": {"fabric": {"kes": {"extension": [)" +
                                       std::to_string(extension) +
                                       R"(, 4], "linearity": [0.8, 0.8], "shear": [0.8, 0.8]}}}}]})");
        std::size_t count = 0;
        for (const SceneIssue& issue : check(read))
            count += !issue.error && issue.field == "bodies[0].material.fabric.kes.extension" ? 1 : 0;
        return count;
    };
    CHECK(warned(4) == 0);
    CHECK(warned(0.04) == 1);
}

TEST_CASE("the stiffness of edges beside a network of springs is warned of", "[scene]")
{
    Scene scene = with_body(ShapeKind::grid);
    scene.bodies[0].shape.network.used = true;
    for (const double nothing : {Material().stretch_stiffness, 0.0})
    {
        scene.bodies[0].material.stretch_stiffness = nothing;
        CHECK(check(scene).empty());
    }
    scene.bodies[0].material.stretch_stiffness = 1000;
    const auto issues = check(scene);
    REQUIRE(issues.size() == 1);
    CHECK(!issues[0].error);
    CHECK(issues[0].field == "bodies[0].material.stretch_stiffness");
    CHECK_THAT(issues[0].text, Contains("does nothing") && Contains("network"));
}
