// What instruments read becomes moduli and rigidities in SI units; numbers worked out by hand from the
// definitions of the tests (docs/fabric.md).

#include "refusal.hpp"
#include "support/catch.hpp"

#include "taut/scene/scene.hpp"

#include <cmath>
#include <string>

using namespace taut;

namespace {

std::string text(const std::string& fabric, const std::string& beside = "")
{
    return R"({"taut": 1, "bodies": [{"grid": {"cells": [2, 2]}, "material": {"density": 0.25, "fabric": {)" +
           fabric + "}" + beside + "}}]}";
}

Fabric read(const std::string& fabric) { return parse_scene(text(fabric)).bodies[0].material.fabric; }

const std::string kKes = R"("kes": {"extension": [4, 10], "linearity": [0.8, 1], "shear": [1, 0.6],
                            "bending": [0.1, 0.05]})";
const std::string kModuli = R"("warp": 1000, "weft": 900, "shear": 50)";

} // namespace

TEST_CASE("readings of KES become moduli at small strain, shear a radian and rigidities")
{
    const Fabric fabric = read(kKes);
    const double load = 500 * 0.980665; // 500 gf/cm, N/m
    CHECK(fabric.warp == Approx(load / 0.04 * 0.4));
    CHECK(fabric.weft == Approx(load / 0.1));
    CHECK(fabric.shear == Approx(0.8 * 56.1880).epsilon(1e-5)); // gf/(cm degree) to N/m a radian
    CHECK(fabric.bending.warp == Approx(9.80665e-6));
    CHECK(fabric.bending.weft == Approx(4.903325e-6));
    // The tension that the modulus begins does the work that LT says: E0 s^2 / 2 + b s^3 / 3.
    const double s = 0.04, b = (load - fabric.warp * s) / (s * s);
    CHECK(fabric.warp * s * s / 2 + b * s * s * s / 3 == Approx(0.8 * load * s / 2));
}

TEST_CASE("readings of FAST and of the cantilever become moduli and rigidities with the density")
{
    const Fabric fast = read(R"("fast": {"extension_5": [0.5, 1], "extension_20": [1.1, 3], "bias_5": 4,
                                         "length": [20, 18]})");
    CHECK(fast.warp == Approx(15 * 0.980665 / 0.006));
    CHECK(fast.weft == Approx(15 * 0.980665 / 0.02));
    CHECK(fast.bias == Approx(5 * 0.980665 / 0.04));
    CHECK(shear_modulus(fast) == Approx(1 / (4 / fast.bias - 1 / fast.warp - 1 / fast.weft)));
    CHECK(fast.bending.warp == Approx(0.25 * 9.80665 * 8e-6)); // density g c^3
    // An overhang is twice the bending length, but for 0.02 %.
    const Fabric peirce = read(kModuli + R"(, "peirce": {"warp": 4, "weft": 3.6, "bias": 3.8})");
    CHECK(peirce.bending.warp == Approx(fast.bending.warp).epsilon(1e-3));
    CHECK(peirce.bending.weft == Approx(fast.bending.weft).epsilon(1e-3));
    CHECK(peirce.bending.bias == Approx(0.25 * 9.80665 * std::pow(0.038, 3) / 8.0042));
    CHECK(peirce.bending.bias_of == BiasSpecimen::strip);
}

TEST_CASE("keys beside readings stay, and a program's readings count when the scene is resolved")
{
    const Fabric own = read(kKes + R"(, "warp": 7000, "bias": 150, "bending": {"warp": 1e-5, "weft": 2e-5})");
    CHECK(own.warp == 7000);
    CHECK(own.weft == Approx(4903.325));
    CHECK(own.shear == 0);
    CHECK(own.bias == 150);
    CHECK(own.bending.weft == 2e-5);

    Scene scene = parse_scene(text(kModuli));
    scene.bodies[0].material.fabric.peirce = {true, 4, 3, 0};
    const Body body = resolve(scene).bodies[0];
    CHECK(body.material.fabric.bending.used);
    CHECK(body.material.fabric.bending.weft == Approx(peirce_rigidity(3, 0.25)));
}

TEST_CASE("rigidities by direction: isotropic, of a strip and of a sheet")
{
    const FabricRigidity even = fabric_rigidity({true, 2, 2, 0, BiasSpecimen::strip});
    for (const double square : {0.0, 0.3, 0.5, 1.0})
        CHECK(even.along(square) == Approx(2));
    CHECK(fabric_rigidity({true, 2, 2, 2, BiasSpecimen::strip}).d33 == Approx(4)); // as an even sheet twists
    CHECK(fabric_rigidity({true, 2, 2, 2, BiasSpecimen::sheet}).d33 == Approx(4));
    const FabricRigidity woven = fabric_rigidity({true, 4, 1, 1.5, BiasSpecimen::sheet});
    CHECK(woven.along(1) == 4);
    CHECK(woven.along(0) == 1);
    CHECK(woven.along(0.5) == Approx(1.5));
    CHECK(fabric_rigidity({true, 4, 1, 1.5, BiasSpecimen::sheet}, 0.2).along(0.5) == Approx(1.5));
    // A strip at 45 degrees twists as it bends, and so is softer than the sheet.
    const FabricRigidity strip = fabric_rigidity({true, 4, 1, 1.2, BiasSpecimen::strip});
    CHECK(1 / (1 / strip.d33 + (1 / 4.0 + 1) / 4) == Approx(1.2));
    CHECK(strip.along(0.5) > 1.2);
    // Strips curve across as they bend: compliances of strips are those that were measured.
    const FabricRigidity wide = fabric_rigidity({true, 4, 1, 1.2, BiasSpecimen::strip}, 0.3);
    const double det = wide.d11 * wide.d22 - wide.d12 * wide.d12;
    CHECK(det / wide.d22 == Approx(4));
    CHECK(det / wide.d11 == Approx(1));
    const double across = -wide.d12 / det, s11 = wide.d22 / det, s22 = wide.d11 / det;
    CHECK(1 / ((s11 + s22 + 2 * across) / 4 + 1 / wide.d33) == Approx(1.2));
    CHECK(std::isfinite(fabric_rigidity({true, 4, 1, 100, BiasSpecimen::strip}).d33));
    CHECK(fabric_rigidity({true, 4, 1, 100, BiasSpecimen::strip}).d33 > 0);
}

TEST_CASE("readings and rigidities that cannot be are refused with the key and what would be right")
{
    const auto says = [](const std::string& json, const std::string& part) {
        const std::string why = refusal(json);
        INFO(why);
        CHECK(why.find(part) != std::string::npos);
    };
    CHECK(refusal(text(kKes)) == "nothing");
    says(text(R"("kes": {"extension": [4, 0], "shear": [1, 1]})"), "kes.extension is [4, 0]");
    says(text(R"("kes": {"extension": [4, 4], "linearity": [0.6, 1], "shear": [1, 1]})"), "kes.linearity");
    says(text(R"("kes": {"extension": [4, 4], "shear": [1, 0]})"), "give both warp and weft");
    says(text(R"("kes": {"extension": [4, 4]})"), "lacks \"shear\" (N/m)");
    says(text(R"("fast": {"extension_5": [2, 1], "extension_20": [1.5, 3], "bias_5": 4})"),
         "must be above that at 5 gf/cm, [2, 1] %");
    says(text(kKes + R"(, "fast": {"extension_5": [0, 1], "extension_20": [1.5, 3]})"),
         "both \"kes\" and \"fast\"");
    says(text(kKes + R"(, "peirce": {"warp": 4, "weft": 3})"), "stands beside \"kes.bending\"");
    says(text(kKes + R"(, "preset": "clyde_cotton")"), "stands beside \"kes\", which gives moduli, too");
    says(text(kKes, R"(, "bending_stiffness": 1e-5)"), "bending_stiffness is 1e-05 N m beside a fabric");
    says(text(kModuli + R"(, "peirce": {"warp": 4})"), "peirce.weft is 0 cm");
    says(text(kModuli + R"(, "bending": {"warp": 1, "weft": 4, "bias": 1, "bias_of": "sheet"})"),
         "1.25 N m with no resistance to twist");
    says(text(kModuli + R"(, "bending": {"warp": 1, "weft": 4, "bias_of": "strips"})"),
         "\"strip\" or \"sheet\"");
    const auto found = check(parse_scene(
        text(kModuli + R"(, "bending": {"warp": 1, "weft": 4, "bias": 5})"))); // twice the harmonic mean: 3.2
    REQUIRE(found.size() == 1);
    CHECK(!found[0].error);
    CHECK(found[0].text.find("3.04 N m is taken") != std::string::npos);
}
