#pragma once
// What the files of the map's cases share: who may miss, what is judged, cloth that hangs.

#include "hard/map.hpp"

#include "taut/runtime/base/shown.hpp"

namespace taut::hard {

inline constexpr MethodSet kPositionBased = only(MethodKind::pbd) | only(MethodKind::xpbd);
/// One linearisation a solve: accurate while speed x step stays below a third of a spring's length.
inline constexpr MethodSet kLinearised = only(MethodKind::implicit_constraints) | only(MethodKind::acad);

inline Measured above(const char* what, double value, double limit) { return {what, value, limit}; }

/// What has no number: 1 where it is so, 0 where it is not.
inline Measured never(const char* what, bool is_so) { return {what, is_so ? 1.0 : 0.0, 0}; }

template <typename... Criteria>
inline Findings each_of(const Criteria&... criteria)
{
    Findings out;
    (out.list.push_back(criteria), ...);
    return out;
}

/// For `check` with too few steps to be judged: whatever was measured then is only held to the table.
inline Findings so_far(Findings found)
{
    found.judged = false;
    return found;
}

/// For what is so stiff that a rounding of a length is much energy: nothing moves faster than some falls.
inline Measured calm(const Journey& j)
{
    const PhysicalModel model = make_model(j.world.scene());
    const double fall = std::sqrt(2 * glm::length(model.gravity) * model.diameter);
    return above("largest speed / speed of a fall", j.fastest / fall, 3);
}

inline Scene with_stretch(Scene scene, double stiffness)
{
    for (Body& body : scene.bodies)
        body.material.stretch_stiffness = stiffness;
    return scene;
}

inline Scene hanging(std::uint32_t n, double damping = 0.5)
{
    Scene scene = test::hanging(n);
    scene.bodies[0].material.bending_stiffness = 1e-4;
    scene.damping = damping;
    return scene;
}

/// Explicit springs, and no volumes: tetrahedra that turned inside out are at rest there.
inline constexpr MethodSet kForces = only(MethodKind::mass_spring) | only(MethodKind::acad);

/// A metre of soft rubber in cells along each axis.
inline Body solid_box(const glm::uvec3& cells, const glm::dvec3& size, double modulus = 1e5,
                      double ratio = 0.3)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = cells;
    body.shape.box_size = size;
    body.material = solid_material();
    body.material.youngs_modulus = modulus;
    body.material.poissons_ratio = ratio;
    return body;
}

inline Body block(std::uint32_t n, double modulus = 1e5, double ratio = 0.3)
{
    return solid_box({n, n, n}, {1, 1, 1}, modulus, ratio);
}

inline Scene scene_of(const Body& body, double damping = 1, const glm::dvec3& gravity = glm::dvec3(0))
{
    Scene scene;
    scene.bodies = {body};
    scene.damping = damping;
    scene.gravity = gravity;
    return resolve(scene);
}

inline Pin hold_face(const char* face)
{
    Pin pin;
    pin.faces = {face};
    return pin;
}

inline Collider flat_floor(double height, double friction = 0.5)
{
    Collider c;
    c.kind = ColliderKind::plane;
    c.point = {0, height, 0};
    c.friction = friction;
    return c;
}

/// Total mass of what is not pinned, kg.
inline double free_mass(const Journey& j)
{
    const PhysicalModel model = make_model(j.world.scene());
    double sum = 0;
    for (std::size_t v = 0; v < model.mass.size(); ++v)
        sum += model.pinned[v] ? 0 : model.mass[v];
    return sum;
}

/// J: what a collider or pin of this speed gives to all at most, which bounces off it with twice as much.
inline std::function<double(const Journey&)> pushed_by(double speed)
{
    return [speed](const Journey& j) { return 0.5 * free_mass(j) * 4 * speed * speed; };
}

inline glm::dvec3 mean(const std::vector<glm::dvec3>& values)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& v : values)
        sum += v;
    return sum / double(values.size());
}

/// m: how far the mean of all vertices has come down.
inline double fallen(const Journey& j) { return mean(j.start).y - mean(j.world.positions()).y; }

/// Vertices of a body that lie lowest at rest.
inline std::vector<std::uint32_t> lowest(const Mesh& mesh)
{
    double low = kInfinity;
    for (const glm::dvec3& x : mesh.positions)
        low = std::min(low, x.y);
    std::vector<std::uint32_t> out;
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        if (mesh.positions[v].y < low + 1e-9)
            out.push_back(v);
    return out;
}

/// m: mean height of those of the first body that lie lowest at rest, above their height at rest.
inline double lifted(const Journey& j)
{
    const Mesh& mesh = j.world.scene().bodies[0].mesh;
    const auto low = lowest(mesh);
    const auto x = j.world.positions();
    double sum = 0;
    for (const std::uint32_t v : low)
        sum += x[v].y - mesh.positions[v].y;
    return sum / double(low.size());
}

/// m: where lower edges of cloth hang at rest (lifted): hanging() of 3^2, 4^2 and 6^2 cells, of 6^2 with
/// springs of 100 N/m, and of 8^2 held by a third corner, the lower right one, where it is at rest;
/// kHang4Twice with copies of all vertices that hang on them.
inline constexpr double kHang3 = -0.00256, kHang4 = -0.00285, kHang6 = -0.00285, kSoftHang = -0.02746,
                        kThirdCorner = -0.0027, kHang4Twice = -0.00497;

/// m: of a cubic metre of rubber, 1e5 Pa and nu 0.4999, hung by its upper face, in 3^3 cells.
inline constexpr double kHungRubber = -0.014;

/// The answer of what hangs: its lower edge lies where statics put it.
inline Measured hangs(const Journey& j, double right)
{
    return above("error of the lower edge / its way", std::abs(lifted(j) / right - 1), 0.1);
}

/// Methods whose stiffness is not the material's: what hangs on springs of theirs misses the length.
inline constexpr MethodSet kOwnStiffness = only(MethodKind::pbd);
/// acad holds what is stretched beyond its threshold: no further than that, whatever the load.
inline constexpr MethodSet kHoldsThreshold = only(MethodKind::acad);
/// Nearly rigid springs: what sweeps or a rounding leave of a length, 1e-4 of it and less, is more energy
/// than all that falls has.
inline constexpr MethodSet kSweeps = only(MethodKind::pbd) | only(MethodKind::xpbd) | only(MethodKind::vbd);

/// Without damping of its own: what was drawn over itself comes to rest in another shape.
inline constexpr MethodSet kTangles = only(MethodKind::mass_spring);

/// Statics of a hanging chain whose links carry what is below them.
inline Measured length_error(const Journey& j, double link_stiffness)
{
    const Scene& scene = j.world.scene();
    const std::vector<double>& mass = scene.bodies[0].vertex_masses;
    const std::vector<glm::dvec3>& rest = scene.bodies[0].mesh.positions;
    double below = 0, right = 0;
    for (std::size_t v = rest.size() - 1; v > 0; --v)
    {
        below += mass[v];
        right += glm::distance(rest[v], rest[v - 1]) + below * glm::length(scene.gravity) / link_stiffness;
    }
    const std::vector<glm::dvec3> x = j.world.positions();
    return above("error of the length", std::abs((x.front().y - x.back().y) / right - 1), 0.01);
}

/// How far the edges of all meshes are from their lengths at rest, root mean square of |l/L - 1|: the shape,
/// wherever it has moved to.
inline double distortion(const Scene& scene, const std::vector<glm::dvec3>& x)
{
    double sum = 0;
    std::size_t count = 0, first = 0;
    const auto add = [&](const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
        const double rest = glm::distance(mesh.positions[a], mesh.positions[b]);
        const double part = glm::distance(x[first + a], x[first + b]) / rest - 1;
        sum += part * part;
        ++count;
    };
    for (const Body& body : scene.bodies)
    {
        for (const auto& t : body.mesh.tetrahedra)
            for (std::size_t a = 0; a < 4; ++a)
                for (std::size_t b = a + 1; b < 4; ++b)
                    add(body.mesh, t[a], t[b]);
        if (body.mesh.tetrahedra.empty())
            for (const auto& t : body.mesh.triangles)
                for (std::size_t a = 0; a < 3; ++a)
                    add(body.mesh, t[a], t[(a + 1) % 3]);
        first += body.mesh.positions.size();
    }
    return count > 0 ? std::sqrt(sum / double(count)) : 0;
}

/// The answer of what started out of shape.
inline Measured back_in_shape(const Journey& j, double limit = 0.05)
{
    return above("distortion", distortion(j.world.scene(), j.world.positions()), limit);
}

/// m: of mass.
inline glm::dvec3 centre(const World& world)
{
    const PhysicalModel model = make_model(world.scene());
    glm::dvec3 sum(0);
    double mass = 0;
    const auto x = world.positions();
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        sum += model.mass[v] * x[v];
        mass += model.mass[v];
    }
    return sum / mass;
}

/// The cases of the other files.
void add_contact_and_more(std::vector<MapCase>& out);
void add_repeats(std::vector<MapCase>& out);
void add_more(std::vector<MapCase>& out);
void add_slides(std::vector<MapCase>& out);
void add_solids(std::vector<MapCase>& out);
void add_loaded_solids(std::vector<MapCase>& out);

} // namespace taut::hard
