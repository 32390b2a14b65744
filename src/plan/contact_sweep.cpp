// Sweeps over the pairs of surfaces that meet, with colliders in between.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics. SIGGRAPH 2014 (contacts as
//   constraints of positions); Tonge, Benevolenski, Voroshilov. SIGGRAPH 2012 (mass splitting); Mazhar, Heyn,
//   Negrut, Tasora. ACM TOG 34(3), 2015 (momentum). Each kernel of kernels/contact says more.
// Departures: none beyond those of the kernels.

#include "taut/plan/contact.hpp"

#include "taut/kernels/contact_gap.hpp"
#include "taut/kernels/contact_move.hpp"
#include "taut/kernels/contact_push.hpp"
#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/colliders.hpp"

namespace taut {
namespace {

/// The `k`th sweep of an iteration, the first of its substep or not.
void record_sweep(PlanBuilder& b, const ContactBuffers& c, std::uint32_t k, bool first)
{
    const kernels::contact_gap::Bindings<Use> gap = {.pair = {c.pair},
                                                     .position = {b.plan.position, 4},
                                                     .delta = {b.plan.delta, 4},
                                                     .step_values = {b.plan.step_values, 0},
                                                     .control = {c.control, 0},
                                                     .side = {c.side},
                                                     .row = {c.row},
                                                     .acting = {c.active, 4}};
    gated(b, "", gap, {c.capacity, first}, c.capacity, TAUT_CONTACT_PAIR_GROUPS);
    const kernels::contact_push::Bindings<Use> push = {.pair = {c.pair},
                                                       .position = {b.plan.position, 4},
                                                       .control = {c.control, 0},
                                                       .side = {c.side},
                                                       .row = {c.row},
                                                       .acting = {c.active, 4},
                                                       .taken = {c.taken},
                                                       .impulse = {c.impulse}};
    const float momentum =
        k + 1 < b.scene.contact.sweeps ? static_cast<float>(k) / static_cast<float>(k + 3) : 0.0f;
    gated(b, "", push, {c.capacity, first, momentum}, c.capacity, TAUT_CONTACT_PAIR_GROUPS);
    const kernels::contact_move::Bindings<Use> move = {.start = {c.corner_start, 2},
                                                       .corner = {c.corner},
                                                       .row = {c.row},
                                                       .impulse = {c.impulse},
                                                       .position = {b.plan.position},
                                                       .delta = {b.plan.delta},
                                                       .acting = {c.active}};
    gated(b, "", move, {b.plan.vertex_count}, b.plan.vertex_count, TAUT_CONTACT_VERTEX_GROUPS);
}

} // namespace

void record_contact(PlanBuilder& b, const Moment& moment)
{
    for (std::uint32_t k = 0; k < b.scene.contact.sweeps; ++k)
    {
        const bool first = moment.iteration == 0 && k == 0;
        record_sweep(b, *b.contact, k, first);
        if (k + 1 < b.scene.contact.sweeps) // the last push is that of Stage::contact
            record_colliders(b, moment, {first, false, 1});
    }
}

} // namespace taut
