#include "taut/scene/fabric_presets.hpp"

#include <algorithm>

namespace taut {
namespace {

Fabric moduli(double warp, double weft, double poissons_ratio, double shear)
{
    Fabric out;
    out.used = true;
    out.warp = warp;
    out.weft = weft;
    out.poissons_ratio = poissons_ratio;
    out.shear = shear;
    return out;
}

constexpr std::string_view kPenava = "Penava et al. 2014, plain weave, as C-IPC's materials quote it; shear "
                                     "by the modulus at 45 degrees; which "
                                     "axis is the warp is not said";
constexpr std::string_view kClyde = "Clyde, Teran, Tamstorf 2017, as C-IPC's materials quote the fit at "
                                    "small strain; density read as of an area";
constexpr std::string_view kWang =
    "Wang, O'Brien, Ramamoorthi 2011, as ARCSim's materials quote it, at small strain; coupling not measured";

const FabricPreset kPresets[] = {
    {"penava_cotton", 0.150, moduli(10350, 3950, 0.243, 67), kPenava},
    {"penava_wool", 0.235, moduli(12400, 4630, 0.277, 24), kPenava},
    {"penava_polyester", 0.165, moduli(1300, 2940, 0.381, 32), kPenava},
    {"clyde_cotton", 0.104, moduli(2365, 3801, 0.31, 97), kClyde},
    {"clyde_wool_coating", 0.481, moduli(2175, 2108, 0.52, 237), kClyde},
    {"clyde_silk_charmeuse", 0.083, moduli(327, 755, 0.50, 51), kClyde},
    {"wang_trousers", 0.220, moduli(4033, 4070, 0, 105), kWang},
    {"wang_tablecloth", 0.128, moduli(4004, 4055, 0, 19), kWang},
};

} // namespace

std::span<const FabricPreset> fabric_presets() { return kPresets; }

const FabricPreset* find_fabric_preset(std::string_view name)
{
    const auto found = std::find_if(std::begin(kPresets), std::end(kPresets),
                                    [&](const FabricPreset& preset) { return preset.name == name; });
    return found == std::end(kPresets) ? nullptr : found;
}

} // namespace taut
