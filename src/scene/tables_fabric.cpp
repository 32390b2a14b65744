// Keys of woven cloth.

#include "taut/scene/checker.hpp"
#include "taut/scene/fabric_presets.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

/// Moduli of the preset; keys of its own, which are read later, take their place.
void read_preset(const Field& fabric, Fabric& out)
{
    const auto name = fabric.find("preset");
    if (!name)
        return;
    const FabricPreset* preset = find_fabric_preset(name->text());
    if (preset == nullptr)
    {
        std::vector<std::string_view> known;
        for (const FabricPreset& one : fabric_presets())
            known.push_back(one.name);
        name->refuse("it must be " + listing(known));
    }
    const double shear = fabric.find("bias") ? 0 : preset->fabric.shear;
    out = preset->fabric;
    out.shear = shear;
}

constexpr std::string_view kPresetOr = "needed without `preset`";

constexpr Key kFabric[] = {
    ignored<Fabric>("preset", "a measured fabric, whose moduli the other keys change, and its density unless "
                              "the material has one; `taut fabrics` lists them")
        .see("fabric.md", "fabric.md")
        .ranges("a name of the list")
        .reads<read_preset>(),
    key<&Fabric::warp>("warp", "Young's modulus times thickness along the grain")
        .unit("N/m")
        .above(0)
        .because("a fabric has moduli of its own or a preset, which `taut fabrics` lists")
        .usually(kPresetOr),
    key<&Fabric::weft>("weft", "the same across the grain").unit("N/m").above(0).usually(kPresetOr),
    key<&Fabric::shear>("shear",
                        "shear modulus times thickness between warp and weft, per radian; this or `bias`")
        .unit("N/m")
        .at_least(0)
        .usually("by `bias`"),
    key<&Fabric::bias>("bias",
                       "Young's modulus times thickness at 45 degrees to the grain, of a strip that is free "
                       "to narrow; this or `shear`")
        .unit("N/m")
        .at_least(0)
        .usually("by `shear`"),
    key<&Fabric::poissons_ratio>("poissons_ratio", "how far a strip narrows that is pulled along the grain")
        .ranges("its square below `warp` / `weft`"),
    key<&Fabric::grain>("grain", "along the warp, in the frame of the shape; projected onto each triangle")
        .direction(),
};

} // namespace

constinit const TableOf<Fabric> kFabricTable = TableOf<Fabric>("fabric", kFabric).checks<check_fabric>();

} // namespace taut::scene_file
