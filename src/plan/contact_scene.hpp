#pragma once
// What of a resolved scene meets (docs/contact.md).

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

class Refusals;

/// Pairs that a list may hold at most.
inline constexpr std::uint32_t kMostContactPairs = 1u << 21;
/// m: the coordinates of PlanContact::place of a vertex that makes the next substep begin with a search.
inline constexpr float kBeforeSearch = 1e18f;

/// m: how far the surface of a body keeps from the middle of its gap to another one.
double radius_of(const Scene& scene, const Body& body);
/// Coulomb coefficient of the surface of a body.
double friction_of(const Scene& scene, const Body& body);
/// TAUT_CONTACT_MIX_* of contact.friction_mix.
std::uint32_t friction_mix_of(const Scene& scene);

/// Bits of the names of groups, in the order in which the bodies of a scene first have them.
struct GroupBits
{
    std::uint32_t group = 0; ///< its own
    std::uint32_t meets = 0; ///< those that it does not pass through; none where bodies do not meet
};
GroupBits group_bits(const Scene& scene, const Body& body);

/// Whether the surface of a body meets itself or another one.
bool takes_part(const Scene& resolved, const Body& body);
/// Whether the surfaces of two bodies meet, or that of one itself.
bool surfaces_meet(const Scene& resolved, std::size_t a, std::size_t b);
/// Of bodies that meet, directly or by others: which of them one number stands for.
std::vector<std::size_t> meeting_parts(const Scene& resolved);
/// Of two bodies that touch exactly, the one of more is on top: 0 of what is held whole, else a number that
/// grows from body to body.
std::uint32_t touching_height(const Scene& resolved, std::size_t body);
/// Against gravity, of length 1; y where there is none.
glm::dvec3 upwards(const Scene& scene);

/// Whether the surface of any body meets itself or another one.
bool wants_contact(const Scene& resolved);

/// Whether surfaces that meet must never cross.
bool wants_guarantee(const Scene& resolved);

/// Refuses, as `unsupported`, a guarantee that cannot be given; as `bad_input` surfaces too thin for where
/// they are, and a guarantee where nothing meets.
void check_contact(const Scene& resolved, Refusals& out);

} // namespace taut
