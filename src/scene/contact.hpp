#pragma once
// How surfaces meet: the objects `contact` of a scene and of a body (docs/contact.md). Part of scene.hpp.

#include "taut/scene/options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace taut {

/// How deformable surfaces meet each other. Two surfaces of radii r and s keep their middles r + s apart.
struct SceneContact
{
    bool between = false;  ///< different bodies meet; false = none does: no effect unless a body meets itself
    /// m, >= 0: radius of all surfaces that give none; without it each material's `thickness`.
    std::optional<double> thickness = std::nullopt;
    double friction = 0;   ///< Coulomb coefficient of all surfaces that give none, >= 0
    FrictionMix friction_mix = FrictionMix::mean;
    std::uint32_t searches = 4; ///< a time step, 1..1000: how often pairs that may meet are looked for
    /// 1..100: over all pairs, after each iteration of the constraints; 0: automatic_sweeps(), put in by
    /// resolve()
    std::uint32_t sweeps = 0;
    ContactStart start = ContactStart::ignore;
    Guarantee guarantee = Guarantee::none;
};

/// The same of one body's surface.
struct BodyContact
{
    bool self = false;             ///< the surface meets itself
    std::string group = "default"; ///< a name that others may pass through
    /// Groups whose bodies do not meet this one, nor it them. Its own: bodies of the group do not meet each
    /// other. Whether a body meets itself is said by `self` alone.
    std::vector<std::string> passes;
    /// m, >= 0: its radius, and its Coulomb coefficient, >= 0; without them as the scene says.
    std::optional<double> thickness = std::nullopt, friction = std::nullopt;
    bool meets_absent = false; ///< filled by SleepWorld: it meets bodies that are left out of the scene now
};

/// Names of groups that the bodies of a scene may have between them.
inline constexpr std::size_t kMostContactGroups = 32;

/// Whether two bodies, which are not one, pass through each other by what they say of groups.
bool pass_through(const BodyContact& a, const BodyContact& b);

struct Scene;
/// SceneContact::sweeps of a resolved scene that names none: 2; 8 where a solid can meet something; where it
/// can meet cloth 2 sqrt(its mass by area / the cloth's), 8 to 100. The weight of a solid lies on few
/// vertices, each in many pairs, and cloth under it carries that with next to no mass (docs/contact.md, "How
/// many sweeps").
std::uint32_t automatic_sweeps(const Scene& resolved);

} // namespace taut
