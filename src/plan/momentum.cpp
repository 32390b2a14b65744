// Solids that nothing holds keep their angular momentum, whatever the solve of a substep leaves.
//
// Based on: Newton's third law; Goldstein, Poole, Safko. Classical Mechanics, 3rd ed. 2002, 5.3.
// Departures: a rigid velocity makes good what the solve took, at once or little by little, so that neither
//   the order of the elements nor the length of a substep turns a body. docs/effects/momentum.md.

#include "taut/plan/momentum.hpp"

#include "taut/kernels/momentum_sum.hpp"
#include "taut/kernels/momentum_turn.hpp"
#include "taut/kernels/vbd_mark.hpp"
#include "taut/plan/body_parts.hpp"
#include "taut/plan/contact_scene.hpp"

#include "taut/kernels/shared/body_parts.h"

#include <algorithm>

namespace taut {

struct MomentumBuffers
{
    std::uint32_t row = kNoBuffer, sums = kNoBuffer, before = kNoBuffer;
    std::uint32_t groups = 0, rows = 0;
};

namespace {

/// Cloth is left out: a sweep over its springs costs less than the sums, and little of it flies freely. Among
/// colliders, so are bodies that start in shape: docs/effects/momentum.md, "Scenes with colliders". What
/// meets other bodies is turned by them.
bool turns_freely(const Scene& scene, const Body& body)
{
    const bool among_colliders = scene.method.type == MethodKind::xpbd && !body.start_positions.empty();
    return !body.mesh.tetrahedra.empty() && (scene.colliders.empty() || among_colliders) &&
           !takes_part(scene, body) &&
           std::all_of(body.pins.begin(), body.pins.end(), [](const Pin& p) { return p.vertices.empty(); });
}

} // namespace

bool wants_momentum(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const Body& body) { return turns_freely(scene, body); });
}

void prepare_momentum(PlanBuilder& b)
{
    BodyParts parts;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
            if (turns_freely(b.scene, b.scene.bodies[body]))
                rows.push_back(b.plan_index[v]);
        parts.add(rows, std::vector<std::uint32_t>(rows.size(), 1), false);
    }
    b.momentum = std::make_shared<MomentumBuffers>();
    MomentumBuffers& m = *b.momentum;
    m.groups = parts.groups();
    m.rows = parts.row_count();
    m.row = b.add_buffer<std::uint32_t>("momentum", "rows", parts.words());
    m.sums = b.add_buffer("momentum", "sums", std::uint64_t(m.groups) * TAUT_MOMENTUM_SUMS * b.real_size());
    b.plan.owed = b.add_buffer("momentum", "owed", std::uint64_t(b.plan.vertex_count) * 4 * b.real_size());
    m.before = b.method.keeps_guess ? b.plan.predicted
                                    : b.add_buffer("momentum", "displacement before the sweeps",
                                                   std::uint64_t(b.plan.vertex_count) * 4 * b.real_size());
}

void record_momentum_start(PlanBuilder& b, const Moment&)
{
    const kernels::vbd_mark::Bindings<Use> uses = {.delta = {b.plan.delta}, .solved = {b.momentum->before}};
    b.dispatch("momentum", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void record_momentum_end(PlanBuilder& b, const Moment&)
{
    const MomentumBuffers& m = *b.momentum;
    const kernels::momentum_sum::Bindings<Use> sum = {.row = {m.row},
                                                      .before = {m.before},
                                                      .delta = {b.plan.delta},
                                                      .sums = {m.sums, 0},
                                                      .position = {b.plan.position}};
    b.dispatch("momentum", "", sum, {m.groups}, m.groups, m.rows);
    const kernels::momentum_turn::Bindings<Use> turn = {.row = {m.row},
                                                        .sums = {m.sums, 0},
                                                        .position = {b.plan.position},
                                                        .delta = {b.plan.delta},
                                                        .low = {b.plan.low},
                                                        .owed = {b.plan.owed, 0},
                                                        .step_values = {b.plan.step_values, 0}};
    b.dispatch("momentum", "", turn, {m.groups}, m.groups, m.rows);
}

} // namespace taut
