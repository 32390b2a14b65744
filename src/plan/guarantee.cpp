// Surfaces that meet never cross: a plane between the two of every pair, and ways cut so that each vertex
// keeps to its side.
//
// Based on: Chen et al. Divide and truncate, 2026, arXiv 2604.15513, through the codes that follow it; Chen
// et
//   al. Offset Geometric Contact. SIGGRAPH 2025. Each kernel of kernels/contact/guarantee_*.comp says more.
// Departures: as the kernels say.

#include "taut/plan/guarantee.hpp"

#include "taut/kernels/guarantee_anchor.hpp"
#include "taut/kernels/guarantee_begin.hpp"
#include "taut/kernels/guarantee_filter.hpp"
#include "taut/kernels/guarantee_plane.hpp"
#include "taut/kernels/guarantee_spread.hpp"
#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact.hpp"

#include <utility>

namespace taut {
namespace {

constexpr std::string_view kGuaranteeEffect = "guarantee";
/// Rounds in which vertices that keep to their planes ask their neighbours to; then all are asked, if need
/// be.
constexpr int kRounds = 2;

/// Adds a pass over the pairs that are listed.
template <template <typename> typename Bindings>
void over_pairs(PlanBuilder& b, std::string_view variant, const Bindings<Use>& uses,
                const typename Bindings<Use>::Params& params)
{
    b.dispatch_indirect(kGuaranteeEffect, variant, uses, params, b.contact->capacity, b.contact->control,
                        TAUT_CONTACT_PAIR_GROUPS * sizeof(std::uint32_t));
}

void record_begin(PlanBuilder& b, const ContactBuffers& c)
{
    const kernels::guarantee_begin::Bindings<Use> uses = {.position = {b.plan.position},
                                                          .low = {b.plan.low},
                                                          .anchor = {c.anchor, 2},
                                                          .delta = {b.plan.delta},
                                                          .asked = {c.asked},
                                                          .next = {c.asked_next},
                                                          .events = {b.plan.events, 0}};
    b.dispatch(kGuaranteeEffect, "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void record_planes(PlanBuilder& b, const ContactBuffers& c)
{
    const kernels::guarantee_plane::Bindings<Use> uses = {.pair = {c.pair},
                                                          .position = {b.plan.position, 4},
                                                          .low = {b.plan.low, 4},
                                                          .delta = {b.plan.delta, 4},
                                                          .control = {c.control, 0},
                                                          .row = {c.row, 2},
                                                          .lost = {c.lost, 0},
                                                          .asked = {c.asked, 4}};
    over_pairs(b, "", uses, {c.capacity});
}

/// The buffer in which the result stands.
std::uint32_t record_rounds(PlanBuilder& b, const ContactBuffers& c)
{
    std::uint32_t from = c.asked, to = c.asked_next;
    for (int round = 0; round <= kRounds; ++round)
    {
        const kernels::guarantee_spread::Bindings<Use> uses = {.pair = {c.pair},
                                                               .low = {b.plan.low, 4},
                                                               .delta = {b.plan.delta, 4},
                                                               .control = {c.control, 0},
                                                               .row = {c.row, 2},
                                                               .asked = {from, 4},
                                                               .next = {to, 4}};
        over_pairs(b, round == kRounds ? "last" : "", uses, {c.capacity, b.plan.vertex_count});
        std::swap(from, to);
    }
    return from;
}

void record_filter(PlanBuilder& b, const ContactBuffers& c, std::uint32_t asked)
{
    const kernels::guarantee_filter::Bindings<Use> uses = {.start = {c.corner_start, 2},
                                                           .corner = {c.corner},
                                                           .row = {c.row},
                                                           .low = {b.plan.low},
                                                           .asked = {asked},
                                                           .anchor = {c.anchor, 2},
                                                           .delta = {b.plan.delta},
                                                           .lost = {c.lost, 0}};
    b.dispatch(kGuaranteeEffect, "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

} // namespace

void prepare_guarantee(PlanBuilder& b)
{
    const std::uint64_t vertices = b.plan.vertex_count, word = sizeof(std::uint32_t);
    ContactBuffers& c = *b.contact;
    c.anchor = b.add_buffer(kGuaranteeEffect, "anchors", vertices * 8 * b.real_size());
    c.asked = b.add_buffer(kGuaranteeEffect, "asked", (vertices + 1) * word);
    c.asked_next = b.add_buffer(kGuaranteeEffect, "asked next", (vertices + 1) * word);
}

void record_guarantee_anchor(PlanBuilder& b, const Moment&)
{
    const ContactBuffers& c = *b.contact;
    const kernels::guarantee_anchor::Bindings<Use> uses = {.position = {b.plan.position},
                                                           .delta = {b.plan.delta},
                                                           .rest = {c.rest},
                                                           .body = {c.body},
                                                           .control = {c.control, 0},
                                                           .start = {c.corner_start, 2},
                                                           .anchor = {c.anchor, 2}};
    b.dispatch_indirect(kGuaranteeEffect, "", uses, {b.plan.vertex_count, c.every, c.skin},
                        b.plan.vertex_count, c.control, TAUT_CONTACT_GATE_VERTICES * sizeof(std::uint32_t));
}

void record_guarantee(PlanBuilder& b, const Moment&)
{
    record_begin(b, *b.contact);
    record_planes(b, *b.contact);
    record_filter(b, *b.contact, record_rounds(b, *b.contact));
}

} // namespace taut
