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
    return d11 * square * square + (d33 + 2 * d12) * square * across + d22 * across * across;
}

double largest_bias(const FabricBending& bending)
{
    constexpr double kShare = 1.9; // at 2 the twist would be rigid
    return kShare * 2 / (1 / bending.warp + 1 / bending.weft);
}

FabricRigidity fabric_rigidity(const FabricBending& bending, double nu)
{
    const double warp = bending.warp, weft = bending.weft;
    const bool strips = bending.bias_of == BiasSpecimen::strip;
    const double held = strips ? 1 - nu * nu : 1;
    FabricRigidity out{warp / held, weft / held, 0, nu * std::sqrt(warp * weft) / held};
    const double even = 2 * (1 - nu) * std::sqrt(out.d11 * out.d22);
    if (!(bending.bias > 0))
        out.d33 = even;
    else if (!strips)
        out.d33 = std::max(4 * bending.bias - out.d11 - out.d22 - 2 * out.d12, 1e-3 * even);
    else
    {
        const double untwisted = (1 / warp + 1 / weft - 2 * nu / std::sqrt(warp * weft)) / 4;
        out.d33 = 1 / (1 / std::min(bending.bias, 0.95 / untwisted) - untwisted);
    }
    return out;
}

} // namespace taut
