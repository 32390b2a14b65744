// What colliders are in the way of vertices, for the sweeps of vertex block descent.
//
// Based on: kernels/vbd/vbd_touch.comp.
// Departures: none.

#include "taut/kernels/vbd_touch_distance_field.hpp"
#include "taut/plan/collider_shapes.hpp"
#include "taut/plan/vbd.hpp"

#include <algorithm>
#include <string>

namespace taut {

bool meets_colliders(const PlanBuilder& b)
{
    const auto& names = b.options.available_effects;
    for (std::size_t row = 0; row < kColliderKinds; ++row)
    {
        const auto kind = static_cast<ColliderKind>(row);
        const bool available =
            names.empty() || std::find(names.begin(), names.end(), collider_shape(kind).name) != names.end();
        if (available && collider_count(b.scene, kind) > 0)
            return true;
    }
    return false;
}

void prepare_vbd_touch(PlanBuilder& b, BlockBuffers& f)
{
    if (f.touched == kNoBuffer)
        return;
    const std::uint32_t n = b.plan.vertex_count;
    f.surfaces = f.apart ? 3 * n : n; // behind the blocks of added elements, or a copy of the guesses
    f.contacts = f.apart ? f.block
                         : b.add_buffer("vbd_solve", "guess and contacts",
                                        std::uint64_t(n) * 4 * (1 + TAUT_VBD_CONTACT) * b.real_size());
}

/// Kernels of all shapes have one interface; that with values is the widest.
void record_vbd_touch(PlanBuilder& b, const Moment& moment)
{
    const BlockBuffers& f = *b.blocks;
    std::uint32_t first = 1;
    for (std::size_t row = 0; f.surfaces != 0 && row < kColliderKinds; ++row)
    {
        const auto kind = static_cast<ColliderKind>(row);
        if (b.plan.colliders[row] == kNoBuffer)
            continue;
        const kernels::vbd_touch_distance_field::Bindings<Use> uses = {
            .position = {b.plan.position},
            .delta = {b.plan.delta},
            .collider = {b.plan.colliders[row], 0},
            .step_values = {b.plan.step_values, 0},
            .contacts = {f.contacts, 4},
            .support = {f.support},
            .touched = {f.touched, 0},
            .values = {b.collider_values[row], 2 * kFarValues}}; // asked twice
        b.dispatch_by_name("vbd_start", "vbd_touch_" + std::string(collider_shape(kind).name), "", uses,
                           {b.plan.vertex_count, collider_count(b.scene, kind), moment.substep,
                            b.plan.substeps, first, f.surfaces, f.apart ? 0u : 1u},
                           b.plan.vertex_count);
        first = 0;
    }
}

} // namespace taut
