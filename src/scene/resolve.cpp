// A scene made ready for planning: meshes in world space, pins as lists of vertices.

#include "taut/scene/check_room.hpp"
#include "taut/scene/check_size.hpp"
#include "taut/scene/checker.hpp"
#include "taut/scene/distance_field.hpp"
#include "taut/scene/embedding.hpp"
#include "taut/scene/kinematic.hpp"
#include "taut/scene/membrane.hpp"
#include "taut/scene/pose.hpp"
#include "taut/scene/settings.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

namespace taut {

namespace {

using scene_file::Checker;
using scene_file::shown;

[[noreturn]] void fail(const std::vector<SceneIssue>& issues)
{
    const auto is_error = [](const SceneIssue& issue) { return issue.error; };
    const auto first = std::find_if(issues.begin(), issues.end(), is_error);
    const auto others = std::count_if(issues.begin(), issues.end(), is_error) - 1;
    std::string text = first->field.empty() ? first->text : first->field + ' ' + first->text;
    if (others > 0)
        text += " (and " + std::to_string(others) + (others == 1 ? " other error)" : " other errors)");
    throw Error(first->code, text);
}

/// `found`: null, or where the issues are handed out before it throws.
void throw_if_any(const std::vector<SceneIssue>& issues, std::vector<SceneIssue>* found)
{
    if (!any_error(issues))
        return;
    if (found)
        found->insert(found->end(), issues.begin(), issues.end());
    fail(issues);
}

/// `field`: the member of the body that names the file.
void warn_of(const MeshFindings& findings, bool solid, const Checker& out, const char* field = "mesh")
{
    const auto count = [](std::size_t n, const char* what) { return std::to_string(n) + ' ' + what; };
    const auto dropped = [&](const std::vector<std::uint32_t>& which, const char* what) {
        if (!which.empty())
            out.warning(field, "had " + count(which.size(), what) + ", dropped; the first is number " +
                                   std::to_string(which.front()) + " of the file");
    };
    dropped(findings.degenerate_triangles, "triangles without area");
    dropped(findings.repeated_triangles, "triangles of the same corners as an earlier one");
    if (findings.unused_vertices > 0)
        out.warning(field, "had " + count(findings.unused_vertices, "vertices of no ") +
                               (solid ? "tetrahedron" : "triangle") + ", dropped");
    if (findings.turned_tetrahedra > 0)
        out.warning(field, "had " + count(findings.turned_tetrahedra, "left-handed tetrahedra, turned"));
    for (const std::string& text : skipped_texts(findings.skipped))
        out.warning(field, text);
    if (!findings.non_manifold_edges.empty())
        out.warning(field, "has " +
                               count(findings.non_manifold_edges.size(), "edges of more than two triangles") +
                               "; the first joins vertices " +
                               std::to_string(findings.non_manifold_edges.front()[0]) + " and " +
                               std::to_string(findings.non_manifold_edges.front()[1]));
}

/// The rest mesh in its own space.
Mesh make_mesh(const Shape& shape, const std::filesystem::path& directory, const Checker& out)
{
    switch (shape.kind)
    {
    case ShapeKind::grid:
        return make_grid(shape.cells.x, shape.cells.y, shape.size.x, shape.size.y,
                         shape.diagonals == Diagonals::alternating);
    case ShapeKind::chain: return make_chain(shape.links, shape.length, shape.width);
    case ShapeKind::box:
        return make_box({shape.box_cells.x, shape.box_cells.y, shape.box_cells.z}, shape.box_size,
                        shape.split == BoxSplit::five);
    case ShapeKind::ball: return make_ball(shape.ball_cells, shape.radius);
    case ShapeKind::mesh:
    case ShapeKind::tetrahedra: break;
    }
    MeshFindings findings;
    const std::filesystem::path file = directory / shape.file;
    Mesh mesh = shape.kind == ShapeKind::mesh ? read_mesh(file, shape.weld_distance, &findings)
                                              : read_tetrahedra(file, &findings);
    warn_of(findings, is_solid(shape.kind), out);
    return mesh;
}

void apply(const Transform& transform, Mesh& mesh)
{
    apply(transform, mesh.positions);
    mesh.link_width *= transform.scale;
}

void add_corner(const std::string& name, const Mesh& mesh, std::vector<std::uint32_t>& out)
{
    const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
    if (name == "top_left" || name == "first")
        out.push_back(0);
    else if (name == "top_right")
        out.push_back(mesh.grid_columns - 1);
    else if (name == "bottom_left")
        out.push_back(last - (mesh.grid_columns - 1));
    else
        out.push_back(last); // "bottom_right", "last": check() lets nothing else through
}

void add_edge(const std::string& name, const Mesh& mesh, std::vector<std::uint32_t>& out)
{
    const std::uint32_t columns = mesh.grid_columns, rows = mesh.grid_rows;
    if (name == "top" || name == "bottom")
        for (std::uint32_t column = 0; column < columns; ++column)
            out.push_back((name == "top" ? 0 : rows - 1) * columns + column);
    else
        for (std::uint32_t row = 0; row < rows; ++row)
            out.push_back(row * columns + (name == "left" ? 0 : columns - 1));
}

void add_face(const std::string& name, const glm::uvec3& cells, std::vector<std::uint32_t>& out)
{
    const int axis = name == "left" || name == "right" ? 0 : name == "bottom" || name == "top" ? 1 : 2;
    const bool high = name == "right" || name == "top" || name == "front";
    glm::uvec3 at;
    for (at.z = 0; at.z <= cells.z; ++at.z)
        for (at.y = 0; at.y <= cells.y; ++at.y)
            for (at.x = 0; at.x <= cells.x; ++at.x)
                if (at[axis] == (high ? cells[axis] : 0))
                    out.push_back((at.z * (cells.y + 1) + at.y) * (cells.x + 1) + at.x);
}

bool inside(const glm::dvec3& p, const Pin& pin)
{
    return p.x >= pin.box_min.x && p.x <= pin.box_max.x && p.y >= pin.box_min.y && p.y <= pin.box_max.y &&
           p.z >= pin.box_min.z && p.z <= pin.box_max.z;
}

/// Adds the vertices of the box; their number.
std::size_t add_box(const Pin& pin, const std::vector<glm::dvec3>& start, std::vector<std::uint32_t>& out)
{
    const std::size_t before = out.size();
    for (std::uint32_t v = 0; v < start.size(); ++v)
        if (inside(start[v], pin))
            out.push_back(v);
    return out.size() - before;
}

/// Replaces what a pin names by vertices. Each vertex belongs to the first pin that holds it.
void resolve_pin(const Body& body, Pin& pin, std::vector<bool>& held, const Checker& out)
{
    std::vector<std::uint32_t> vertices = pin.vertices;
    for (const std::string& corner : pin.corners)
        add_corner(corner, body.mesh, vertices);
    for (const std::string& edge : pin.edges)
        add_edge(edge, body.mesh, vertices);
    for (const std::string& face : pin.faces)
        add_face(face, body.shape.box_cells, vertices);
    const auto& start = start_of(body);
    if (pin.use_box && add_box(pin, start, vertices) == 0)
        out.warning("box", "from " + scene_file::shown(pin.box_min) + " to " +
                               scene_file::shown(pin.box_max) +
                               " holds no vertex at the start; boxes are in world space, m");
    std::sort(vertices.begin(), vertices.end());
    pin = Pin{.vertices = {},
              .corners = {},
              .edges = {},
              .faces = {},
              .motion = std::move(pin.motion),
              .moved_by_program = pin.moved_by_program,
              .places = {}};
    for (const std::uint32_t vertex : vertices)
        if (!held[vertex])
        {
            held[vertex] = true;
            pin.vertices.push_back(vertex);
        }
}

/// The springs of a network, kind by kind and row by row, before those of the scene's own list.
void add_network(Body& body)
{
    struct Reach
    {
        SpringKind kind;
        double stiffness;
        int columns, rows;
    };
    const SpringNetwork& network = body.shape.network;
    const Mesh& mesh = body.mesh;
    const Reach reaches[] = {{SpringKind::structural, network.structural, 1, 0},
                             {SpringKind::structural, network.structural, 0, 1},
                             {SpringKind::shear, network.shear, 1, 1},
                             {SpringKind::shear, network.shear, -1, 1},
                             {SpringKind::bend, network.bend, 2, 0},
                             {SpringKind::bend, network.bend, 0, 2}};
    std::vector<Body::Spring> springs;
    const int columns = static_cast<int>(mesh.grid_columns), rows = static_cast<int>(mesh.grid_rows);
    for (const Reach& reach : reaches)
        for (int row = 0; row + reach.rows < rows && reach.stiffness > 0; ++row)
            for (int column = 0; column < columns; ++column)
            {
                const int other = column + reach.columns;
                if (other < 0 || other >= columns)
                    continue;
                const auto a = static_cast<std::uint32_t>(row * columns + column);
                const auto b = static_cast<std::uint32_t>((row + reach.rows) * columns + other);
                const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
                springs.push_back({a, b, length, 1 / reach.stiffness, reach.kind});
            }
    body.springs.insert(body.springs.begin(), springs.begin(), springs.end());
}

/// Names the first vertex that is not.
bool all_finite(const Mesh& mesh, const Checker& out)
{
    const auto out_of_range = [](const glm::dvec3& p) {
        return !(std::abs(p.x) <= scene_file::kMaxValue && std::abs(p.y) <= scene_file::kMaxValue &&
                 std::abs(p.z) <= scene_file::kMaxValue);
    };
    const auto& all = mesh.positions;
    const auto found = std::find_if(all.begin(), all.end(), out_of_range);
    return found == all.end() ||
           out.finite("", *found, "m, vertex " + std::to_string(found - all.begin()) + " in world space");
}

/// A file that cannot be used is an issue of the field that names it.
void attempt(const char* field, const Checker& out, const std::function<void()>& read)
{
    try
    {
        read();
    }
    catch (const Error& error)
    {
        if (error.code() == ErrorCode::out_of_memory)
            throw;
        out.error(field, std::string("is of no use: ") + error.what(), error.code());
    }
}

/// The surface that a solid carries along, in the frame of its shape.
void embed_surface(Body& body, const std::filesystem::path& directory, const Checker& out)
{
    Mesh surface;
    attempt("embedded", out, [&] {
        MeshFindings findings;
        surface = read_mesh(directory / body.embedded_file, 0, &findings);
        warn_of(findings, false, out, "embedded");
    });
    if (surface.positions.empty())
        return;
    apply(body.transform, surface);
    if (!all_finite(surface, out.at("embedded")))
        return;
    EmbeddingFindings findings;
    body.embedding = embed(std::move(surface), body.mesh, &findings);
    if (findings.far > 0)
        out.warning("embedded", "has " + std::to_string(findings.far) +
                                    " vertices further from the solid than an edge of its tetrahedra; the "
                                    "first is vertex " +
                                    std::to_string(findings.first_far) + ", " +
                                    scene_file::shown(findings.first_distance) +
                                    " m away; is it in the frame of the shape, in metres?");
}

void resolve_body(Body& body, const std::filesystem::path& directory, const Checker& out)
{
    attempt(body.shape.kind == ShapeKind::tetrahedra ? "tetrahedra" : "mesh", out,
            [&] { body.mesh = make_mesh(body.shape, directory, out); });
    if (body.mesh.positions.empty())
        return;
    apply(body.transform, body.mesh);
    if (all_finite(body.mesh, out.at("transform")) && !body.embedded_file.empty())
        embed_surface(body, directory, out);
    if (body.shape.kind == ShapeKind::grid && body.shape.network.used)
        add_network(body);
    if (body.material.fabric.used)
        scene_file::add_membrane(body, out.at("material.fabric"));
    if (body.shape.kind != ShapeKind::grid && body.shape.kind != ShapeKind::chain)
        scene_file::check_counts(body, body.mesh.positions.size(), out);
}

/// Files that several colliders name are read once.
using FieldFiles = std::map<std::pair<std::filesystem::path, double>, std::shared_ptr<const DistanceField>>;

std::shared_ptr<const DistanceField> read_field(const Collider& collider, const std::filesystem::path& file)
{
    DistanceField field = read_distance_field(file);
    field.low *= collider.field_scale;
    field.cell *= collider.field_scale;
    for (float& value : field.values)
        value = static_cast<float>(value * collider.field_scale);
    if (const std::string fault = fault_of(field); !fault.empty())
        throw Error(ErrorCode::bad_input, file.string() + " times distance_field.scale, " +
                                              shown(collider.field_scale, 4) + ": the grid " + fault + ".");
    return std::make_shared<const DistanceField>(std::move(field));
}

void resolve_field(Collider& collider, const Scene& scene, FieldFiles& files, const Checker& out)
{
    if (collider.kind != ColliderKind::distance_field)
        return;
    if (!collider.field)
        attempt("distance_field.file", out, [&] {
            auto& known = files[{collider.field_file, collider.field_scale}];
            if (!known)
                known = read_field(collider, scene.directory / collider.field_file);
            collider.field = known;
        });
    double gap = 0;
    for (const Body& body : scene.bodies)
        if (!body.kinematic.used) // led vertices are not pushed
            gap = std::max(gap, body.material.thickness);
    if (collider.field && collider.field->margin() < gap)
        out.error("distance_field", "has a grid that ends " + shown(collider.field->margin(), 4) +
                                        " m from its surface, and a body's material.thickness is " +
                                        shown(gap, 4) + "; make it with a --margin above that (taut sdf)");
}

/// Their values are numbered by 32 bits.
void check_field_sizes(const Scene& resolved, const Checker& out)
{
    std::set<const DistanceField*> seen;
    std::size_t values = 0;
    for (const Collider& collider : resolved.colliders)
        if (collider.field && seen.insert(collider.field.get()).second)
            values += collider.field->values.size();
    if (values > kMostFieldPoints)
        out.error("colliders", "have distance fields of " + std::to_string(values) + " points; at most " +
                                   std::to_string(kMostFieldPoints) + " are told apart: take larger cells");
}

} // namespace

bool resists_bending(const Material& material)
{
    return material.bending_stiffness > 0 || (material.fabric.used && material.fabric.bending.used);
}

Material solid_material()
{
    Material material;
    material.density = 1000;
    material.stretch_stiffness = 0;
    material.youngs_modulus = 1e5;
    material.volume_stiffness = -1;
    return material;
}

Scene resolve(const Scene& scene, std::vector<SceneIssue>* found)
{
    std::vector<SceneIssue> issues = check(scene);
    throw_if_any(issues, found);
    scene_file::check_room(scene, scene_file::host_memory());
    Scene resolved = scene;
    const Checker out(issues);
    FieldFiles files;
    for (std::size_t c = 0; c < resolved.colliders.size(); ++c)
        resolve_field(resolved.colliders[c], scene, files, out.at("colliders", c));
    check_field_sizes(resolved, out);
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        Body& body = resolved.bodies[b];
        const Checker at = out.at("bodies", b);
        const std::size_t before = issues.size();
        resolve_body(body, scene.directory, at);
        if (std::any_of(issues.begin() + static_cast<std::ptrdiff_t>(before), issues.end(),
                        [](const SceneIssue& issue) { return issue.error; }))
            continue; // pins may name what is not there
        scene_file::check_size(body, scene.method.precision == Precision::float64, at);
        if (body.kinematic.used)
        {
            attempt("kinematic.sequence.file", at,
                    [&] { scene_file::resolve_kinematic(body, scene.directory); });
            continue;
        }
        std::vector<bool> held(body.mesh.positions.size(), false);
        for (std::size_t p = 0; p < body.pins.size(); ++p)
            resolve_pin(body, body.pins[p], held, at.at("pins", p));
        std::erase_if(body.pins, [](const Pin& pin) { return pin.vertices.empty(); });
    }
    throw_if_any(issues, found);
    count_steps(resolved);
    if (resolved.contact.sweeps == 0)
        resolved.contact.sweeps = automatic_sweeps(resolved);
    if (found)
        found->insert(found->end(), issues.begin(), issues.end());
    return resolved;
}

} // namespace taut
