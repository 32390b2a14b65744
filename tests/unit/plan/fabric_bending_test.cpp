// Hinges of a fabric: rigidity by the direction in which the sheet curves there.

#include "support/catch.hpp"

#include "taut/plan/material.hpp"
#include "taut/scene/scene.hpp"

#include <cmath>
#include <numbers>
#include <string>

using namespace taut;

namespace {

constexpr int kCells = 32;

/// A square metre whose warp is turned from x by some degrees.
Body sheet(double degrees, const std::string& bending, const std::string& diagonals = "uniform")
{
    const std::string cells = std::to_string(kCells);
    const std::string json = R"({"taut": 1, "bodies": [{"grid": {"cells": [)" + cells + ',' + cells +
                             R"(], "diagonals": ")" + diagonals +
                             R"("}, "material": {"fabric": {"warp": 1000, "weft": 900, "shear": 50, )" +
                             R"("grain": [1, 0, 0], "grain_degrees": )" + std::to_string(degrees) +
                             R"(, "bending": {)" + bending + "}}}}]}";
    return resolve(parse_scene(json)).bodies[0];
}

/// J: of the sheet rolled up along x with the curvature, over that of a continuum of 1 N m.
double rolled(const Body& sheet)
{
    constexpr double kCurvature = 0.1;
    std::vector<glm::dvec3> x = sheet.mesh.positions;
    for (glm::dvec3& p : x)
        p = {std::sin(kCurvature * p.x) / kCurvature, p.y, (1 - std::cos(kCurvature * p.x)) / kCurvature};
    double energy = 0;
    for (const BendElement& h : bend_elements(sheet))
    {
        const double angle = dihedral_angle(x[h.edge0], x[h.edge1], x[h.wing0], x[h.wing1]);
        energy += angle * angle / h.compliance / 2;
    }
    return energy / (kCurvature * kCurvature / 2);
}

} // namespace

TEST_CASE("a sheet that is rolled up has the rigidity of the direction that curves")
{
    const std::string woven = R"("warp": 4, "weft": 1, "bias": 1.5, "bias_of": "sheet")";
    // A cylinder along a grid whose cells are cut one way has all but 1/n of the continuum's energy.
    const double share = 1 - 1.0 / kCells;
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0})
    {
        CAPTURE(degrees);
        const double c2 = std::pow(std::cos(degrees * std::numbers::pi / 180), 2), s2 = 1 - c2;
        const double expected = 4 * c2 * c2 + s2 * s2 + (4 * 1.5 - 5) * c2 * s2;
        CHECK(rolled(sheet(degrees, woven)) == Approx(expected * share).epsilon(2e-3));
    }
}

TEST_CASE("a fabric of even rigidities has the hinges of one rigidity")
{
    Body even = sheet(30, R"("warp": 0.5, "weft": 0.5)", "alternating");
    const auto by_direction = bend_elements(even);
    even.material.fabric.bending.used = false;
    CHECK(bend_elements(even).empty());
    even.material.bending_stiffness = 0.5;
    const auto by_one = bend_elements(even);
    REQUIRE(by_direction.size() == by_one.size());
    for (std::size_t i = 0; i < by_one.size(); ++i)
        CHECK(by_direction[i].compliance == Approx(by_one[i].compliance).epsilon(1e-12));
}
