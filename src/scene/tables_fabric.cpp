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
        out = fabric_presets().front().fabric; // so that nothing is said to lack a modulus, too
        name->refuse("it must be " + listing(known));
    }
    for (const char* readings : {"kes", "fast"})
        if (fabric.find(readings))
            name->fail("stands beside \"" + std::string(readings) + "\", which gives moduli, too; keep one");
    const double shear = fabric.find("bias") ? 0 : preset->fabric.shear;
    out = preset->fabric;
    out.shear = shear;
}

constexpr std::string_view kPresetOr = "needed without `preset`, `kes` or `fast`";

bool has_bending(const Fabric& fabric) { return fabric.bending.used; }
bool has_kes(const Fabric& fabric) { return fabric.kes.used; }
bool has_fast(const Fabric& fabric) { return fabric.fast.used; }
bool has_peirce(const Fabric& fabric) { return fabric.peirce.used; }
/// Readings that are out of range leave moduli at 0, and are told themselves.
bool has_warp(const Fabric& fabric) { return fabric.warp != 0 || !(fabric.kes.used || fabric.fast.used); }
bool has_weft(const Fabric& fabric) { return fabric.weft != 0 || !(fabric.kes.used || fabric.fast.used); }

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
        .usually(kPresetOr)
        .when<has_warp>(),
    key<&Fabric::weft>("weft", "the same across the grain")
        .unit("N/m")
        .above(0)
        .usually(kPresetOr)
        .when<has_weft>(),
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
    object<&Fabric::bending>("bending",
                             "bending rigidities by direction, in place of the material's "
                             "`bending_stiffness`; without either, from readings, else 0",
                             kFabricBendingTable)
        .when<has_bending>(),
    object<&Fabric::kes>("kes", "moduli as Kawabata's instruments print them", kKesTable).when<has_kes>(),
    object<&Fabric::fast>("fast", "moduli as the instruments of FAST print them", kFastTable)
        .when<has_fast>(),
    object<&Fabric::peirce>("peirce", "bending by the overhangs of the cantilever test", kPeirceTable)
        .when<has_peirce>(),
    key<&Fabric::grain_of>("grain_of", "where the warp lies: along `grain`, or along the second texture "
                                       "coordinate (v) of the mesh file"),
    key<&Fabric::grain>("grain", "along the warp, in the frame of the shape; projected onto each triangle")
        .direction(),
    key<&Fabric::grain_degrees>("grain_degrees",
                                "the warp is turned by this, counter-clockwise as triangles are: 45 is cut "
                                "on the bias")
        .unit("degrees"),
};

} // namespace

constinit const TableOf<Fabric> kFabricTable = TableOf<Fabric>("fabric", kFabric).checks<check_fabric>();

} // namespace taut::scene_file
