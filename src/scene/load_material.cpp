#include "taut/scene/load_material.hpp"

#include <limits>

namespace taut::scene_file {
namespace {

/// A number, or the word for one without bound.
void read_or_unbounded(const Field& object, std::string_view key, std::string_view unit,
                       std::string_view word, double& out)
{
    const auto value = object.find(key);
    if (!value)
        return;
    if (!value->is_text())
        out = value->number();
    else if (value->text() == word)
        out = std::numeric_limits<double>::infinity();
    else
        value->refuse("it must be a number in " + std::string(unit) + " or \"" + std::string(word) + '"');
}

void read_or_rigid(const Field& object, std::string_view key, std::string_view unit, double& out)
{
    read_or_unbounded(object, key, unit, "rigid", out);
}

} // namespace

void read_material(Field field, bool solid, Material& material)
{
    field.object(solid ? "solid material" : "material");
    field.read("density", material.density);
    if (solid)
    {
        field.read("youngs_modulus", material.youngs_modulus);
        field.read("poissons_ratio", material.poissons_ratio);
        field.read("model", material.model);
        field.read("volume", material.volume);
    }
    else
    {
        read_or_rigid(field, "stretch_stiffness", "N/m", material.stretch_stiffness);
        field.read("tear_strain", material.tear_strain);
    }
    read_or_rigid(field, "volume_stiffness", "Pa", material.volume_stiffness);
    if (field.find("volume_stiffness") && material.volume_stiffness < 0)
        field.need("volume_stiffness").refuse("it must be 0 Pa or more, or \"rigid\"");
    field.read("bending_stiffness", material.bending_stiffness);
    field.read("thickness", material.thickness);
    field.read("stretch_damping", material.stretch_damping);
    field.read("strain_limit", material.strain_limit);
    field.read("attachment_slack", material.attachment_slack);
    field.read("drag", material.drag);
    field.read("friction_drag", material.friction_drag);
    field.read("pressure", material.pressure);
    field.read("pressure_law", material.pressure_law);
    field.read("plastic_yield", material.plastic_yield);
    read_or_unbounded(field, "plastic_creep", "1/s", "at once", material.plastic_creep);
    field.read("plastic_limit", material.plastic_limit);
}

} // namespace taut::scene_file
