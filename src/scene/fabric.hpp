#pragma once
// Woven cloth by the moduli of its two yarn directions: what a scene says of it, and the matrices that
// follow.

#include "taut/scene/fabric_readings.hpp"
#include "taut/scene/options.hpp"

#include <glm/vec3.hpp>

namespace taut {

/// Bending rigidities by the direction in which the sheet curves.
struct FabricBending
{
    bool used = false; ///< false: of one rigidity (Material::bending_stiffness), or none
    double warp = 0;   ///< N m, where the warp yarns curve, > 0
    double weft = 0;   ///< N m, where the weft yarns curve, > 0
    double bias = 0; ///< N m, at 45 degrees to both; 0: as smooth as can be, (sqrt(warp) + sqrt(weft))^2 / 4
    BiasSpecimen bias_of = BiasSpecimen::strip;
};

/// Moduli of a sheet per width: Pa times its thickness. Strains are those of warp and weft and the sine of
/// the angle by which the two shear (docs/fabric.md).
struct Fabric
{
    bool used = false; ///< false: springs along the edges (Material::stretch_stiffness)
    double warp = 0;   ///< N/m, Young's modulus along the grain, > 0
    double weft = 0;   ///< N/m, across it, > 0
    double shear = 0;  ///< N/m per radian; 0: from `bias`
    double bias = 0;   ///< N/m, Young's modulus at 45 degrees to the grain; 0: from `shear`
    double poissons_ratio =
        0; ///< across, of a strip that is pulled along the grain; its square < warp / weft
    FabricBending bending = {};
    KesReadings kes = {}; ///< apply_readings() turns these three into the values above
    FastReadings fast = {};
    PeirceReadings peirce = {};
    GrainSource grain_of = GrainSource::direction;
    glm::dvec3 grain{0, 1, 0}; ///< along the warp, in the frame of the shape; projected onto each triangle
    double grain_degrees = 0;  ///< the warp is turned by this, counter-clockwise as triangles are
};

/// C of the energy e^T C e / 2 an area, e = (warp strain, weft strain, shear), N/m.
struct FabricMatrix
{
    double c11 = 0, c12 = 0, c22 = 0, c33 = 0;
};

/// N/m per radian: `shear`, or 1 / (4 / bias - 1 / warp - 1 / weft + 2 nu / warp), which a strip at 45
/// degrees shows that is free to narrow; not above 0, or infinite, where no shear modulus gives such a bias.
double shear_modulus(const Fabric& fabric);

/// Plane stress: the inverse of [[1 / warp, -nu / warp], [-nu / warp, 1 / weft]], and the shear modulus.
/// Positive definite for moduli above 0 and nu^2 < warp / weft.
FabricMatrix fabric_matrix(const Fabric& fabric);

/// D of the energy k^T D k / 2 an area, k = (curvature along the warp, along the weft, twist), N m.
struct FabricRigidity
{
    double d11 = 0, d22 = 0, d33 = 0, d12 = 0;

    /// N m, of a wide sheet that curves in one direction only, `square` = cos^2 of its angle to the warp:
    /// d11 c^4 + (d33 + 2 d12) c^2 s^2 + d22 s^4.
    double along(double square) const;
};

/// Of rigidities that were measured on strips with free sides, which curve across as well: warp = d11 (1 -
/// nu^2), weft likewise, d12 = nu sqrt(d11 d22), and d33 = 1 / (1 / bias - (1 / warp + 1 / weft - 2 nu /
/// sqrt(warp weft)) / 4), with a bias of at most 1.9 times the harmonic mean of the two (twice, without nu,
/// is the bound of any sheet; a tenth of the fabrics that Feng et al. 2022 measured lie beyond it). Of sheets
/// warp = d11, weft = d22 and d33 = 4 bias - d11 - d22 - 2 d12. Without a bias d33 = 2 (1 - nu) sqrt(d11
/// d22). nu in (-1, 1).
FabricRigidity fabric_rigidity(const FabricBending& bending, double poissons_ratio = 0);

/// N m, the largest bias that a strip of a fabric can have: 1.9 times the harmonic mean of warp and weft.
double largest_bias(const FabricBending& bending);

/// Puts what instruments read in the place of values that are 0: moduli, and with the density [kg/m^2] the
/// rigidities of bending lengths. Idempotent.
void apply_readings(Fabric& fabric, double density);

} // namespace taut
