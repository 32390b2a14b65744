#include "taut/scene/fabric.hpp"

#include <algorithm>
#include <cmath>

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

double FabricRigidity::along(double square) const
{
    const double across = 1 - square;
    return d11 * square * square + d33 * square * across + d22 * across * across;
}

double largest_bias(const FabricBending& bending)
{
    constexpr double kShare = 1.9; // at 2 the twist would be rigid
    return kShare * 2 / (1 / bending.warp + 1 / bending.weft);
}

FabricRigidity fabric_rigidity(const FabricBending& bending)
{
    const double warp = bending.warp, weft = bending.weft;
    if (!(bending.bias > 0))
        return {warp, weft, 2 * std::sqrt(warp * weft)};
    if (bending.bias_of == "sheet")
        return {warp, weft, 4 * bending.bias - warp - weft};
    const double bias = std::min(bending.bias, largest_bias(bending));
    return {warp, weft, 1 / (1 / bias - (1 / warp + 1 / weft) / 4)};
}

} // namespace taut
