// Keys of a fabric's bending and of what instruments read.

#include "taut/scene/checker.hpp"
#include "taut/scene/tables.hpp"

namespace taut::scene_file {
namespace {

constexpr std::string_view kPair = "[warp, weft]";

void begin_bending(FabricBending& bending) { bending.used = true; }
void begin_kes(KesReadings& kes) { kes.used = true; }
void begin_fast(FastReadings& fast) { fast.used = true; }
void begin_peirce(PeirceReadings& peirce) { peirce.used = true; }

constexpr Key kBending[] = {
    key<&FabricBending::warp>("warp", "where the warp yarns curve").unit("N m").above(0).usually("needed"),
    key<&FabricBending::weft>("weft", "where the weft yarns curve").unit("N m").above(0).usually("needed"),
    key<&FabricBending::bias>("bias", "at 45 degrees to both")
        .unit("N m")
        .at_least(0)
        .usually("(√`warp` + √`weft`)² / 4"),
    key<&FabricBending::bias_of>("bias_of",
                                 "what `bias` was measured on: a narrow strip with free sides, as of a "
                                 "cantilever, or a wide sheet that curves one way only, as of KES-FB2"),
};

constexpr Key kKes[] = {
    key<&KesReadings::extension>("extension", "EMT, the strain at 500 gf/cm")
        .called(kPair)
        .unit("%")
        .above(0)
        .usually("needed"),
    key<&KesReadings::linearity>("linearity", "LT; the modulus at small strain is 3 LT - 2 of the secant's")
        .called(kPair)
        .above(0.667)
        .because("below, a parabola falls at first; leave it out for the secant modulus")
        .ranges("above 0.667 each"),
    key<&KesReadings::shear>("shear", "G; the mean of both counts; 0: another key says it")
        .called(kPair)
        .unit("gf/(cm degree)")
        .at_least(0),
    key<&KesReadings::bending>("bending", "B; 0: another key says it")
        .called(kPair)
        .unit("gf cm²/cm")
        .at_least(0),
};

constexpr Key kFast[] = {
    key<&FastReadings::extension_5>("extension_5", "E5, the strain at 5 gf/cm")
        .called(kPair)
        .unit("%")
        .at_least(0),
    key<&FastReadings::extension_20>("extension_20", "E20, the strain at 20 gf/cm")
        .called(kPair)
        .unit("%")
        .above(0)
        .usually("needed")
        .ranges("above `extension_5` each"),
    key<&FastReadings::bias_5>("bias_5", "EB5, the strain of a bias strip at 5 gf/cm; 0: another key says it")
        .unit("%")
        .at_least(0),
    key<&FastReadings::length>("length", "c, the bending length; 0: another key says it")
        .called(kPair)
        .unit("mm")
        .at_least(0),
};

constexpr Key kPeirce[] = {
    key<&PeirceReadings::warp>("warp", "overhang at 41.5° of a strip that is cut along the warp")
        .unit("cm")
        .above(0)
        .usually("needed"),
    key<&PeirceReadings::weft>("weft", "the same along the weft").unit("cm").above(0).usually("needed"),
    key<&PeirceReadings::bias>("bias", "the same at 45°; 0: none").unit("cm").at_least(0),
};

} // namespace

constinit const TableOf<FabricBending> kFabricBendingTable =
    TableOf<FabricBending>("fabric bending", kBending).begins<begin_bending>().checks<check_fabric_bending>();
constinit const TableOf<KesReadings> kKesTable =
    TableOf<KesReadings>("kes", kKes).begins<begin_kes>().checks<check_kes>();
constinit const TableOf<FastReadings> kFastTable =
    TableOf<FastReadings>("fast", kFast).begins<begin_fast>().checks<check_fast>();
constinit const TableOf<PeirceReadings> kPeirceTable =
    TableOf<PeirceReadings>("peirce", kPeirce).begins<begin_peirce>().checks<check_peirce>();

} // namespace taut::scene_file
