// What takes more than one key of a body, its pins and springs, or a collider.

#include "taut/scene/checker.hpp"
#include "taut/scene/distance_field.hpp"
#include "taut/scene/faces.hpp"
#include "taut/scene/pin_words.hpp"

#include <glm/geometric.hpp>

namespace taut::scene_file {
namespace {

void check_pin_names(const Pin& pin, ShapeKind kind, const Checker& out)
{
    const bool named = kind == ShapeKind::grid || kind == ShapeKind::chain;
    const std::string instead = std::string("; use ") +
                                (kind == ShapeKind::box     ? "\"faces\", "
                                 : kind == ShapeKind::grid  ? "\"edges\", \"corners\", "
                                 : kind == ShapeKind::chain ? "\"corners\", "
                                                            : "") +
                                "\"vertices\" or \"box\"";
    if (!named && !pin.corners.empty())
        out.error("corners", "names a corner, which only grids and chains have" + instead);
    if (kind != ShapeKind::box && !pin.faces.empty())
        out.error("faces", "names a face, which only a box has" + instead);
    for (std::size_t i = 0; kind == ShapeKind::box && i < pin.faces.size(); ++i)
        out.at("faces", i).word("", pin.faces[i], kBoxFaces);
    if (kind != ShapeKind::grid && !pin.edges.empty())
        out.error("edges", "names an edge, which only a grid has" + instead);
    for (std::size_t i = 0; kind == ShapeKind::grid && i < pin.edges.size(); ++i)
        out.at("edges", i).word("", pin.edges[i], kGridEdges);
    for (std::size_t i = 0; named && i < pin.corners.size(); ++i)
        if (kind == ShapeKind::grid)
            out.at("corners", i).word("", pin.corners[i], kGridCorners);
        else
            out.at("corners", i).word("", pin.corners[i], kChainEnds);
}

/// Of shapes whose number of vertices their keys say.
void check_counts_of_shape(const Body& body, const Checker& out)
{
    const Shape& shape = body.shape;
    if (shape.kind == ShapeKind::grid)
        check_counts(body, (std::size_t(shape.cells.x) + 1) * (std::size_t(shape.cells.y) + 1), out);
    else if (shape.kind == ShapeKind::chain)
        check_counts(body, std::size_t(shape.links) + 1, out);
    else if (shape.kind == ShapeKind::box)
        check_counts(body,
                     (std::size_t(shape.box_cells.x) + 1) * (shape.box_cells.y + 1) * (shape.box_cells.z + 1),
                     out);
}

void check_file_name(const Shape& shape, const Checker& out)
{
    if (!shape.file.empty())
        return;
    if (shape.kind == ShapeKind::mesh)
        out.error("mesh", "is empty; it must name an OBJ, PLY, OFF or STL file");
    if (shape.kind == ShapeKind::tetrahedra)
        out.error("tetrahedra", "is empty; it must name a TetGen, Gmsh, VTK or Medit file");
}

/// What says where the mesh comes from, or asks it for vertices.
void check_source(const Body& body, const Checker& out)
{
    check_file_name(body.shape, out);
    if (!body.embedded_file.empty() && !is_solid(body.shape.kind))
        out.error("embedded", "names " + body.embedded_file.string() +
                                  ", but only solids carry a surface along; leave it out, or take a box, a "
                                  "ball or tetrahedra");
    for (std::size_t i = 0; i < body.pins.size(); ++i)
        check_pin_names(body.pins[i], body.shape.kind, out.at("pins", i));
    check_counts_of_shape(body, out);
    if (body.kinematic.used)
        check_kinematic_body(body, out);
}

} // namespace

void check_counts(const Body& body, std::size_t vertex_count, const Checker& out)
{
    const std::string has = "; the body has " + std::to_string(vertex_count) + " vertices";
    const auto index = [&](const Checker& at, std::string_view member, std::uint32_t vertex) {
        if (vertex >= vertex_count)
            at.error(member, "is " + std::to_string(vertex) + has + ", numbered from 0");
    };
    for (std::size_t p = 0; p < body.pins.size(); ++p)
        for (std::size_t i = 0; i < body.pins[p].vertices.size(); ++i)
            index(out.at("pins", p).at("vertices", i), "", body.pins[p].vertices[i]);
    for (std::size_t i = 0; i < body.springs.size(); ++i)
    {
        index(out.at("springs", i), "a", body.springs[i].a);
        index(out.at("springs", i), "b", body.springs[i].b);
    }
    if (!body.vertex_masses.empty() && body.vertex_masses.size() != vertex_count)
        out.error("vertex_masses", "has " + std::to_string(body.vertex_masses.size()) + " entries" + has);
    if (!body.start_positions.empty() && body.start_positions.size() != vertex_count)
        out.error("start_positions", "has " + std::to_string(body.start_positions.size()) + " entries" + has);
}

void check_body(const Body& body, const Checker& out)
{
    check_fabric_body(body, out);
    const bool own_springs = !body.springs.empty() || body.shape.network.used;
    if (body.material.tear_strain > 0 && (own_springs || body.shape.kind == ShapeKind::chain))
        out.error("material.tear_strain",
                  "is " + shown(body.material.tear_strain) +
                      ", but only cloth whose springs are its edges can tear; leave out the network and the "
                      "springs, or take a grid or a mesh");
    const bool network = body.shape.kind == ShapeKind::grid && body.shape.network.used;
    const double stiffness = body.material.stretch_stiffness;
    if (network && stiffness > 0 && stiffness != Material().stretch_stiffness)
        out.warning("material.stretch_stiffness",
                    "is " + shown(stiffness) +
                        " N/m, which does nothing: the springs of a network have their own");
    if (body.material.attachment_slack && body.pins.empty() && !body.kinematic.used)
        out.warning("material.attachment_slack",
                    "is " + shown(*body.material.attachment_slack) +
                        ", which does nothing: the body has no pins that its vertices could be attached to");
    if (out.scope() != Scope::meshes)
        return check_source(body, out);
    check_counts(body, body.mesh.positions.size(), out);
    check_mesh(body.mesh, body.shape.kind, out);
}

void check_pin(const Pin& pin, const Checker& out)
{
    if (pin.vertices.empty() && !pin.use_box && pin.corners.empty() && pin.edges.empty() && pin.faces.empty())
        out.error("", "holds nothing; it must name vertices, a box, corners, edges or faces");
    if (pin.moved_by_program && !pin.motion.empty())
        out.error("moved_by_program", "is true beside a motion; leave one of the two out");
}

void check_pin_box(const Pin& pin, const Checker& out)
{
    if (pin.box_min.x > pin.box_max.x || pin.box_min.y > pin.box_max.y || pin.box_min.z > pin.box_max.z)
        out.error("", "goes from " + shown(pin.box_min) + " to " + shown(pin.box_max) +
                          "; each number of min must be at most that of max");
}

void check_spring(const Body::Spring& spring, const Checker& out)
{
    if (spring.a == spring.b)
        out.error("", "joins vertex " + std::to_string(spring.a) + " to itself; a and b must differ");
}

void check_axis(const glm::dvec3& axis, double degrees, const Checker& out)
{
    if (degrees != 0 && glm::length(axis) == 0)
        out.error("axis", "is " + shown(axis) + "; it must have a direction, for example [0, 1, 0]");
}

void check_collider(const Collider& collider, const Checker& out)
{
    if (collider.kind == ColliderKind::distance_field)
    {
        const std::string fault = collider.field ? fault_of(*collider.field) : "";
        if (!fault.empty())
            out.error("distance_field", fault);
        if (!collider.field && collider.field_file.empty())
            out.error("distance_field.file", "is empty; it must name a grid that `taut sdf` wrote");
        if (collider.meets == ColliderMeets::surface)
            out.error("meets", "is \"surface\"; a distance field meets vertices alone so far, a kinematic "
                               "body of the mesh meets triangles, too");
    }
    for (std::size_t i = 0; collider.kind == ColliderKind::plane && i < collider.motion.size(); ++i)
        if (collider.motion[i].rotate_degrees != 0)
            out.at("motion", i).error("rotate", "turns a plane; planes only translate so far");
}

} // namespace taut::scene_file
