#pragma once
// Internal to src/plan: surfaces that meet themselves and each other, as an effect (docs/contact.md).

#include "taut/plan/builder.hpp"

namespace taut {

/// Buffers of contact while a plan is made.
struct ContactBuffers
{
    // Of the tree, of vertices and bodies: fixed by the plan.
    std::uint32_t triangle = kNoBuffer, node = kNoBuffer, rest = kNoBuffer, body = kNoBuffer;
    // Of the search, a triangle.
    std::uint32_t found = kNoBuffer, compared = kNoBuffer, start = kNoBuffer, control = kNoBuffer,
                  lost = kNoBuffer;
    // Of pairs.
    std::uint32_t pair = kNoBuffer, side = kNoBuffer, row = kNoBuffer, taken = kNoBuffer, impulse = kNoBuffer;
    std::uint32_t known = kNoBuffer, memory = kNoBuffer; ///< of the list before (contact_remember)
    // Of the corners of pairs at each vertex.
    std::uint32_t corners = kNoBuffer, placed = kNoBuffer, corner_start = kNoBuffer, corner = kNoBuffer,
                  active = kNoBuffer;
    std::uint32_t place = kNoBuffer; ///< of vertices, at the last search
    // Of vertices, with the guarantee (guarantee.hpp).
    std::uint32_t anchor = kNoBuffer, asked = kNoBuffer, asked_next = kNoBuffer;
    std::uint32_t triangles = 0, leaves = 0, capacity = 0;
    std::uint32_t every = 1;              ///< substeps that a search looks ahead
    float skin = 0, reach = 0, stray = 0; ///< m
};

inline constexpr std::string_view kContactEffect = "contact";

/// Adds a pass over as many groups as the control buffer has at `gate`: none where nothing is to be done.
template <template <typename> typename Bindings>
void gated(PlanBuilder& b, std::string_view variant, const Bindings<Use>& uses,
           const typename Bindings<Use>::Params& params, std::uint32_t count, std::uint64_t gate)
{
    b.dispatch_indirect(kContactEffect, variant, uses, params, count, b.contact->control,
                        gate * sizeof(std::uint32_t));
}

void prepare_contact(PlanBuilder& builder);
/// The search, where vertices are not where the last one expected them.
void record_contact_search(PlanBuilder& builder, const Moment& moment);
void record_contact(PlanBuilder& builder, const Moment& moment);

} // namespace taut
