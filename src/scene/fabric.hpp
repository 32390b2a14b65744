#pragma once
// Woven cloth by the moduli of its two yarn directions: what a scene says of it, and the matrix that follows.

#include <glm/vec3.hpp>

namespace taut {

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
    glm::dvec3 grain{0, 1, 0}; ///< along the warp, in the frame of the shape; projected onto each triangle
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

} // namespace taut
