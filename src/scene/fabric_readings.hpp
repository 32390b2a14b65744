#pragma once
// What the instruments that measure fabrics print, in their units, and the SI values that follow.
//
// Based on: Kawabata, The Standardization and Analysis of Hand Evaluation, 1980 (KES-FB1, KES-FB2); De Boos,
//   Tester, SiroFAST, 1994 (FAST-2, FAST-3); Peirce, The "Handle" of Cloth as a Measurable Quantity, 1930.
// Departures: the bending length is that of the heavy elastica, not of Peirce's formula (peirce_rigidity).

#include <glm/vec2.hpp>

namespace taut {

/// Kawabata's KES-FB1 and KES-FB2. Pairs are [warp, weft].
struct KesReadings
{
    bool used = false;
    glm::dvec2 extension{0}; ///< %, EMT: strain at 500 gf/cm, > 0
    /// LT: work up to there over that of a straight line, > 0.667. The modulus is that of small strain where
    /// the tension is a parabola of the strain: (3 LT - 2) of the secant's.
    glm::dvec2 linearity{1};
    glm::dvec2 shear{0};   ///< gf/(cm degree), G; the mean of both counts; 0: none
    glm::dvec2 bending{0}; ///< gf cm^2/cm, B; 0: none
};

/// FAST-2 and FAST-3. Pairs are [warp, weft].
struct FastReadings
{
    bool used = false;
    glm::dvec2 extension_5{0};  ///< %, E5: strain at 5 gf/cm, >= 0
    glm::dvec2 extension_20{0}; ///< %, E20: strain at 20 gf/cm, above E5
    double bias_5 = 0;          ///< %, EB5: strain of a bias strip at 5 gf/cm; 0: none
    glm::dvec2 length{0};       ///< mm, c of FAST-2, the bending length; 0: none
};

/// The cantilever test (ASTM D1388, Shirley): the length that hangs over an edge when its tip meets the plane
/// at 41.5 degrees below.
struct PeirceReadings
{
    bool used = false;
    double warp = 0; ///< cm, > 0
    double weft = 0; ///< cm, > 0
    double bias = 0; ///< cm; 0: none
};

/// N/m of one direction, from EMT [%] and LT.
double kes_modulus(double extension, double linearity);
/// N/m per radian, from G [gf/(cm degree)].
double kes_shear(double shear);
/// N m, from B [gf cm^2/cm].
double kes_rigidity(double bending);
/// N/m of one direction, from E5 and E20 [%].
double fast_modulus(double extension_5, double extension_20);
/// N/m at 45 degrees, from EB5 [%].
double fast_bias(double bias_5);
/// N m, from the bending length c [mm] and the density [kg/m^2]: density * g * c^3.
double fast_rigidity(double length, double density);
/// N m, from the overhang O [cm] and the density [kg/m^2]: density * g * O^3 / 8.0042. 8.0042 is the
/// gravito-bending number of the heavy elastica whose chord falls by 41.5 degrees.
double peirce_rigidity(double overhang, double density);

} // namespace taut
