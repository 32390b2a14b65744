#pragma once
// What the files of the map's cases share: who may miss, what is judged, cloth that hangs.

#include "hard/map.hpp"

#include "taut/runtime/base/shown.hpp"

namespace taut::hard {

inline constexpr MethodSet kPositionBased = only(MethodKind::pbd) | only(MethodKind::xpbd);
/// One linearisation a solve: accurate while speed x step stays below a third of a spring's length.
inline constexpr MethodSet kLinearised = only(MethodKind::implicit_constraints) | only(MethodKind::acad);

/// Missed above `limit`. Beyond `worst` nobody may report it: a hundred limits unless said, so that a number
/// that grows by orders of magnitude fails.
inline Missed above(const char* what, double value, double limit, double worst = 0)
{
    if (value <= limit)
        return {};
    char text[96];
    std::snprintf(text, sizeof text, "%s %.3g, limit %.3g", what, value, limit);
    return {text, value, worst > 0 ? worst : 100 * limit};
}

template <typename... Texts>
inline Missed first_of(const Texts&... texts)
{
    Missed out;
    ((out = out.words.empty() ? Missed(texts) : out), ...);
    return out;
}

inline Missed no_energy_gained(const Journey& j, double worst)
{
    return above("energy above the start / scale", (j.highest_energy - energy(j.first)) / j.scale, 0.01,
                 worst);
}
/// Who may gain energy at all gains less than there was, unless said: a start that comes apart.
inline Missed gains_no_energy(const Journey& j) { return no_energy_gained(j, 1); }
/// For what is so stiff that a rounding of a length is much energy: nothing moves faster than some falls.
inline Missed calm(const Journey& j)
{
    const PhysicalModel model = make_model(j.world.scene());
    const double fall = std::sqrt(2 * glm::length(model.gravity) * model.diameter);
    return above("largest speed / speed of a fall", j.fastest / fall, 3);
}
inline Missed sound(const Journey&) { return {}; }

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

inline glm::dvec3 mean(const std::vector<glm::dvec3>& values)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& v : values)
        sum += v;
    return sum / double(values.size());
}

/// The cases of the other files.
void add_contact_and_more(std::vector<MapCase>& out);
void add_repeats(std::vector<MapCase>& out);
void add_more(std::vector<MapCase>& out);
void add_slides(std::vector<MapCase>& out);
void add_solids(std::vector<MapCase>& out);
void add_loaded_solids(std::vector<MapCase>& out);

} // namespace taut::hard
