// Numbers of an effect that another key would have to switch on are warned of, and only then.

#include "support/catch.hpp"
#include "taut/scene/scene.hpp"

#include <functional>

using namespace taut;
using Catch::Matchers::Contains;

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
        {"pressure_law", "pressure", [](Body& b) { b.material.pressure_law = "isothermal"; },
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
