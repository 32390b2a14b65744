#pragma once
// Internal to src/plan: patches of surfaces that cannot meet themselves while they face one way, so that a
// search may pass them over (kernels/contact/contact_search.comp).

#include "taut/plan/contact_tree.hpp"

namespace taut {

/// Marks in `owns` how far up the tree the largest patch of each leaf begins (TAUT_CONTACT_OWNS_PATCH). A
/// node is a patch where its triangles are of one body, hang together by sides, face one way at rest and
/// cover, seen from there, three fifths of their convex hull at least and none of it twice; where no side has
/// more than two triangles; and where the border of the surface has no corner that points inwards, so no slit
/// or notch whose lips could slide over each other. `rest`: of each plan vertex, m.
void mark_patches(std::span<ContactLeaf> leaves, std::span<const glm::dvec3> rest);

} // namespace taut
