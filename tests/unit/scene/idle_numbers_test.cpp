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
}

TEST_CASE("readings in other units are warned of", "[scene][fabric]")
{
    const auto warned = [](const std::string& fabric) {
        const Scene read = parse_scene(R"({"taut": 1, "duration": 1, "bodies": [{"grid": {"cells": [2, 2]},
            "material": {"fabric": )" + fabric +
                                       "}}]}");
        std::string fields;
        for (const SceneIssue& issue : check(read))
            if (!issue.error && issue.text.find("of most cloth") != std::string::npos)
                fields += (fields.empty() ? "" : " ") + issue.field.substr(issue.field.rfind("fabric."));
        return fields;
    };
    const auto kes = [&](const std::string& extension, const std::string& linearity, const std::string& shear,
                         const std::string& bending) {
        return warned(R"({"kes": {"extension": )" + extension + R"(, "linearity": )" + linearity +
                      R"(, "shear": )" + shear + R"(, "bending": )" + bending + "}}");
    };
    CHECK(kes("[4, 8]", "[0.8, 0.7]", "[0.8, 0.8]", "[0.1, 0.05]") == "");
    CHECK(kes("[0.04, 4]", "[0.8, 0.7]", "[0.8, 0.8]", "[0.1, 0.05]") ==
          "fabric.kes.extension");                                                            // no percent
    CHECK(kes("[4, 8]", "[80, 70]", "[0.8, 0.8]", "[0.1, 0.05]") == "fabric.kes.linearity");  // percent
    CHECK(kes("[4, 8]", "[0.8, 0.7]", "[40, 40]", "[0.1, 0.05]") == "fabric.kes.shear");      // N/m
    CHECK(kes("[4, 8]", "[0.8, 0.7]", "[0.8, 0.8]", "[1e-5, 5e-6]") == "fabric.kes.bending"); // N m
    CHECK(kes("[400, 8]", "[0.8, 0.7]", "[0.003, 0.8]", "[0.1, 50]") ==
          "fabric.kes.extension fabric.kes.shear fabric.kes.bending");
    const std::string moduli = R"({"warp": 1000, "weft": 1000, "shear": 30, "peirce": )";
    CHECK(warned(moduli + R"({"warp": 4, "weft": 3}})") == "");
    CHECK(warned(moduli + R"({"warp": 40, "weft": 30}})") == "fabric.peirce.warp fabric.peirce.weft"); // mm
    CHECK(warned(moduli + R"({"warp": 0.04, "weft": 4, "bias": 3}})") == "fabric.peirce.warp");        // m
    const std::string fast =
        R"({"fast": {"extension_5": [0.5, 1], "extension_20": [1.5, 3], "bias_5": 3, "length": )";
    CHECK(warned(fast + "[18, 15]}}") == "");
    CHECK(warned(fast + "[1.8, 1.5]}}") == "fabric.fast.length"); // cm
    CHECK(warned(fast + "[18, 300]}}") == "fabric.fast.length");
}

TEST_CASE("cloth that cannot come to the strain at which it tears is warned of", "[scene]")
{
    Scene scene = with_body(ShapeKind::grid);
    Material& material = scene.bodies[0].material;
    const auto says = [&](const std::string& why) {
        const auto issues = check(scene);
        if (issues.empty())
            return why.empty();
        return issues.size() == 1 && !issues[0].error && !why.empty() &&
               issues[0].field == "bodies[0].material.tear_strain" &&
               issues[0].text.find(why) != std::string::npos;
    };
    material.tear_strain = 0.15;
    CHECK(says(""));
    scene.method.type = MethodKind::pbd;
    CHECK(says("method pbd"));
    scene.method.type = MethodKind::acad;
    CHECK(says("activate_strain 0.05"));
    scene.method.activate_strain = 0.2;
    CHECK(says(""));
    material.strain_limit = 0.1;
    CHECK(says("strain_limit 0.1"));
    material.strain_limit = 0.3;
    CHECK(says(""));
    material.tear_strain = 0;
    material.strain_limit = 0.1;
    CHECK(says(""));
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
