#pragma once
// Internal to src/plan: springs and hinges of all bodies as lists with the elements at each vertex, for
// methods that gather forces vertex by vertex.

#include "taut/plan/builder.hpp"
#include "taut/plan/material.hpp"

#include <vector>

namespace taut {

/// The elements at each vertex: entries start[v] up to start[v + 1], ascending by element.
struct Incidence
{
    std::vector<std::uint32_t> start;   ///< vertices + 1
    std::vector<std::uint32_t> entries; ///< element * corners + corner
};

/// `corners` lists `arity` vertices an element.
Incidence incidence_of(std::uint32_t vertex_count, std::span<const std::uint32_t> corners,
                       std::uint32_t arity);

/// For methods that move by forces. Throws Error{unsupported} for rigid elements, Error{degenerate_rest} for
/// springs that are rigid because they have no length, Error{limit} for a vertex of more elements than one
/// invocation may visit.
void refuse_rigid(const Scene& resolved);

/// Springs of a body that can act (not between two held vertices), in the order of stretch_elements; in plan
/// vertices. Adds the warning "conflict" for violated ones between held vertices.
std::vector<StretchElement> acting_springs(PlanBuilder& builder, std::size_t body);
/// The same for hinges. Adds the warning "degenerate" for those without an angle at rest.
std::vector<BendElement> acting_hinges(PlanBuilder& builder, std::size_t body);

/// Buffers of springs on the device, kNoBuffer where a scene has none.
struct SpringBuffers
{
    std::vector<StretchElement> elements; ///< as acting_springs, body by body
    Incidence at;
    std::uint32_t records = kNoBuffer;  ///< layout::Spring<real>; a rigid spring's stiffness is 0
    std::uint32_t start = kNoBuffer;    ///< uint32, vertices + 1: Incidence::start
    std::uint32_t incident = kNoBuffer; ///< uint32: Incidence::entries, 2 * spring + end
};
SpringBuffers make_spring_buffers(PlanBuilder& builder, std::string_view effect);

/// The same of hinges; incident entries are 4 * hinge + corner (edge0, edge1, wing0, wing1).
struct HingeBuffers
{
    std::vector<BendElement> elements;
    Incidence at;
    std::uint32_t records = kNoBuffer; ///< layout::BendingConstraint<real>
    std::uint32_t start = kNoBuffer;
    std::uint32_t incident = kNoBuffer;
};
HingeBuffers make_hinge_buffers(PlanBuilder& builder, std::string_view effect);

} // namespace taut
