// Fabrics in scene files: moduli, the elements that they become, and what is refused.

#include "refusal.hpp"
#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/scene/fabric_presets.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <string>

using namespace taut;

namespace {

/// A scene of one body: its shape and its material as JSON.
std::string text(const std::string& material, const std::string& body = R"("grid": {"cells": [2, 1]})")
{
    return R"({"taut": 1, "bodies": [{)" + body + R"(, "material": )" + material + "}]}";
}

std::string fabric(const std::string& keys, const std::string& beside = "")
{
    return R"({"fabric": {)" + keys + "}" + beside + "}";
}

const std::string kGood = R"("warp": 5000, "weft": 2500, "poissons_ratio": 0.3, "shear": 60)";

} // namespace

TEST_CASE("a fabric becomes a membrane for each triangle and takes the place of springs")
{
    const Scene scene = resolve(parse_scene(text(fabric(kGood))));
    const Body& body = scene.bodies[0];
    CHECK(body.material.stretch_stiffness == 0);
    REQUIRE(body.elements.size() == 1);
    const Body::Elements& list = body.elements[0];
    CHECK(list.kind == "membrane");
    CHECK(list.vertices.size() == 3 * body.mesh.triangles.size());
    REQUIRE(list.values.size() == 8 * body.mesh.triangles.size());
    const double share = 1 - 0.09 * 0.5, area = 0.25; // 1 - nu12 nu21; two cells a square metre
    CHECK(list.values[4] == Approx(5000 / share * area));
    CHECK(list.values[5] == Approx(0.3 * 2500 / share * area));
    CHECK(list.values[6] == Approx(2500 / share * area));
    CHECK(list.values[7] == Approx(60 * area));
    // P turns the rest edges into those of the material: warp along y, weft across.
    const auto& x = body.mesh.positions;
    const auto& t = body.mesh.triangles[0];
    const glm::dvec3 e1 = x[t[1]] - x[t[0]], e2 = x[t[2]] - x[t[0]];
    const glm::dvec3 warp = e1 * list.values[0] + e2 * list.values[2];
    const glm::dvec3 weft = e1 * list.values[1] + e2 * list.values[3];
    CHECK(glm::distance(warp, {0, 1, 0}) < 1e-12);
    CHECK(std::abs(weft.x) == Approx(1));
    CHECK(std::abs(weft.y) + std::abs(weft.z) < 1e-12);
}

TEST_CASE("the grain turns with the body and is projected onto triangles")
{
    const std::string body = R"("grid": {"cells": [1, 1]}, "transform": {"rotate": {"axis": [0, 0, 1],
                               "degrees": 90}, "scale": 3})";
    const Scene scene = resolve(parse_scene(text(fabric(kGood + R"(, "grain": [1, 0, 1])"), body)));
    const auto& x = scene.bodies[0].mesh.positions;
    const auto& t = scene.bodies[0].mesh.triangles[1];
    const auto& values = scene.bodies[0].elements[0].values;
    const glm::dvec3 warp = (x[t[1]] - x[t[0]]) * values[8] + (x[t[2]] - x[t[0]]) * values[10];
    CHECK(glm::distance(warp, {0, 1, 0}) < 1e-12);
}

TEST_CASE("the modulus of a bias strip gives that of shear")
{
    Fabric cloth;
    cloth.warp = 5000;
    cloth.weft = 2500;
    cloth.poissons_ratio = 0.3;
    cloth.bias = 233.2814935;
    CHECK(shear_modulus(cloth) == Approx(60).epsilon(1e-6));
    cloth.shear = 12;
    CHECK(shear_modulus(cloth) == 12);
}

TEST_CASE("what a fabric cannot be is refused with the key, its value and what would be right")
{
    const auto says = [](const std::string& json, const std::string& part) {
        const std::string why = refusal(json);
        INFO(why);
        CHECK(why.find(part) != std::string::npos);
    };
    CHECK(refusal(text(fabric(kGood))) == "nothing");
    CHECK(refusal(text(fabric(kGood, R"(, "bending_stiffness": 1e-5)"))) == "nothing");
    says(text(fabric(R"("weft": 1, "shear": 1)")), "or a preset, which `taut fabrics` lists");
    says(text(fabric(R"("warp": 0, "weft": 1, "shear": 1)")), "material.fabric.warp");
    says(text(fabric(R"("warp": 1, "weft": 1)")), "lacks \"shear\" (N/m), or \"bias\"");
    says(text(fabric(kGood + R"(, "bias": 100)")), "has both \"shear\" and \"bias\"");
    says(text(fabric(R"("warp": 4, "weft": 1, "shear": 1, "poissons_ratio": 2)")), "between -2 and 2");
    says(text(fabric(R"("warp": 1, "weft": 1, "bias": 2)")), "softer than 2 N/m");
    says(text(fabric(kGood + R"(, "grain": [0, 0, 0])")), "must have a direction");
    says(text(fabric(kGood + R"(, "grain": [0, 0, 1])")), "material.fabric.grain is [0, 0, 1]");
    says(text(fabric(kGood, R"(, "stretch_stiffness": 10)")), "stretch_stiffness is 10 N/m beside a fabric");
    says(text(fabric(kGood, R"(, "strain_limit": 0.1)")), "strain_limit is 0.1 beside a fabric");
    says(text(fabric(kGood, R"(, "tear_strain": 0.1)")), "tear_strain is 0.1 beside a fabric");
    says(text(fabric(kGood, R"(, "plastic_yield": 0.1)")), "plastic_yield is 0.1 beside a fabric");
    says(text(fabric(kGood), R"("chain": {"links": 3})"), "a chain, which has no triangles");
    says(text(fabric(kGood), R"("grid": {"cells": [2, 2], "network": {}})"), "beside a network of springs");
    says(text(fabric(kGood), R"("box": {"cells": [1, 1, 1]})"), "fabric");
}

TEST_CASE("a grid whose cells are all cut one way is a warning beside a fabric")
{
    const auto found = [](const std::string& diagonals) {
        const std::string body = R"("grid": {"cells": [2, 2], "diagonals": ")" + diagonals + "\"}";
        return check(parse_scene(text(fabric(kGood), body)));
    };
    CHECK(found("alternating").empty());
    REQUIRE(found("uniform").size() == 1);
    CHECK(!found("uniform")[0].error);
    CHECK(found("uniform")[0].field == "bodies[0].grid.diagonals");
}

TEST_CASE("a preset gives a fabric's moduli and density, and keys beside it change them")
{
    const Material silk = parse_scene(text(fabric(R"("preset": "clyde_silk_charmeuse")"))).bodies[0].material;
    CHECK(silk.density == 0.083);
    CHECK(silk.fabric.used);
    CHECK(silk.fabric.warp == 327);
    CHECK(silk.fabric.shear == 51);
    CHECK(silk.stretch_stiffness == 0);
    const Material changed =
        parse_scene(text(fabric(R"("preset": "clyde_silk_charmeuse", "warp": 400, "bias": 150)",
                                R"(, "density": 0.1)")))
            .bodies[0]
            .material;
    CHECK(changed.density == 0.1);
    CHECK(changed.fabric.warp == 400);
    CHECK(changed.fabric.weft == 755);
    CHECK(changed.fabric.shear == 0);
    CHECK(changed.fabric.bias == 150);
    const std::string unknown = refusal(text(fabric(R"("preset": "silk")")));
    CHECK(unknown.find("it must be \"penava_cotton\"") != std::string::npos);
    CHECK(unknown.find("warp") == std::string::npos); // nor is it said to lack moduli
    for (const FabricPreset& preset : fabric_presets())
    {
        CAPTURE(preset.name);
        CHECK(refusal(text(fabric("\"preset\": \"" + std::string(preset.name) + '"'))) == "nothing");
    }
}

TEST_CASE("membranes take three times the substeps of springs under xpbd, stiff yarns more", "[substeps]")
{
    Scene scene = test::hanging(20);
    scene.method.type = MethodKind::xpbd;
    scene.method.substeps = 0;
    const double springs = resolve(scene).method.substeps;
    scene.bodies[0].material.stretch_stiffness = 0;
    Fabric& fabric = scene.bodies[0].material.fabric = {.used = true, .warp = 1000, .weft = 1000};
    const auto with_shear = [&](double shear) {
        fabric.shear = shear;
        return double(resolve(scene).method.substeps);
    };
    CHECK(with_shear(100) == Approx(3 * springs).margin(3));
    CHECK(with_shear(25) == Approx(6 * springs).margin(6));    // by the root of yarn over shear
    CHECK(with_shear(0.1) == Approx(12 * springs).margin(12)); // and no more than four times
    fabric.warp = 4000;
    CHECK(with_shear(100) == Approx(6 * springs).margin(6)); // the stiffer yarn
}
