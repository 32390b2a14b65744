// Keys of woven cloth.

#include "taut/scene/checker.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

constexpr Key kFabric[] = {
    key<&Fabric::warp>("warp", "Young's modulus times thickness along the grain")
        .unit("N/m")
        .above(0)
        .needed()
        .see("fabric.md", "fabric.md"),
    key<&Fabric::weft>("weft", "the same across the grain").unit("N/m").above(0).needed(),
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
