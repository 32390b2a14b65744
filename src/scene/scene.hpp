#pragma once
// The description of a simulation: plain values with defaults and SI units. Touches no device.
// docs/scene.md lists every key of the file format; the names are the same here.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/mesh.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// Cloth material. All stiffnesses are continuum values, so they do not depend on the mesh.
struct ClothMaterial
{
    double density = 0.2;           ///< kg/m^2, > 0
    double stretch_stiffness = 1e4; ///< N/m, membrane modulus E*thickness; 0 = no stretch effect; inf = rigid
    double bending_stiffness = 0;   ///< N m, plate rigidity; 0 = no bending effect
    double thickness = 0.001;       ///< m, gap kept from colliders, >= 0
};

/// One key of a motion: the pose relative to the rest pose at a time; linear in between, constant
/// before the first and after the last.
struct Keyframe
{
    double time = 0;                 ///< s
    glm::dvec3 translate{0};         ///< m
    glm::dvec3 rotate_axis{0, 1, 0}; ///< unit after normalisation
    double rotate_degrees = 0;       ///< about rotate_axis through rotate_centre
    glm::dvec3 rotate_centre{0};     ///< m, world
};

/// Where `rest` [m, world] is at `time` [s]: turned about the centre, then translated. Translation,
/// centre and axis times angle are linear between keys (with one axis: the angle is), constant
/// outside. Keys must ascend in time (check() says so); no keys: `rest`.
glm::dvec3 pose(const std::vector<Keyframe>& motion, double time, const glm::dvec3& rest);

/// Which vertices of a body are held, and how they move. Empty motion: held in place.
struct Pin
{
    std::vector<std::uint32_t> vertices; ///< indices of the mesh as loaded (after welding)
    bool use_box = false;
    glm::dvec3 box_min{0}, box_max{0}; ///< world, after the body's transform, m
    std::vector<std::string>
        corners; ///< grid: "top_left", "top_right", "bottom_left", "bottom_right"; chain: "first", "last"
    std::vector<std::string> edges; ///< grid: "top", "bottom", "left", "right"
    std::vector<Keyframe> motion;
};

struct Transform
{
    glm::dvec3 translate{0}; ///< m
    glm::dvec3 rotate_axis{0, 1, 0};
    double rotate_degrees = 0;
    double scale = 1; ///< > 0; applied first, then rotation, then translation
};

enum class ShapeKind
{
    grid,
    chain,
    mesh
};

/// Where a body's rest shape comes from.
struct Shape
{
    ShapeKind kind = ShapeKind::grid;
    /// grid: cells along x and along -y in the plane z = 0, centred at the origin; the row y = +h/2 is "top".
    glm::uvec2 cells{32, 32}; ///< >= 1 each
    glm::dvec2 size{1, 1};    ///< m
    /// grid: how quads are cut: "alternating" (union-jack) or "uniform" (one direction)
    std::string diagonals = "alternating";
    /// chain: links along -y from the origin, `length` metres in all, each carrying a strip of `width`.
    std::uint32_t links = 10;   ///< >= 0 (0 = one free particle)
    double length = 1;          ///< m
    double width = 0.01;        ///< m, > 0
    std::filesystem::path file; ///< mesh: OBJ, PLY, OFF or STL
    double weld_distance = 0;   ///< mesh: vertices this close become one, m in file units; < 0 = keep all
};

struct Body
{
    std::string name;
    Shape shape;
    ClothMaterial material;
    Transform transform;
    std::vector<Pin> pins;
    glm::dvec3 velocity{0}; ///< m/s at start
    /// Per-vertex overrides, for tests and tools; empty = from shape and material.
    std::vector<double> vertex_masses;       ///< kg, > 0
    std::vector<glm::dvec3> start_positions; ///< world, m; rest lengths still come from the shape
    /// Further distance constraints {a, b, rest length m, compliance m/N} beside the mesh edges.
    struct Spring
    {
        std::uint32_t a, b;
        double rest_length;
        double compliance;
    };
    std::vector<Spring> springs;
    /// Filled by resolve(): the rest mesh in world space.
    Mesh mesh;
};

enum class ColliderKind
{
    plane,
    sphere
};

struct Collider
{
    std::string name;
    ColliderKind kind = ColliderKind::sphere;
    glm::dvec3 point{0};        ///< plane: a point on it; sphere: centre, m
    glm::dvec3 normal{0, 1, 0}; ///< plane: towards the free side
    double radius = 0.5;        ///< sphere, m, > 0
    double friction = 0;        ///< Coulomb coefficient, >= 0; 0 = no friction effect
    std::vector<Keyframe> motion;
};

struct MethodSettings
{
    std::string type = "xpbd";
    std::uint32_t substeps = 10;     ///< per time step, 1..1000
    std::uint32_t iterations = 1;    ///< per substep, 1..1000
    std::string precision = "float"; ///< or "double"
};

struct Scene
{
    int version = 1; ///< the key "taut"
    std::string name;
    double timestep = 1.0 / 60;       ///< s, (0, 1]
    double duration = 4;              ///< s, >= 0
    glm::dvec3 gravity{0, -9.81, 0};  ///< m/s^2
    double damping = 0;               ///< 1/s, velocities decay as exp(-damping t); 0 = no damping effect
    double max_speed = 0;             ///< m/s; 0 = none but the guard against overflow
    double depenetration_speed = 0.5; ///< m/s, fastest way out of an initial penetration
    bool external_forces = false;     ///< allow World::set_force; costs a buffer and a pass
    MethodSettings method;
    std::vector<Body> bodies;
    std::vector<Collider> colliders;
    std::filesystem::path directory; ///< mesh paths are relative to it
};

/// Reads a scene file. Throws Error{bad_input} naming file, field path ("bodies[0].material.density"),
/// what is there, what would be right, and for an unknown key the nearest known one; Error{io}.
Scene load_scene(const std::filesystem::path& file);

/// The same from text. `directory` resolves mesh paths; `name` stands in messages.
Scene parse_scene(std::string_view json, const std::filesystem::path& directory = {},
                  std::string_view name = "scene");

/// One thing that is wrong (error) or doubtful (warning) with a scene.
struct SceneIssue
{
    bool error = true;
    std::string field; ///< "bodies[0].pins[1].box"
    std::string text;
    ErrorCode code = ErrorCode::bad_input; ///< what resolve() throws for it: bad_timestep, io, ...
};

/// Checks every value and range. Does not read mesh files.
std::vector<SceneIssue> check(const Scene& scene);

/// The same for a scene whose bodies have meshes already: all values, and indices against the meshes.
std::vector<SceneIssue> check_resolved(const Scene& scene);

/// Checks, generates or loads every body's mesh, applies transforms, resolves pins; returns a scene
/// whose bodies have `mesh`, and whose pins have only `vertices` and `motion`. Warnings are appended.
/// Throws Error{bad_input} with the first issue in full and the number of others.
Scene resolve(const Scene& scene, std::vector<SceneIssue>* warnings = nullptr);

} // namespace taut
