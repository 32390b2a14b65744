#pragma once
// Internal to src/plan: elements of Body::elements (taut/elements/element.hpp), membranes and kinds that the
// program has added: what scenes say of them, records, and the sweeps of xpbd and pbd.

#include "taut/elements/element.hpp"
#include "taut/plan/builder.hpp"

namespace taut {

class Refusals;

/// Refuses, naming body, list and what would be right, as `bad_input` unknown kinds and lists that do not fit
/// them, as `unsupported` a method without kernels for them and bodies that tear.
void check_added_elements(const Scene& resolved, Refusals& out);

/// J, of one element of a list, with the body's vertices at x (m).
double energy_of(const ElementKind& kind, const Body::Elements& list, std::size_t element,
                 std::span<const glm::dvec3> x);

/// Whether a body has any.
bool wants_added_elements(const Scene& resolved);

/// The elements of one kind of which a corner moves, body by body.
struct AddedSet
{
    const ElementKind* kind = nullptr;
    std::vector<std::uint32_t> vertices; ///< in plan vertices, kind->corners an element
    std::vector<std::byte> records;      ///< as kernels read them
    std::uint32_t count() const;
};
/// Those that are not empty, in the order in which the scene names kinds first.
std::vector<AddedSet> added_sets(const PlanBuilder& builder);

/// One set of coloured records a kind, in the order in which the scene names kinds first.
void prepare_added_elements(PlanBuilder& builder);
/// One sweep over all of them.
void record_added_elements(PlanBuilder& builder, const Moment& moment);

} // namespace taut
