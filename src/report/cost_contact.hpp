#pragma once
// What surfaces do to each other over a run, and how far that is from the reference's.

#include "taut/world/world.hpp"

#include <optional>
#include <span>

namespace taut::cost {

/// Sums over the frames of a run.
struct ContactTrace
{
    double impulse = 0;  ///< N s: of the normal forces of all pairs, each frame's by that of its last substep
    double friction = 0; ///< N s: likewise of the lengths of friction
    double depth = 0;    ///< m: the most by which a pair was nearer than it is kept, at the end of a frame

    /// Adds the frame at whose end `world` is, its vertices at `x` (scene-wide). Waits.
    void add(const World& world, std::span<const glm::dvec3> x);
};

/// Of a setting, against the reference.
struct ContactError
{
    double impulse = 0;  ///< |J - J*| / J*
    double friction = 0; ///< |F - F*| / J*, F of friction
    double depth = 0;    ///< m, ContactTrace::depth; the reference's is not taken off
};

/// None where the reference's surfaces have not pushed each other.
std::optional<ContactError> contact_error(const ContactTrace& found, const ContactTrace& reference);

} // namespace taut::cost
