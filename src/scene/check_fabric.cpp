// What takes more than one key of a fabric, and of a material that has one.

#include "taut/scene/checker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace taut::scene_file {
namespace {

/// Bending, contact and air are apart from what holds cloth together; these are properties of springs.
void check_beside(const Material& material, const Checker& out)
{
    const auto refuse = [&](const char* key, double value, const char* unit, const char* why) {
        out.error(key, "is " + shown(value) + unit + " beside a fabric" + why);
    };
    if (material.stretch_stiffness != 0)
        refuse("stretch_stiffness", material.stretch_stiffness, " N/m",
               ", whose moduli take the place of springs; leave one of the two out (a program sets it to 0)");
    if (material.strain_limit != 0)
        refuse("strain_limit", material.strain_limit, "",
               ", which has no springs to limit; leave one of the two out");
    if (material.tear_strain != 0)
        refuse("tear_strain", material.tear_strain, "",
               ", which has no springs to tear; leave one of the two out");
    if (material.plastic_yield != 0)
        refuse("plastic_yield", material.plastic_yield, "",
               ", which has no springs that could keep a strain; leave one of the two out");
    if (material.bending_stiffness != 0 && material.fabric.bending.used)
        refuse("bending_stiffness", material.bending_stiffness, " N m",
               " with bending rigidities of its own; leave one of the two out");
    if (material.stretch_damping != 0)
        out.warning("stretch_damping",
                    "is " + shown(material.stretch_damping) +
                        " s beside a fabric, whose membrane has no dampers; it holds for the "
                        "body's `springs` alone");
}

void check_shear(const Fabric& fabric, const Checker& out)
{
    if (fabric.shear == 0 && fabric.bias == 0)
        out.error("", "lacks \"shear\" (N/m), or \"bias\" (N/m) that it follows from");
    if (fabric.shear != 0 && fabric.bias != 0)
        out.error("", "has both \"shear\" and \"bias\"; keep one, the other follows from it");
    const double most = 4 / (1 / fabric.warp + 1 / fabric.weft - 2 * fabric.poissons_ratio / fabric.warp);
    if (fabric.shear == 0 && fabric.bias >= most)
        out.error("bias", "is " + shown(fabric.bias) +
                              " N/m; with these moduli of warp and weft a strip at 45 "
                              "degrees is softer than " +
                              shown(most, 4) + " N/m however stiff it is in shear");
}

/// One of the two numbers of a pair without the other says nothing.
void check_pair(const char* key, const glm::dvec2& pair, const Checker& out)
{
    if ((pair.x > 0) != (pair.y > 0))
        out.error(key, "is [" + shown(pair.x) + ", " + shown(pair.y) +
                           "]; give both warp and weft, or leave it out");
}

/// Readings in another unit are off by a factor of 10 and more: beyond what cloth has. 0: none was given.
void warn_of_unit(std::string_view member, const glm::dvec2& pair, double least, double most,
                  std::string_view unit, const Checker& out)
{
    const double low = std::min(pair.x, pair.y), high = std::max(pair.x, pair.y);
    if ((low > 0 && low < least) || high > most)
        out.warning(member,
                    "is [" + shown(pair.x) + ", " + shown(pair.y) + "]; readings are " + std::string(unit));
}

/// Moduli, and rigidities, come from one place.
void check_sources(const Fabric& fabric, const Checker& out)
{
    if (fabric.kes.used && fabric.fast.used)
        out.error("", "has readings of both \"kes\" and \"fast\"; keep one");
    const bool kes = fabric.kes.used && fabric.kes.bending.x > 0;
    const bool fast = fabric.fast.used && fabric.fast.length.x > 0;
    if (fabric.peirce.used && (kes || fast))
        out.error("peirce", std::string("stands beside ") + (kes ? "\"kes.bending\"" : "\"fast.length\"") +
                                ", which says how the fabric bends, too; keep one");
}

} // namespace

void check_fabric_bending(const FabricBending& bending, const Checker& out)
{
    if (!(bending.warp > 0) || !(bending.weft > 0) || !(bending.bias > 0))
        return;
    const double least = (bending.warp + bending.weft) / 4, most = largest_bias(bending);
    if (bending.bias_of == BiasSpecimen::sheet && bending.bias <= least)
        out.error("bias", "is " + shown(bending.bias) +
                              " N m; a sheet of these rigidities of warp and weft has " + shown(least, 4) +
                              " N m with no resistance to twist: above that would be right");
    if (bending.bias_of == BiasSpecimen::strip && bending.bias > most)
        out.warning("bias", "is " + shown(bending.bias) +
                                " N m; no strip bends as hard that twists as freely "
                                "as warp and weft let it: " +
                                shown(most, 4) + " N m is taken, 1.9 of their harmonic mean");
}

void check_kes(const KesReadings& kes, const Checker& out)
{
    warn_of_unit("extension", kes.extension, 0.5, 100, "% at 500 gf/cm, 1 to 30 of most cloth", out);
    warn_of_unit("linearity", kes.linearity, 0, 2, "a ratio, 0.7 to 1.1 of most cloth", out);
    warn_of_unit("shear", kes.shear, 0.02, 20, "gf/(cm degree), 0.2 to 5 of most cloth", out);
    warn_of_unit("bending", kes.bending, 1e-4, 5, "gf cm^2/cm, 0.01 to 0.5 of most cloth", out);
    check_pair("shear", kes.shear, out);
    check_pair("bending", kes.bending, out);
}

void check_fast(const FastReadings& fast, const Checker& out)
{
    check_pair("length", fast.length, out);
    warn_of_unit("length", fast.length, 4, 200, "mm, 10 to 60 of most cloth", out);
    const bool good = fast.extension_20.x > fast.extension_5.x && fast.extension_20.y > fast.extension_5.y;
    if (!good && fast.extension_20.x > 0 && fast.extension_20.y > 0)
        out.error("extension_20", "is [" + shown(fast.extension_20.x) + ", " + shown(fast.extension_20.y) +
                                      "] %; the strain at 20 gf/cm must be above that at 5 gf/cm, [" +
                                      shown(fast.extension_5.x) + ", " + shown(fast.extension_5.y) + "] %");
}

void check_peirce(const PeirceReadings& peirce, const Checker& out)
{
    constexpr double kLeast = 0.4, kMost = 25; // cm; overhangs of cloth are 2 to 12
    for (const auto& [member, overhang] :
         {std::pair("warp", peirce.warp), std::pair("weft", peirce.weft), std::pair("bias", peirce.bias)})
        if (overhang > 0 && (overhang < kLeast || overhang > kMost))
            out.warning(member, "is " + shown(overhang) + "; overhangs are cm, 2 to 12 of most cloth");
}

void check_fabric(const Fabric& fabric, const Checker& out)
{
    check_sources(fabric, out);
    if (!(fabric.warp > 0) || !(fabric.weft > 0))
        return; // their ranges have told
    const double most = std::sqrt(fabric.warp / fabric.weft);
    if (std::abs(fabric.poissons_ratio) >= most)
        return out.error("poissons_ratio", "is " + shown(fabric.poissons_ratio) +
                                               "; with these moduli it must be between " + shown(-most, 4) +
                                               " and " + shown(most, 4) +
                                               ", the root of warp over weft, else pulling costs no energy");
    check_shear(fabric, out);
}

void check_fabric_beside(const Material& material, const Checker& out)
{
    if (material.fabric.used)
        check_beside(material, out);
}

void check_fabric_body(const Body& body, const Checker& out)
{
    if (!body.material.fabric.used)
        return;
    if (body.shape.kind == ShapeKind::chain)
        out.error("material.fabric",
                  "is of a chain, which has no triangles; take a grid or a mesh, or give the "
                  "chain a stretch_stiffness");
    if (is_solid(body.shape.kind))
        out.error("material.fabric", "is of a solid; a solid is as stiff as youngs_modulus (Pa) and "
                                     "poissons_ratio say");
    if (body.shape.kind == ShapeKind::grid && body.shape.network.used)
        out.error("material.fabric", "stands beside a network of springs; leave one of the two out");
    if (body.material.fabric.grain_of == GrainSource::texture && body.shape.kind == ShapeKind::grid)
        out.error("material.fabric.grain_of",
                  "is \"texture\" of a grid, which has no texture coordinates; take "
                  "\"direction\" and a grain, or a mesh file that has some");
    if (body.shape.kind == ShapeKind::grid && body.shape.diagonals == Diagonals::uniform)
        out.warning("grid.diagonals",
                    "is \"uniform\" beside a fabric: triangles that all lean one way cannot shear "
                    "along the bias as cloth does, and stiffen it; \"alternating\" is right");
}

} // namespace taut::scene_file
