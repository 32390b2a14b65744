#pragma once
// Methods, shapes and colliders of one kind each, for programs: what a kind does not read cannot be written.
//
//   scene.method = taut::methods::Xpbd{.substeps = 160};
//   body.shape = taut::shapes::Grid{.cells = {64, 64}, .size = {1, 1}};
//   scene.colliders = {taut::colliders::Sphere{.centre = {0, -0.4, 0}, .radius = 0.3, .friction = 0.4}};
//
// Members have the units, ranges and defaults of those of MethodSettings, Shape and Collider (scene.hpp),
// which each of them converts to. check() looks at values as it does at those of a scene file.

#include "taut/scene/scene.hpp"

namespace taut::methods {

// substeps, iterations and precision stand in each type, since members of a base could not be named beside
// the type's own: Vbd{.substeps = 40, .relaxation = 0.9}.

/// Extended position-based dynamics (docs/theory/xpbd-solids.md says how solids are written in it).
struct Xpbd
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    operator MethodSettings() const;
};

/// Vertex block descent (docs/methods/vbd.md).
struct Vbd
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    double relaxation = MethodSettings().relaxation;
    SweepStart start = MethodSettings().start;
    double spectral_radius = MethodSettings().spectral_radius;
    operator MethodSettings() const;
};

/// Position-based dynamics (docs/methods/pbd.md).
struct Pbd
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    ElementScheme scheme = MethodSettings().scheme;
    double stretch = MethodSettings().stretch, bend = MethodSettings().bend, volume = MethodSettings().volume;
    double relaxation = MethodSettings().relaxation;
    double spectral_radius = MethodSettings().spectral_radius;
    operator MethodSettings() const;
};

/// Springs as forces (docs/methods/mass_spring.md).
struct MassSpring
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    Integrator integrator = MethodSettings().integrator;
    StabilityRule stability = MethodSettings().stability;
    ElementScheme scheme = MethodSettings().scheme;
    operator MethodSettings() const;
};

/// Newton's method on the incremental potential (docs/methods/implicit_euler.md).
struct ImplicitEuler
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    std::uint32_t linear_iterations = MethodSettings().linear_iterations;
    double linear_tolerance = MethodSettings().linear_tolerance;
    LinearOperator linear_operator = MethodSettings().linear_operator;
    NewtonPreconditioner preconditioner = MethodSettings().preconditioner;
    std::optional<std::uint32_t> line_search = MethodSettings().line_search;
    operator MethodSettings() const;
};

/// Implicit constraint enforcement (docs/methods/implicit_constraints.md).
struct ImplicitConstraints
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    Integrator integrator = MethodSettings().integrator;
    StabilityRule stability = MethodSettings().stability;
    std::uint32_t linear_iterations = MethodSettings().linear_iterations;
    double linear_tolerance = MethodSettings().linear_tolerance;
    LinearOperator linear_operator = MethodSettings().linear_operator;
    ConstrainedSprings constrained = MethodSettings().constrained;
    std::optional<double> constraint_compliance = MethodSettings().constraint_compliance;
    operator MethodSettings() const;
};

/// Adaptive constraint activation (docs/methods/acad.md).
struct Acad
{
    std::uint32_t substeps = MethodSettings().substeps, iterations = MethodSettings().iterations;
    Precision precision = MethodSettings().precision;
    Integrator integrator = MethodSettings().integrator;
    StabilityRule stability = MethodSettings().stability;
    std::uint32_t linear_iterations = MethodSettings().linear_iterations;
    double linear_tolerance = MethodSettings().linear_tolerance;
    ConstrainedSprings constrained = MethodSettings().constrained;
    std::optional<double> constraint_compliance = MethodSettings().constraint_compliance;
    double activate_strain = MethodSettings().activate_strain;
    std::optional<double> release_strain = std::nullopt; ///< none given: activate_strain
    ReleaseRule release = MethodSettings().release;
    ConstraintTarget target = MethodSettings().target;
    bool compress = MethodSettings().compress;
    operator MethodSettings() const;
};

} // namespace taut::methods

namespace taut::shapes {

/// A rectangle of cloth in the plane z = 0.
struct Grid
{
    glm::uvec2 cells = Shape().cells;
    glm::dvec2 size = Shape().size;
    Diagonals diagonals = Shape().diagonals;
    SpringNetwork network = Shape().network;
    operator Shape() const;
};

/// Links along -y from the origin.
struct Chain
{
    std::uint32_t links = Shape().links;
    double length = Shape().length, width = Shape().width;
    operator Shape() const;
};

/// Triangles of a file: OBJ, PLY, OFF or STL.
struct Mesh
{
    std::filesystem::path file;
    double weld_distance = Shape().weld_distance;
    operator Shape() const;
};

/// A box of tetrahedra, centred at the origin; solid_material() makes the material that goes with it.
struct Box
{
    glm::uvec3 cells = Shape().box_cells;
    glm::dvec3 size = Shape().box_size;
    BoxSplit split = Shape().split;
    operator Shape() const;
};

/// A ball of tetrahedra, centred at the origin; its material as a box's.
struct Ball
{
    std::uint32_t cells = Shape().ball_cells; ///< along a diameter
    double radius = Shape().radius;
    operator Shape() const;
};

/// Tetrahedra of a file (docs/scene.md lists the formats).
struct Tetrahedra
{
    std::filesystem::path file;
    operator Shape() const;
};

} // namespace taut::shapes

namespace taut::colliders {

/// A half space that nothing enters: what lies against `normal` from `point`.
struct Plane
{
    glm::dvec3 point = Collider().point;
    glm::dvec3 normal = Collider().normal; ///< towards the free side
    double friction = 0;
    ColliderMeets meets = Collider().meets;
    std::vector<Keyframe> motion = {};
    std::string name = {};
    operator Collider() const;
};

struct Sphere
{
    glm::dvec3 centre = Collider().point;
    double radius = Collider().radius;
    double friction = 0;
    ColliderMeets meets = Collider().meets;
    std::vector<Keyframe> motion = {};
    std::string name = {};
    operator Collider() const;
};

/// All within a radius of the line from one point to another.
struct Capsule
{
    glm::dvec3 from = Collider().point, to = Collider().end;
    double radius = Collider().radius;
    double friction = 0;
    ColliderMeets meets = Collider().meets;
    std::vector<Keyframe> motion = {};
    std::string name = {};
    operator Collider() const;
};

struct Cuboid
{
    glm::dvec3 centre = Collider().point;
    glm::dvec3 half_size = Collider().half_size;
    glm::dvec3 rotate_axis = Collider().rotate_axis; ///< through the centre
    double rotate_degrees = 0;
    double friction = 0;
    ColliderMeets meets = Collider().meets;
    std::vector<Keyframe> motion = {};
    std::string name = {};
    operator Collider() const;
};

/// A grid of signed distances (`taut sdf`), of a file or made by the program.
struct Field
{
    std::filesystem::path file;
    std::shared_ptr<const DistanceField> field = {}; ///< used in place of the file where there is one
    double scale = Collider().field_scale;
    glm::dvec3 origin = Collider().point;
    glm::dvec3 rotate_axis = Collider().rotate_axis; ///< through the origin
    double rotate_degrees = 0;
    double friction = 0;
    ColliderMeets meets = Collider().meets;
    std::vector<Keyframe> motion = {};
    std::string name = {};
    operator Collider() const;
};

} // namespace taut::colliders
