// What takes more than one key of a shape or a material.

#include "taut/scene/checker.hpp"

namespace taut::scene_file {
namespace {

/// More cells than a body may have vertices.
bool too_many(double x, double y, double z = 0) { return (x + 1) * (y + 1) * (z + 1) > kMaxVertices; }

/// Numbers of an effect that another key would have to switch on.
void warn_of_idle_numbers(const Material& material, const Checker& out)
{
    const Material none;
    const std::string flows = ", which does nothing: without a plastic_yield (a strain) nothing flows";
    if (material.plastic_yield == 0 && material.plastic_creep != none.plastic_creep)
        out.warning("plastic_creep", "is " + shown(material.plastic_creep) + " 1/s" + flows);
    if (material.plastic_yield == 0 && material.plastic_limit != none.plastic_limit)
        out.warning("plastic_limit", "is " + shown(material.plastic_limit) + flows);
    if (material.pressure == 0 && material.pressure_law != none.pressure_law)
        out.warning("pressure_law", "is " + quoted(material.pressure_law) +
                                        ", which does nothing: there is no gas without a pressure (Pa)");
}

} // namespace

void check_grid(const Shape& shape, const Checker& out)
{
    const auto cells = shape.cells;
    if (too_many(cells.x, cells.y))
        out.error("cells", "is [" + std::to_string(cells.x) + ", " + std::to_string(cells.y) +
                               "]; the grid may have at most 67108864 vertices");
}

void check_box(const Shape& shape, const Checker& out)
{
    const auto c = shape.box_cells;
    if (too_many(c.x, c.y, c.z))
        out.error("cells", "is [" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " +
                               std::to_string(c.z) + "]; the box may have at most 67108864 vertices");
}

void check_ball(const Shape& shape, const Checker& out)
{
    const std::uint32_t n = shape.ball_cells;
    if (too_many(n, n, n))
        out.error("cells", "is " + std::to_string(n) + "; the ball may have at most 67108864 vertices");
}

/// Torn cloth encloses nothing and is planned anew.
void check_cloth(const Material& material, const Checker& out)
{
    check_fabric_beside(material, out);
    warn_of_idle_numbers(material, out);
    if (material.bending_model == BendingModel::plate && !resists_bending(material))
        out.warning("bending_model", "is \"plate\" of cloth that does not resist bending; give it a "
                                     "bending_stiffness (N m), or a fabric that bends");
    if (material.bending_model == BendingModel::hinge && material.bending_poissons_ratio != 0)
        out.warning("bending_poissons_ratio", "is " + shown(material.bending_poissons_ratio) +
                                                  " of hinges, which have none of their own; it is for "
                                                  "bending_model \"plate\"");
    if (!(material.tear_strain > 0))
        return;
    const std::string beside = " beside tear_strain " + shown(material.tear_strain);
    if (material.volume_stiffness > 0)
        out.error("volume_stiffness", "is " + shown(material.volume_stiffness) + " Pa" + beside +
                                          "; torn cloth encloses nothing, so set one of them to 0");
    if (material.pressure != 0)
        out.error("pressure", "is " + shown(material.pressure) + " Pa" + beside +
                                  "; torn cloth encloses nothing, so set one of them to 0");
    if (material.plastic_yield > 0)
        out.error("plastic_yield", "is " + shown(material.plastic_yield) + beside +
                                       "; a tear plans the scene anew and would forget what has flowed, so "
                                       "set one of them to 0");
}

void check_solid(const Material& material, const Checker& out)
{
    if (material.tear_strain != 0)
        out.error("tear_strain", "is " + shown(material.tear_strain) + "; solids do not tear");
    warn_of_idle_numbers(material, out);
    if (material.model == SolidModel::springs)
        return;
    const std::string none = ", which does nothing: only model \"springs\" has springs and held volumes";
    if (material.strain_limit > 0)
        out.warning("strain_limit", "is " + shown(material.strain_limit) + none);
    if (material.stretch_damping > 0)
        out.warning("stretch_damping", "is " + shown(material.stretch_damping) + none);
    if (material.volume_stiffness != -1)
        out.warning("volume_stiffness", "is " + shown(material.volume_stiffness) + none);
    if (material.volume == HeldVolume::surface)
        out.warning("volume", "is \"surface\"" + none);
}

} // namespace taut::scene_file
