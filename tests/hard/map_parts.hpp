#pragma once
// What the files of the map's cases share: who may miss, what is judged, cloth that hangs.

#include "hard/map.hpp"

#include "taut/runtime/base/shown.hpp"

namespace taut::hard {

inline constexpr MethodSet kPositionBased = only(MethodKind::pbd) | only(MethodKind::xpbd);
/// One linearisation a solve: accurate while speed x step stays below a third of a spring's length.
inline constexpr MethodSet kLinearised = only(MethodKind::implicit_constraints) | only(MethodKind::acad);
/// Nothing in these holds lengths but springs.
inline constexpr MethodSet kSprings = only(MethodKind::mass_spring) | only(MethodKind::implicit_euler);

inline std::string above(const char* what, double value, double limit)
{
    if (value <= limit)
        return {};
    char text[96];
    std::snprintf(text, sizeof text, "%s %.3g, limit %.3g", what, value, limit);
    return text;
}

template <typename... Texts>
inline std::string first_of(const Texts&... texts)
{
    std::string out;
    ((out = out.empty() ? std::string(texts) : out), ...);
    return out;
}

inline std::string no_energy_gained(const Journey& j)
{
    return above("energy above the start / scale", (j.highest_energy - energy(j.first)) / j.scale, 0.01);
}
/// For what is so stiff that a rounding of a length is much energy: nothing moves faster than some falls.
inline std::string calm(const Journey& j)
{
    const PhysicalModel model = make_model(j.world.scene());
    const double fall = std::sqrt(2 * glm::length(model.gravity) * model.diameter);
    return above("largest speed / speed of a fall", j.fastest / fall, 3);
}
inline std::string sound(const Journey&) { return {}; }

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

/// The cases of the other files.
void add_contact_and_more(std::vector<MapCase>& out);
void add_solids(std::vector<MapCase>& out);

} // namespace taut::hard
