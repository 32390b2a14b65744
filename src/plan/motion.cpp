// The state of a scene and the passes that move it: every method corrects what these guess.
//
// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1; Hairer, Lubich, Wanner.
//   Geometric Numerical Integration, 2nd ed. 2006, I.1.4 (leapfrog).
// Departures: velocities stand half a substep beside the step, so that gravity is a parabola under every
//   method; only gravity, which is known before a run, has its first kick halved.

#include "taut/plan/motion.hpp"

#include "taut/kernels/coast.hpp"
#include "taut/kernels/finish.hpp"
#include "taut/kernels/predict.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/plan/mass_spring.hpp"
#include "taut/plan/wind.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>

namespace taut {
namespace {

/// Whether a body's momentum changes by gravity alone.
bool falls_freely(const Scene& scene, const Body& body)
{
    const bool held = std::any_of(body.pins.begin(), body.pins.end(),
                                  [](const Pin& pin) { return !pin.vertices.empty(); });
    return !held && scene.colliders.empty() && !wants_contact(scene) && scene.damping == 0 &&
           !scene.external_forces && !(scene.wind.density > 0 && catches_air(body));
}

/// Whether an effect changes velocities before the guess of a substep.
bool kicks_first(const Scene& scene)
{
    const std::span<const Effect> rows = effect_table();
    return std::any_of(rows.begin(), rows.end(), [&](const Effect& row) {
        return row.stage == Stage::force && row.name != "motion" &&
               (row.methods & only(scene.method.type)) != 0 && row.wanted(scene);
    });
}

bool any_shown(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const Body& body) {
        return !body.mesh.positions.empty() && !falls_freely(scene, body);
    });
}

void prepare_pull(PlanBuilder& b)
{
    b.plan.velocity_lead = velocity_lead(b.scene);
    b.plan.pull.resize(b.plan.vertex_count, Pull::held);
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        const Pull pull = falls_freely(b.scene, b.scene.bodies[body]) ? Pull::gravity : Pull::shown;
        for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
            if (b.inverse_mass[b.plan_index[v]] > 0)
                b.plan.pull[b.plan_index[v]] = pull;
    }
    b.coasts_first = wants_coast(b.scene);
    if (!any_shown(b.scene))
        return;
    const bool kept = b.plan.predicted != kNoBuffer && !b.coasts_first;
    b.plan.coasting = kept ? b.plan.predicted
                           : b.add_buffer("motion", "coasting",
                                          std::uint64_t(b.plan.vertex_count) * 4 * b.real_size());
}

bool is_last(const PlanBuilder& b, const Moment& moment) { return moment.substep + 1 == b.plan.substeps; }

} // namespace

bool wants_coast(const Scene& scene)
{
    return any_shown(scene) && velocity_lead(scene) < 0 && kicks_first(scene);
}

void prepare_motion(PlanBuilder& b)
{
    const std::uint64_t n = b.plan.vertex_count;
    const glm::dvec3 lead = velocity_lead(b.scene) * (b.plan.timestep / b.plan.substeps) * b.scene.gravity;
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        using Vec = glm::vec<4, Real>;
        std::vector<Vec> position, low, velocity;
        for (std::uint32_t v = 0; v < n; ++v)
        {
            const glm::vec<3, Real> high(b.start[v]);
            position.emplace_back(high, static_cast<Real>(b.inverse_mass[v]));
            low.emplace_back(glm::vec<3, Real>(b.start[v] - glm::dvec3(high)), static_cast<Real>(b.gap[v]));
        }
        velocity.resize(n, Vec(0));
        for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
            for (std::uint32_t v = b.plan.body_start[body]; v < b.plan.body_start[body + 1]; ++v)
                if (b.inverse_mass[b.plan_index[v]] > 0)
                    velocity[b.plan_index[v]] =
                        Vec(glm::vec<3, Real>(b.scene.bodies[body].velocity + lead), Real(0));
        b.plan.position = b.add_buffer<Vec>("motion", "position", position);
        b.plan.low = b.add_buffer<Vec>("motion", "low", low);
        b.plan.velocity = b.add_buffer<Vec>("motion", "velocity", velocity);
        b.plan.delta = b.add_buffer("motion", "delta", n * sizeof(Vec));
        b.plan.step_values = b.add_buffer("motion", "step values", sizeof(layout::StepValues<Real>));
    });
    b.plan.buffers[b.plan.step_values].host_written = true;
    b.plan.events = b.add_buffer("motion", "events", TAUT_EVENT_COUNT * sizeof(std::uint32_t));
    if (b.options.residuals || b.method.keeps_guess)
        b.plan.predicted = b.add_buffer("motion", "predicted", n * 4 * b.real_size());
    prepare_pull(b);
}

void record_coast(PlanBuilder& b, const Moment& moment)
{
    if (!is_last(b, moment))
        return;
    const kernels::coast::Bindings<Use> uses = {.position = {b.plan.position},
                                                .low = {b.plan.low},
                                                .velocity = {b.plan.velocity},
                                                .coasting = {b.plan.coasting},
                                                .step_values = {b.plan.step_values, 0}};
    b.dispatch("motion", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void record_predict(PlanBuilder& b, const Moment& moment)
{
    kernels::predict::Bindings<Use> uses = {.position = {b.plan.position},
                                            .low = {b.plan.low},
                                            .velocity = {b.plan.velocity},
                                            .delta = {b.plan.delta},
                                            .step_values = {b.plan.step_values, 0},
                                            .events = {b.plan.events, 0}};
    const bool coasts = !b.coasts_first && is_last(b, moment);
    const std::uint32_t kept =
        b.plan.predicted == kNoBuffer && coasts ? b.plan.coasting : b.plan.predicted;
    const bool keep = kept != kNoBuffer;
    if (keep)
        uses.predicted = {kept};
    b.dispatch("motion", keep ? "kept" : "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

void record_finish(PlanBuilder& b, const Moment&)
{
    const kernels::finish::Bindings<Use> uses = {.position = {b.plan.position},
                                                 .low = {b.plan.low},
                                                 .velocity = {b.plan.velocity},
                                                 .delta = {b.plan.delta},
                                                 .step_values = {b.plan.step_values, 0},
                                                 .events = {b.plan.events, 0}};
    b.dispatch("motion", "", uses, {b.plan.vertex_count}, b.plan.vertex_count);
}

} // namespace taut
