#pragma once
// Takes surfaces apart that go through each other, or are nearer than their gap, where a scene starts:
// `contact.start: "separate"`.

#include "taut/scene/scene.hpp"

#include <cstddef>
#include <string>

namespace taut {

/// What it took.
struct SeparatedStart
{
    Scene scene;          ///< with other Body::start_positions; rest shapes are those that they were
    std::string crossed;  ///< what crossed, in words (StartSurfaces::crossed); empty: nothing
    std::size_t near = 0; ///< pairs that were nearer than their gap
    std::size_t left = 0; ///< pairs that still are: contact lets them out
    double farthest = 0;  ///< m: that a vertex was moved
};

/// `resolved`: by resolve(). The result does not depend on executors: fp64, on this thread; the scene as it
/// is where nothing is to be done. Pinned vertices and bodies that are led stay; colliders are not looked at.
/// Throws Error{bad_input} that names what still crosses where that does not end, or the solid whose
/// tetrahedra it would turn inside out. A round looks at all surfaces, and there may be thousands: a tenth of
/// a second for sheets, up to minutes for a garment of 10,000 triangles within a body, before it is refused.
///
/// First what hangs together goes as a whole, without a change of shape, as long as two wholes cross or are
/// too near; then, where surfaces cross themselves or are held, single vertices do, and edges keep the
/// lengths that they start with, by projection after each round (start_moves.hpp). Where each has to go:
/// start_ways.hpp.
SeparatedStart separate_start(const Scene& resolved);

/// m, scene-wide: where vertices go so that nothing crosses any longer, of a scene that runs; where they are
/// if nothing does. Single vertices go, in few rounds: empty where those do not do, or would turn tetrahedra
/// inside out. `now`: resolved, its bodies start where they are.
std::vector<glm::dvec3> untangled_places(const Scene& now);

/// The scene as contact.start has it begin. Throws Error{bad_input} where surfaces cross and that refuses
/// them, and what separate_start() throws.
Scene with_start(Scene resolved);

} // namespace taut
