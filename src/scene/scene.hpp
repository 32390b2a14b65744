#pragma once
// The description of a simulation: plain values with defaults and SI units. Touches no device.
// docs/scene.md lists every key of the file format; the names are the same here.

#include "taut/runtime/base/error.hpp"
#include "taut/scene/contact.hpp"
#include "taut/scene/embed.hpp"
#include "taut/scene/fabric.hpp"
#include "taut/scene/mesh.hpp"
#include "taut/scene/options.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace taut {

/// Material of cloth and, from `youngs_modulus` on, of solids. All stiffnesses are continuum values, so they
/// do not depend on the mesh.
struct Material
{
    double density = 0.2;           ///< kg/m^2, of solids kg/m^3, > 0
    double stretch_stiffness = 1e4; ///< N/m, membrane modulus E*thickness; 0 = no stretch effect; inf = rigid
    Fabric fabric;                  ///< cloth by its yarns; stretch_stiffness must be 0 beside it
    double bending_stiffness = 0;   ///< N m, plate rigidity; 0 = no bending effect, or fabric.bending
    BendingModel bending_model = BendingModel::hinge; ///< of cloth that bends (docs/effects/plate.md)
    double bending_poissons_ratio = 0; ///< of a plate, (-1, 1): how far it curves across where it is bent
    double thickness = 0.001;       ///< m, gap kept from colliders, >= 0
    double stretch_damping = 0;     ///< s, >= 0: a spring of stiffness k has the damper k * stretch_damping
    double strain_limit = 0;        ///< (l - L)/L that no spring may pass, >= 0; 0 = no strain_limit effect
    /// Long-range attachments: no vertex further from its pin than (1 + slack) times at rest; slack >= 0.
    std::optional<double> attachment_slack;
    double tear_strain = 0;   ///< (l - L)/L at which cloth tears, >= 0; 0 = no tearing effect
    double drag = 0;          ///< of a triangle along its normal in the wind, >= 0; 0 = no wind effect
    double friction_drag = 0; ///< the same across its normal (skin friction), >= 0
    /// Pa: closed cloth holds the volume V that it encloses by an energy of K/2 (V - V0)^2 / V0; 0 = no
    /// surface_volume effect, inf = rigid. Of solids: springs hold volumes so (which, `volume` says); -1 =
    /// the bulk modulus E / (3 (1 - 2 nu)).
    double volume_stiffness = 0;
    /// Pa: by how much the gas within presses more than the air outside, at the rest volume; 0 = no effect.
    double pressure = 0;
    PressureLaw pressure_law = PressureLaw::constant;
    /// Strain beyond which springs and tetrahedra keep a part of it, >= 0; 0 = no plasticity effect.
    double plastic_yield = 0;
    double plastic_creep = 10; ///< 1/s, > 0: the rate at which strain beyond the yield stays; inf = at once
    double plastic_limit = 1;  ///< strain that may stay in all, > 0

    // Solids: tetrahedra. stretch_stiffness is not theirs.
    double youngs_modulus = 0;   ///< Pa, > 0 in solids
    double poissons_ratio = 0.3; ///< (-1, 0.5)
    SolidModel model = SolidModel::neo_hookean;
    HeldVolume volume = HeldVolume::tetrahedra; ///< of SolidModel::springs
};

/// Defaults of bodies with tetrahedra: soft rubber.
Material solid_material();

/// Whether the material resists being bent: by one rigidity, or by those of its fabric's directions.
bool resists_bending(const Material& material);

/// Springs of a grid of its own, in place of its edges: structural to the side neighbours, shear to the
/// diagonal ones, bend to the second ones along rows and columns (Provot 1995).
struct SpringNetwork
{
    bool used = false;
    double structural = 1000; ///< N/m, >= 0; 0 = none of the kind
    double shear = 1000;      ///< N/m
    double bend = 0;          ///< N/m
};

/// What a spring stands for. Methods may treat kinds differently (a material's edges are structural).
enum class SpringKind
{
    structural,
    shear,
    bend,
    extra ///< of the scene's own list
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

/// Where every vertex of a body is over time, as another program wrote it: in the order and the frame of the
/// body's shape, before its transform.
struct MeshSequence
{
    std::filesystem::path file; ///< a point cache (.pc2) or a folder of .obj files; empty: none
    double rate = 0;            ///< frames a second, > 0
    double start = 0;           ///< s, the time of the first frame
};

/// A sequence that has been read. Linear in between two frames, constant before the first and after the last.
struct SequencePlaces
{
    double rate = 0, start = 0;
    std::vector<std::vector<glm::dvec3>>
        frames; ///< of all vertices of the body's mesh, world, m; one at least
};
/// Where a vertex of the body's mesh is at `time` [s].
glm::dvec3 place_at(const SequencePlaces& sequence, double time, std::size_t vertex);

/// Which vertices of a body are held, and how they move. Empty motion: held in place.
struct Pin
{
    std::vector<std::uint32_t> vertices; ///< indices of the mesh as loaded (after welding)
    bool use_box = false;
    glm::dvec3 box_min{0}, box_max{0}; ///< world, after the body's transform, m
    std::vector<std::string>
        corners; ///< grid: "top_left", "top_right", "bottom_left", "bottom_right"; chain: "first", "last"
    std::vector<std::string> edges; ///< grid: "top", "bottom", "left", "right"
    std::vector<std::string>
        faces; ///< box: "left", "right" (along x), "bottom", "top" (y), "back", "front" (z)
    std::vector<Keyframe> motion;
    /// Led by World::set_pin_targets and set_pin_pose; held in place until then. Not together with `motion`.
    bool moved_by_program = false;
    /// Filled by resolve() in kinematic bodies with a sequence, instead of `motion`.
    std::shared_ptr<const SequencePlaces> places;
};

/// A body whose vertices are all led, and which nothing moves: a mesh that other bodies run into
/// (docs/contact.md). Of its material `thickness` alone is read.
struct Kinematic
{
    bool used = false;
    std::vector<Keyframe> motion; ///< none of the three: it stands where it is
    MeshSequence sequence;
    bool moved_by_program = false; ///< by World::set_pin_targets and set_pin_pose of its only pin
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
    mesh,
    box,
    ball,
    tetrahedra
};
/// Shapes that have tetrahedra.
constexpr bool is_solid(ShapeKind kind) { return kind >= ShapeKind::box; }

/// Where a body's rest shape comes from.
struct Shape
{
    ShapeKind kind = ShapeKind::grid;
    /// grid: cells along x and along -y in the plane z = 0, centred at the origin; the row y = +h/2 is "top".
    glm::uvec2 cells{32, 32}; ///< >= 1 each
    glm::dvec2 size{1, 1};    ///< m
    Diagonals diagonals = Diagonals::alternating; ///< grid
    SpringNetwork network;                        ///< grid
    /// chain: links along -y from the origin, `length` metres in all, each carrying a strip of `width`.
    std::uint32_t links = 10;   ///< >= 0 (0 = one free particle)
    double length = 1;          ///< m
    double width = 0.01;        ///< m, > 0
    std::filesystem::path file; ///< mesh: OBJ, PLY, OFF or STL; tetrahedra: docs/scene.md lists the formats
    double weld_distance = 0;   ///< mesh: vertices this close become one, m in file units; < 0 = keep all
    glm::uvec3 box_cells{4, 4, 4}; ///< box: cells along x, y, z, >= 1 each; centred at the origin
    glm::dvec3 box_size{1, 1, 1};  ///< box: m
    BoxSplit split = BoxSplit::five; ///< box
    std::uint32_t ball_cells = 8;    ///< ball: cells along a diameter, >= 2
    double radius = 0.5;             ///< ball: m
};

struct Body
{
    std::string name;
    Shape shape;
    Material material;
    Transform transform;
    BodyContact contact;
    Kinematic kinematic;
    std::vector<Pin> pins;  ///< of a kinematic body resolve() makes one, of all vertices
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
        SpringKind kind = SpringKind::extra; ///< set by resolve() for the springs of a network
    };
    std::vector<Spring> springs;
    /// Elements of a kind of Taut's or the program's own (elements/element.hpp); resolve() adds membranes.
    struct Elements
    {
        std::string kind;
        std::vector<std::uint32_t> vertices; ///< the corners of one element after another
        std::vector<double> values;          ///< ElementKind::values of one element after another
    };
    std::vector<Elements> elements;
    /// Solids: a fine surface (OBJ, PLY, OFF or STL, in the frame of the shape) that the tetrahedra carry
    /// along; drawn and written in place of their own. Empty: none.
    std::filesystem::path embedded_file;
    /// Filled by resolve(): the rest mesh in world space.
    Mesh mesh;
    Embedding embedding; ///< filled by resolve() where there is an embedded_file
};

enum class ColliderKind
{
    plane,
    sphere,
    capsule,
    cuboid,
    distance_field // the last one
};
inline constexpr std::size_t kColliderKinds = static_cast<std::size_t>(ColliderKind::distance_field) + 1;

struct DistanceField; // distance_field.hpp

struct Collider
{
    std::string name;
    ColliderKind kind = ColliderKind::sphere;
    /// m. Plane: a point on it; sphere, cuboid: centre; capsule: one end of its axis; distance_field: where
    /// the origin of its file lies.
    glm::dvec3 point{0};
    glm::dvec3 normal{0, 1, 0};      ///< plane: towards the free side
    double radius = 0.5;             ///< sphere, capsule, m, > 0
    glm::dvec3 end{0, 1, 0};         ///< capsule: the other end of its axis, m
    glm::dvec3 half_size{0.5};       ///< cuboid: half the edges, m, > 0
    glm::dvec3 rotate_axis{0, 1, 0}; ///< cuboid: turned about its centre; distance_field: about its origin
    double rotate_degrees = 0;
    std::filesystem::path field_file; ///< distance_field: read by resolve(), scaled, where `field` is null
    double field_scale = 1;           ///< > 0
    std::shared_ptr<const DistanceField> field;
    double friction = 0; ///< Coulomb coefficient, >= 0; 0 = no friction effect
    ColliderMeets meets = ColliderMeets::automatic;
    std::vector<Keyframe> motion;
    /// Set by a World whose program moves the collider: `motion` is then that of the last step alone, and the
    /// last key is where it is.
    bool moved_by_program = false;
};

inline constexpr std::uint32_t kMostSubsteps = 1000; ///< of a time step
/// How a step advances. docs/methods.md says which method reads which setting.
struct MethodSettings
{
    MethodKind type = MethodKind::xpbd;
    std::uint32_t substeps = 0; ///< per time step, 1..1000; 0: automatic_substeps(), put in by resolve()
    /// Per substep, 1..1000: sweeps (pbd, xpbd, vbd), Newton steps (implicit_euler), linear solves, each at
    /// the places that the one before led to (implicit_constraints, acad). 0: automatic_iterations(), put in
    /// by resolve().
    std::uint32_t iterations = 0;
    Precision precision = Precision::float32;

    Integrator integrator = Integrator::semi_implicit;
    StabilityRule stability = StabilityRule::refuse;
    ElementScheme scheme = ElementScheme::automatic;
    double stretch = 1;    ///< pbd: stiffness of springs in [0, 1], whatever the number of iterations
    double bend = 1;       ///< pbd: of hinges
    double volume = 1;     ///< pbd: of the volumes of tetrahedra
    double relaxation = 1; ///< pbd, vbd: each correction times this, in (0, 2)

    std::uint32_t linear_iterations = 100; ///< implicit_*, acad: of conjugate gradients a solve, 1..100000
    double linear_tolerance = 1e-5;        ///< of |residual| / |right-hand side|, (0, 1)
    LinearOperator linear_operator = LinearOperator::assembled;
    NewtonPreconditioner preconditioner = NewtonPreconditioner::block_jacobi;
    /// implicit_euler, 0..16: a Newton step that would raise the incremental potential is halved so often.
    std::optional<std::uint32_t> line_search; ///< none given: 16 where a body has tetrahedra, else 2

    ConstrainedSprings constrained = ConstrainedSprings::all;
    std::optional<double> constraint_compliance; ///< m/N, >= 0; none given: each spring's own
    double activate_strain = 0.05; ///< acad: (l - L)/L beyond which a spring becomes a constraint, > 0
    double release_strain = 0.05;  ///< acad: below which it is a spring again, at most activate_strain
    ReleaseRule release = ReleaseRule::multiplier;
    ConstraintTarget target = ConstraintTarget::threshold;
    bool compress = false; ///< acad: likewise below L(1 - activate_strain); then activate_strain < 1

    SweepStart start = SweepStart::adaptive;
    double spectral_radius = 0; ///< vbd, pbd (Jacobi): Chebyshev acceleration, [0, 1); 0 = none
};

/// Air that cloth moves in. Without density there is no wind effect.
struct Wind
{
    double density = 0;     ///< kg/m^3, >= 0
    glm::dvec3 velocity{0}; ///< m/s, before the first key
    struct Key
    {
        double time;         ///< s, ascending
        glm::dvec3 velocity; ///< m/s; linear in between, constant after the last
    };
    std::vector<Key> keys;
};
/// The wind's velocity [m/s] at a time [s].
glm::dvec3 wind_at(const Wind& wind, double time);

/// What a run may leave undone and still be called completed (docs/statuses.md).
struct Accept
{
    /// Strain, > 0: elements strained by more must be so by energy that was put in; what a method keeps at
    /// its length, or within a strain_limit, may be off by no more.
    double stretch = 0.1;
    double residual = 1;        ///< > 0, see StepReport::imbalance and load_residual
    std::uint32_t inverted = 0; ///< tetrahedra inside out at the end
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
    Accept accept;
    Wind wind;
    SceneContact contact;
    std::vector<Body> bodies;
    std::vector<Collider> colliders;
    std::filesystem::path directory; ///< mesh paths are relative to it
};

/// Names of the groups of its bodies (BodyContact::group), in the order of the bodies.
std::vector<std::string> contact_groups(const Scene& scene);

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

/// Substeps for a resolved scene that names none, 10 to 1,000: under xpbd, pbd and vbd what weight, mesh and
/// stiffness ask for, under implicit_euler what solids on colliders do; 10 under others (docs/methods.md).
std::uint32_t automatic_substeps(const Scene& resolved);
double wanted_substeps(const Scene& resolved); ///< the same without an upper limit

/// Iterations for a resolved scene that names none: under implicit_euler 2 where a substep carries waves of
/// cloth or a chain over more than an edge (docs/methods.md), else 1.
std::uint32_t automatic_iterations(const Scene& resolved);

/// Puts in the substeps and iterations of a resolved scene that names none.
void count_steps(Scene& resolved);

/// Checks, generates or loads every body's mesh, applies transforms, resolves pins; returns a scene
/// whose bodies have `mesh`, and whose pins have only `vertices` and `motion`. Throws Error with the
/// code of the first error, its text and the number of others. What was found, warnings and errors, is
/// appended to `found`, also where it throws.
Scene resolve(const Scene& scene, std::vector<SceneIssue>* found = nullptr);

} // namespace taut
