#include "taut/scene/fabric.hpp"

namespace taut {

double shear_modulus(const Fabric& fabric)
{
    if (fabric.shear > 0)
        return fabric.shear;
    return 1 /
           (4 / fabric.bias - 1 / fabric.warp - 1 / fabric.weft + 2 * fabric.poissons_ratio / fabric.warp);
}

FabricMatrix fabric_matrix(const Fabric& fabric)
{
    const double nu = fabric.poissons_ratio;
    const double share = 1 - nu * nu * fabric.weft / fabric.warp; // 1 - nu12 nu21
    return {fabric.warp / share, nu * fabric.weft / share, fabric.weft / share, shear_modulus(fabric)};
}

} // namespace taut
