// Values and ranges of shapes and materials.

#include "taut/scene/checker.hpp"

#include <array>
#include <limits>

namespace taut::scene_file {
namespace {

void check_grid(const Shape& shape, const Checker& out)
{
    constexpr std::array<std::string_view, 2> diagonals = {"alternating", "uniform"};
    const auto cells = shape.cells;
    if (cells.x < 1 || cells.y < 1 || (double(cells.x) + 1) * (double(cells.y) + 1) > kMaxVertices)
        out.error("cells", "is [" + std::to_string(cells.x) + ", " + std::to_string(cells.y) +
                               "]; both must be 1 or more, and the grid may have at most 67108864 vertices");
    if (!(shape.size.x > 0 && shape.size.y > 0 && shape.size.x <= kMaxValue && shape.size.y <= kMaxValue))
        out.error("size", "is [" + shown(shape.size.x) + ", " + shown(shape.size.y) +
                              "]; both must be greater than 0 m and finite");
    out.word("diagonals", shape.diagonals, diagonals);
    const Checker network = out.at("network");
    network.not_negative("structural", shape.network.structural, "N/m");
    network.not_negative("shear", shape.network.shear, "N/m");
    network.not_negative("bend", shape.network.bend, "N/m");
}

void check_chain(const Shape& shape, const Checker& out)
{
    if (shape.links >= kMaxVertices)
        out.error("links", "is " + std::to_string(shape.links) + "; a chain may have at most 67108863 links");
    if (shape.links > 0)
        out.positive("length", shape.length, "m");
    out.positive("width", shape.width, "m");
}

/// More cells than a body may have vertices.
bool too_many(double x, double y, double z)
{
    return (x + 1) * (y + 1) * (z + 1) > kMaxVertices;
}

void check_box(const Shape& shape, const Checker& out)
{
    constexpr std::array<std::string_view, 2> splits = {"five", "six"};
    const auto c = shape.box_cells;
    if (c.x < 1 || c.y < 1 || c.z < 1 || too_many(c.x, c.y, c.z))
        out.error("cells", "is [" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " +
                               std::to_string(c.z) +
                               "]; each must be 1 or more, and the box may have at most 67108864 vertices");
    for (int axis = 0; axis < 3; ++axis)
        out.positive("size", shape.box_size[axis], "m");
    out.word("split", shape.split, splits);
}

void check_ball(const Shape& shape, const Checker& out)
{
    const std::uint32_t n = shape.ball_cells;
    if (n < 2 || too_many(n, n, n))
        out.error("cells", "is " + std::to_string(n) +
                               "; it must be 2 or more, and the ball may have at most 67108864 vertices");
    out.positive("radius", shape.radius, "m");
}

/// What only tetrahedra have.
void check_solid(const Material& material, const Checker& out)
{
    constexpr std::array<std::string_view, 3> models = {"neo_hookean", "neo_hookean_simple", "springs"};
    constexpr std::array<std::string_view, 2> volumes = {"tetrahedra", "surface"};
    out.positive("youngs_modulus", material.youngs_modulus, "Pa");
    if (!(material.poissons_ratio > -1 && material.poissons_ratio < 0.5))
        out.error("poissons_ratio", "is " + shown(material.poissons_ratio) +
                                        "; it must be greater than -1 and less than 0.5 (0.5 is "
                                        "incompressible: take model \"springs\" with volume_stiffness "
                                        "\"rigid\")");
    out.word("model", material.model, models);
    out.word("volume", material.volume, volumes);
    if (material.tear_strain > 0)
        out.error("tear_strain", "is " + shown(material.tear_strain) + "; solids do not tear");
    if (material.model == "springs")
        return;
    const std::string none = ", which does nothing: only model \"springs\" has springs and held volumes";
    if (material.strain_limit > 0)
        out.warning("strain_limit", "is " + shown(material.strain_limit) + none);
    if (material.stretch_damping > 0)
        out.warning("stretch_damping", "is " + shown(material.stretch_damping) + none);
    if (material.volume_stiffness != -1)
        out.warning("volume_stiffness", "is " + shown(material.volume_stiffness) + none);
}

/// The gas within a closed surface, and what strain leaves behind.
void check_gas_and_flow(const Material& material, const Checker& out)
{
    constexpr std::array<std::string_view, 2> laws = {"constant", "isothermal"};
    out.finite("pressure", material.pressure, "Pa");
    out.word("pressure_law", material.pressure_law, laws);
    out.not_negative("plastic_yield", material.plastic_yield, "(a strain)");
    if (material.plastic_creep != std::numeric_limits<double>::infinity())
        out.positive("plastic_creep", material.plastic_creep, "1/s");
    out.positive("plastic_limit", material.plastic_limit, "(a strain)");
    if (!(material.tear_strain > 0))
        return;
    const std::string beside = " beside tear_strain " + shown(material.tear_strain);
    if (material.pressure != 0)
        out.error("pressure", "is " + shown(material.pressure) + " Pa" + beside +
                                  "; torn cloth encloses nothing, so set one of them to 0");
    if (material.plastic_yield > 0)
        out.error("plastic_yield", "is " + shown(material.plastic_yield) + beside +
                                       "; a tear plans the scene anew and would forget what has flowed, so "
                                       "set one of them to 0");
}

} // namespace

void check_shape(const Shape& shape, const Checker& out)
{
    switch (shape.kind)
    {
    case ShapeKind::grid: return check_grid(shape, out.at("grid"));
    case ShapeKind::chain: return check_chain(shape, out.at("chain"));
    case ShapeKind::box: return check_box(shape, out.at("box"));
    case ShapeKind::ball: return check_ball(shape, out.at("ball"));
    case ShapeKind::tetrahedra:
        if (shape.file.empty())
            out.error("tetrahedra", "is empty; it must name a TetGen, Gmsh, VTK or Medit file");
        return;
    case ShapeKind::mesh: break;
    }
    if (shape.file.empty())
        out.error("mesh", "is empty; it must name an OBJ, PLY, OFF or STL file");
    out.finite("weld_distance", shape.weld_distance, "in the units of the file");
}

void check_material(const Material& material, bool solid, const Checker& out)
{
    out.positive("density", material.density, solid ? "kg/m^3" : "kg/m^2");
    if (solid)
        check_solid(material, out);
    const bool own = solid && material.volume_stiffness == -1; // the bulk modulus
    if (!own && material.volume_stiffness != std::numeric_limits<double>::infinity())
        out.not_negative("volume_stiffness", material.volume_stiffness, "Pa");
    if (!solid && material.volume_stiffness > 0 && material.tear_strain > 0)
        out.error("volume_stiffness", "is " + shown(material.volume_stiffness) + " Pa beside tear_strain " +
                                          shown(material.tear_strain) +
                                          "; torn cloth encloses nothing, so set one of them to 0");
    if (!solid && material.stretch_stiffness != std::numeric_limits<double>::infinity())
        out.not_negative("stretch_stiffness", material.stretch_stiffness, "N/m");
    out.not_negative("bending_stiffness", material.bending_stiffness, "N m");
    out.not_negative("thickness", material.thickness, "m");
    out.not_negative("stretch_damping", material.stretch_damping, "s");
    out.not_negative("strain_limit", material.strain_limit, "(of the rest length)");
    out.not_negative("tear_strain", material.tear_strain, "(of the rest length)");
    out.not_negative("drag", material.drag, "(a coefficient)");
    out.not_negative("friction_drag", material.friction_drag, "(a coefficient)");
    check_gas_and_flow(material, out);
    if (!(material.attachment_slack < 0))
        out.not_negative("attachment_slack", material.attachment_slack, "(of the rest distance)");
}

} // namespace taut::scene_file
