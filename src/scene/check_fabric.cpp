// What takes more than one key of a fabric, and of a material that has one.

#include "taut/scene/checker.hpp"

#include <cmath>

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

} // namespace

void check_fabric(const Fabric& fabric, const Checker& out)
{
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
    if (body.shape.kind == ShapeKind::grid && body.shape.diagonals == "uniform")
        out.warning("grid.diagonals",
                    "is \"uniform\" beside a fabric: triangles that all lean one way cannot shear "
                    "along the bias as cloth does, and stiffen it; \"alternating\" is right");
}

} // namespace taut::scene_file
