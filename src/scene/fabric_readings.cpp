#include "taut/scene/fabric_readings.hpp"

#include "taut/scene/fabric.hpp"

#include <numbers>

namespace taut {
namespace {

constexpr double kGramForce = 9.80665e-3;          ///< N
constexpr double kGramForceACm = 100 * kGramForce; ///< N/m
constexpr double kGravity = 9.80665;               ///< m/s^2, where instruments stand
constexpr double kOverhang = 8.0042;               ///< density g O^3 / B at a chord of 41.5 degrees
constexpr double kKesLoad = 500, kFastLow = 5, kFastHigh = 20; ///< gf/cm

double strain(double percent) { return percent / 100; }

void apply_moduli(Fabric& fabric, double warp, double weft)
{
    if (fabric.warp == 0 && warp > 0)
        fabric.warp = warp;
    if (fabric.weft == 0 && weft > 0)
        fabric.weft = weft;
}

void apply_bending(Fabric& fabric, double warp, double weft, double bias = 0)
{
    if (fabric.bending.used || !(warp > 0) || !(weft > 0))
        return;
    fabric.bending = {true, warp, weft, bias, BiasSpecimen::strip};
}

void apply_kes(const KesReadings& kes, Fabric& fabric)
{
    if (kes.extension.x > 0 && kes.extension.y > 0)
        apply_moduli(fabric, kes_modulus(kes.extension.x, kes.linearity.x),
                     kes_modulus(kes.extension.y, kes.linearity.y));
    if (fabric.shear == 0 && fabric.bias == 0)
        fabric.shear = kes_shear((kes.shear.x + kes.shear.y) / 2);
    apply_bending(fabric, kes_rigidity(kes.bending.x), kes_rigidity(kes.bending.y));
}

void apply_fast(const FastReadings& fast, double density, Fabric& fabric)
{
    if (fast.extension_20.x > fast.extension_5.x && fast.extension_20.y > fast.extension_5.y)
        apply_moduli(fabric, fast_modulus(fast.extension_5.x, fast.extension_20.x),
                     fast_modulus(fast.extension_5.y, fast.extension_20.y));
    if (fabric.shear == 0 && fabric.bias == 0 && fast.bias_5 > 0)
        fabric.bias = fast_bias(fast.bias_5);
    apply_bending(fabric, fast_rigidity(fast.length.x, density), fast_rigidity(fast.length.y, density));
}

} // namespace

double kes_modulus(double extension, double linearity)
{
    return kKesLoad * kGramForceACm / strain(extension) * (3 * linearity - 2);
}

double kes_shear(double shear) { return shear * kGramForceACm * 180 / std::numbers::pi; }

double kes_rigidity(double bending) { return bending * kGramForce / 100; }

double fast_modulus(double extension_5, double extension_20)
{
    return (kFastHigh - kFastLow) * kGramForceACm / strain(extension_20 - extension_5);
}

double fast_bias(double bias_5) { return kFastLow * kGramForceACm / strain(bias_5); }

double fast_rigidity(double length, double density)
{
    const double c = length / 1000;
    return density * kGravity * c * c * c;
}

double peirce_rigidity(double overhang, double density)
{
    const double o = overhang / 100;
    return density * kGravity * o * o * o / kOverhang;
}

void apply_readings(Fabric& fabric, double density)
{
    if (fabric.kes.used)
        apply_kes(fabric.kes, fabric);
    if (fabric.fast.used)
        apply_fast(fabric.fast, density, fabric);
    const PeirceReadings& peirce = fabric.peirce;
    if (peirce.used)
        apply_bending(fabric, peirce_rigidity(peirce.warp, density), peirce_rigidity(peirce.weft, density),
                      peirce_rigidity(peirce.bias, density));
}

} // namespace taut
