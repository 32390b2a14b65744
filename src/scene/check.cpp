// Every value and range of a scene, without reading any file.

#include "taut/scene/checker.hpp"
#include "taut/scene/scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace taut {

namespace {

using scene_file::check_material;
using scene_file::check_method;
using scene_file::check_shape;
using scene_file::check_wind;
using scene_file::Checker;
using scene_file::kMaxValue;
using scene_file::kMaxVertices;
using scene_file::shown;

constexpr double kMaxTimestep = 1;
constexpr double kMinSubstep = 1e-15;
constexpr double kMaxSteps = 1e9;
constexpr double kShortTimestep = 1e-6; ///< s: a shorter one is the mistake, where there are too many steps

void check_axis(const glm::dvec3& axis, double degrees, const Checker& out)
{
    out.finite("degrees", degrees, "degrees");
    if (out.finite("axis", axis, "any length but 0") && degrees != 0 && !(glm::length(axis) > 0))
        out.error("axis", "is " + shown(axis) + "; it must have a direction, for example [0, 1, 0]");
}

void check_motion(const std::vector<Keyframe>& motion, const Checker& out)
{
    for (std::size_t i = 0; i < motion.size(); ++i)
    {
        const Checker key = out.at("motion", i);
        const bool finite = key.finite("time", motion[i].time, "s");
        key.finite("translate", motion[i].translate, "m");
        check_axis(motion[i].rotate_axis, motion[i].rotate_degrees, key.at("rotate"));
        key.finite("rotate.centre", motion[i].rotate_centre, "m");
        if (i > 0 && finite && !(motion[i].time > motion[i - 1].time))
            key.error("time", "is " + shown(motion[i].time) + " s, and the key before it stands at " +
                                  shown(motion[i - 1].time) + " s; times must ascend");
    }
}

void check_times(const Scene& scene, const Checker& out)
{
    const bool good = scene.timestep > 0 && scene.timestep <= kMaxTimestep;
    if (!good)
        out.error("timestep",
                  "is " + shown(scene.timestep) + " s; it must be greater than 0 s and at most 1 s",
                  ErrorCode::bad_timestep);
    else if (const std::uint32_t n = std::max(scene.method.substeps, 1u); scene.timestep / n < kMinSubstep)
        out.error("timestep",
                  "is " + shown(scene.timestep) + " s" +
                      (n > 1 ? " in " + std::to_string(n) + " substeps; a substep"
                             : "; a substep, and so a time step,") +
                      " must be at least 1e-15 s",
                  ErrorCode::bad_timestep);
    out.not_negative("duration", scene.duration, "s");
    if (good && scene.duration <= kMaxValue && scene.duration / scene.timestep > kMaxSteps)
        out.error(scene.timestep < kShortTimestep ? "timestep" : "duration",
                  "makes " + shown(scene.duration / scene.timestep, 6) + " time steps: a duration of " +
                      shown(scene.duration) + " s in steps of " + shown(scene.timestep) +
                      " s; at most 1e9 are run");
}

void check_pin_box(const Pin& pin, const Checker& out)
{
    const bool finite = out.finite("box.min", pin.box_min, "m") && out.finite("box.max", pin.box_max, "m");
    if (finite &&
        (pin.box_min.x > pin.box_max.x || pin.box_min.y > pin.box_max.y || pin.box_min.z > pin.box_max.z))
        out.error("box", "goes from " + shown(pin.box_min) + " to " + shown(pin.box_max) +
                             "; each number of min must be at most that of max");
}

void check_pin_names(const Pin& pin, ShapeKind kind, const Checker& out)
{
    constexpr std::array<std::string_view, 4> grid_corners = {"top_left", "top_right", "bottom_left",
                                                              "bottom_right"};
    constexpr std::array<std::string_view, 2> chain_ends = {"first", "last"};
    constexpr std::array<std::string_view, 4> grid_edges = {"top", "bottom", "left", "right"};
    constexpr std::array<std::string_view, 6> box_faces = {"left", "right", "bottom", "top", "back", "front"};
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
        out.at("faces", i).word("", pin.faces[i], box_faces);
    if (kind != ShapeKind::grid && !pin.edges.empty())
        out.error("edges", "names an edge, which only a grid has" + instead);
    for (std::size_t i = 0; kind == ShapeKind::grid && i < pin.edges.size(); ++i)
        out.at("edges", i).word("", pin.edges[i], grid_edges);
    for (std::size_t i = 0; named && i < pin.corners.size(); ++i)
        if (kind == ShapeKind::grid)
            out.at("corners", i).word("", pin.corners[i], grid_corners);
        else
            out.at("corners", i).word("", pin.corners[i], chain_ends);
}

void check_pin(const Pin& pin, ShapeKind kind, const Checker& out)
{
    if (pin.vertices.empty() && !pin.use_box && pin.corners.empty() && pin.edges.empty() && pin.faces.empty())
        out.error("", "holds nothing; it must name vertices, a box, corners, edges or faces");
    if (pin.use_box)
        check_pin_box(pin, out);
    check_pin_names(pin, kind, out);
    check_motion(pin.motion, out);
}

void check_springs(const Body& body, const Checker& out)
{
    for (std::size_t i = 0; i < body.springs.size(); ++i)
    {
        const Body::Spring& spring = body.springs[i];
        const Checker at = out.at("springs", i);
        if (spring.a == spring.b)
            at.error("", "joins vertex " + std::to_string(spring.a) + " to itself; a and b must differ");
        at.not_negative("rest_length", spring.rest_length, "m");
        at.not_negative("compliance", spring.compliance, "m/N");
    }
}

/// What does not depend on where the mesh comes from.
void check_body_values(const Body& body, const Checker& out)
{
    check_material(body.material, is_solid(body.shape.kind), out.at("material"));
    const bool own_springs = !body.springs.empty() || body.shape.network.used;
    if (body.material.tear_strain > 0 && (own_springs || body.shape.kind == ShapeKind::chain))
        out.error("material.tear_strain",
                  "is " + shown(body.material.tear_strain) +
                      ", but only cloth whose springs are its edges can tear; leave out the network and the "
                      "springs, or take a grid or a mesh");
    out.finite("velocity", body.velocity, "m/s");
    check_springs(body, out);
    for (std::size_t i = 0; i < body.vertex_masses.size(); ++i)
        out.at("vertex_masses", i).positive("", body.vertex_masses[i], "kg");
    for (std::size_t i = 0; i < body.start_positions.size(); ++i)
        out.at("start_positions", i).finite("", body.start_positions[i], "m");
}

void check_body(const Body& body, const Checker& out)
{
    check_shape(body.shape, out);
    check_body_values(body, out);
    if (!body.embedded_file.empty() && !is_solid(body.shape.kind))
        out.error("embedded", "names " + body.embedded_file.string() +
                                  ", but only solids carry a surface along; leave it out, or take a box, a "
                                  "ball or tetrahedra");
    const Checker transform = out.at("transform");
    transform.finite("translate", body.transform.translate, "m");
    check_axis(body.transform.rotate_axis, body.transform.rotate_degrees, transform.at("rotate"));
    transform.positive("scale", body.transform.scale, "(no unit)");
    for (std::size_t i = 0; i < body.pins.size(); ++i)
        check_pin(body.pins[i], body.shape.kind, out.at("pins", i));
    if (body.shape.kind == ShapeKind::grid)
        scene_file::check_counts(
            body, (std::size_t(body.shape.cells.x) + 1) * (std::size_t(body.shape.cells.y) + 1), out);
    else if (body.shape.kind == ShapeKind::chain)
        scene_file::check_counts(body, std::size_t(body.shape.links) + 1, out);
    else if (body.shape.kind == ShapeKind::box)
    {
        const auto c = body.shape.box_cells;
        scene_file::check_counts(body, (std::size_t(c.x) + 1) * (c.y + 1) * (c.z + 1), out);
    }
}

void check_collider(const Collider& collider, const Checker& out)
{
    if (collider.kind == ColliderKind::plane)
    {
        out.finite("plane.point", collider.point, "m");
        if (out.finite("plane.normal", collider.normal, "any length but 0") &&
            !(glm::length(collider.normal) > 0))
            out.error("plane.normal",
                      "is " + shown(collider.normal) + "; it must have a direction, for example [0, 1, 0]");
        for (std::size_t i = 0; i < collider.motion.size(); ++i)
            if (collider.motion[i].rotate_degrees != 0)
                out.at("motion", i).error("rotate", "turns a plane; planes only translate so far");
    }
    else if (collider.kind == ColliderKind::sphere)
    {
        out.finite("sphere.centre", collider.point, "m");
        out.positive("sphere.radius", collider.radius, "m");
    }
    else if (collider.kind == ColliderKind::capsule)
    {
        out.finite("capsule.from", collider.point, "m");
        out.finite("capsule.to", collider.end, "m");
        out.positive("capsule.radius", collider.radius, "m");
    }
    else
    {
        out.finite("cuboid.centre", collider.point, "m");
        for (int axis = 0; axis < 3; ++axis)
            out.positive("cuboid.half_size", collider.half_size[axis], "m");
        check_axis(collider.rotate_axis, collider.rotate_degrees, out.at("cuboid.rotate"));
    }
    out.not_negative("friction", collider.friction, "(Coulomb coefficient)");
    check_motion(collider.motion, out);
}

/// Names stand in reports; two of one name could not be told apart there.
template <class Named>
void check_names(const std::vector<Named>& things, std::string_view list, const Checker& out)
{
    std::map<std::string, std::size_t> first;
    for (std::size_t i = 0; i < things.size(); ++i)
    {
        const auto [other, is_new] = first.emplace(things[i].name, i);
        if (!is_new && !things[i].name.empty())
            out.at(list, i).warning("name", "is \"" + things[i].name.substr(0, 60) + "\" like that of " +
                                                std::string(list) + '[' + std::to_string(other->second) +
                                                "]; reports cannot tell them apart");
    }
}

} // namespace

namespace scene_file {

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

} // namespace scene_file

namespace {

void warn_of_idle_wind(const Scene& scene, const Checker& out)
{
    const bool blows =
        scene.wind.density > 0 && (scene.wind.velocity != glm::dvec3(0) || !scene.wind.keys.empty());
    const bool moves = std::any_of(scene.bodies.begin(), scene.bodies.end(), [](const Body& b) {
        return b.material.drag > 0 || b.material.friction_drag > 0;
    });
    if (blows && !moves)
        out.warning("wind", "moves nothing: no material has \"drag\" or \"friction_drag\"");
}

void check_world(const Scene& scene, const Checker& out)
{
    check_times(scene, out);
    out.finite("gravity", scene.gravity, "m/s^2");
    out.not_negative("damping", scene.damping, "1/s");
    out.not_negative("max_speed", scene.max_speed, "m/s");
    out.not_negative("depenetration_speed", scene.depenetration_speed, "m/s");
    check_method(scene.method, out.at("method"));
    out.positive("accept.stretch", scene.accept.stretch, "(a strain)");
    out.positive("accept.residual", scene.accept.residual, "(a share of the forces)");
    check_wind(scene.wind, out.at("wind"));
    warn_of_idle_wind(scene, out);
    for (std::size_t i = 0; i < scene.colliders.size(); ++i)
        check_collider(scene.colliders[i], out.at("colliders", i));
}

} // namespace

namespace {

/// The member of the body that its tetrahedra come from.
const char* source_of_tetrahedra(ShapeKind kind)
{
    switch (kind)
    {
    case ShapeKind::box: return "box";
    case ShapeKind::ball: return "ball";
    case ShapeKind::tetrahedra: return "tetrahedra";
    default: return "mesh.tetrahedra";
    }
}

void check_volumes(const Mesh& mesh, ShapeKind kind, const Checker& out)
{
    std::size_t flat = 0, first = 0;
    for (std::size_t k = mesh.tetrahedra.size(); k-- > 0;)
        if (!(six_volumes(mesh.positions, mesh.tetrahedra[k]) > 0))
            ++flat, first = k;
    if (flat > 0)
        out.error(source_of_tetrahedra(kind),
                  "has " + std::to_string(flat) + " of " + std::to_string(mesh.tetrahedra.size()) +
                      " tetrahedra without volume, or left-handed; the first is number " +
                      std::to_string(first) + " (from 0). A mesh must not be flat, nor scaled to nothing",
                  ErrorCode::degenerate_rest);
}

/// Meshes that resolve() made are sound; one filled by hand may point anywhere.
void check_mesh(const Mesh& mesh, ShapeKind kind, const Checker& out)
{
    const std::size_t count = mesh.positions.size();
    bool sound = true; // every element names vertices that are there
    for (std::size_t v = 0; v < count; ++v)
        out.at("mesh.positions", v).finite("", mesh.positions[v], "m");
    const auto corners = [&](std::string_view list, std::size_t index, const auto& vertices) {
        for (const std::uint32_t vertex : vertices)
            if (vertex >= count)
            {
                sound = false;
                out.at(list, index)
                    .error("", "names vertex " + std::to_string(vertex) + "; the mesh has " +
                                   std::to_string(count) + ", numbered from 0");
            }
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        corners("mesh.triangles", t, mesh.triangles[t]);
    for (std::size_t k = 0; k < mesh.links.size(); ++k)
        corners("mesh.links", k, mesh.links[k]);
    for (std::size_t k = 0; k < mesh.tetrahedra.size(); ++k)
        corners("mesh.tetrahedra", k, mesh.tetrahedra[k]);
    if (sound)
        check_volumes(mesh, kind, out);
    if (mesh.grid_columns != 0 && std::size_t(mesh.grid_columns) * mesh.grid_rows != count)
        out.error("mesh", "says " + std::to_string(mesh.grid_columns) + " x " +
                              std::to_string(mesh.grid_rows) + " vertices and has " + std::to_string(count));
}

} // namespace

std::vector<SceneIssue> check_resolved(const Scene& scene)
{
    std::vector<SceneIssue> issues;
    const Checker out(issues, {});
    check_world(scene, out);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    {
        const Checker at = out.at("bodies", i);
        check_body_values(scene.bodies[i], at);
        scene_file::check_counts(scene.bodies[i], scene.bodies[i].mesh.positions.size(), at);
        check_mesh(scene.bodies[i].mesh, scene.bodies[i].shape.kind, at);
    }
    return issues;
}

std::vector<SceneIssue> check(const Scene& scene)
{
    std::vector<SceneIssue> issues;
    const Checker out(issues, {});
    if (scene.version != 1)
        out.error("taut", "is " + std::to_string(scene.version) + "; this library reads version 1");
    check_world(scene, out);
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        check_body(scene.bodies[i], out.at("bodies", i));
    check_names(scene.bodies, "bodies", out);
    check_names(scene.colliders, "colliders", out);
    return issues;
}

} // namespace taut
