// Based on: Sims. Parallel Cloth Simulation Using OpenMP and CUDA. Louisiana State University 2009 (CPU and
//   GPU share one simulation); Demmel et al. IPDPS 2008 (src/plan/cut_halo.cpp).
// Departures: vertices are divided, not loops, so a part keeps its vertices from step to step, and only those
//   beside the cut pass through the host, once a sweep.

#include "taut/world/split.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/plan/methods.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/runtime/required.hpp"
#include "taut/world/at_step.hpp"
#include "taut/world/beside.hpp"
#include "taut/world/carry.hpp"
#include "taut/world/moved.hpp"
#include "taut/world/split_side.hpp"

#include <glm/vec4.hpp>

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>

namespace taut {
namespace {

using Clockwork = std::chrono::steady_clock;

constexpr int kTimedRuns = 3;

/// The least time of some runs of `work`, ms; the first warms up.
template <typename Work>
double least_ms(const Work& work)
{
    double least = 0;
    for (int turn = 0; turn <= kTimedRuns; ++turn)
    {
        const auto start = Clockwork::now();
        work();
        const std::chrono::duration<double, std::milli> took = Clockwork::now() - start;
        if (turn > 0)
            least = turn == 1 ? took.count() : std::min(least, took.count());
    }
    return least;
}

void check(const Scene& scene, double share)
{
    if (!(share <= 1))
        throw Error(ErrorCode::bad_input, "the share of the first device is " + std::to_string(share) +
                                              "; it must lie in 0 to 1, or be negative for a measured one");
    if (scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "a split world has nothing to divide: the scene has no bodies");
    if (wants_contact(scene))
        throw Error(ErrorCode::unsupported, "surfaces that meet cannot be cut between two devices; use one "
                                            "device, or leave contact out");
    const MethodKind method = scene.method.type;
    if (method != MethodKind::xpbd && !(method == MethodKind::pbd && pbd_is_coloured(scene)))
        throw Error(
            ErrorCode::unsupported,
            "method.type " + quoted(method) +
                (method == MethodKind::pbd ? " with method.scheme " + quoted(scene.method.scheme) : "") +
                " cannot be cut between two devices; \"xpbd\" and \"pbd\" with the scheme \"coloured\" "
                "can: divide whole bodies, or use one device");
}

/// What both devices can do. Colours are not grouped: a part has fewer constraints than the whole, and costs
/// of two devices decide nothing together.
DeviceTraits traits_of_both(const Device& first, const Device& second)
{
    DeviceTraits traits = limits_as_traits(first), other = limits_as_traits(second);
    traits.max_buffer_bytes = std::min(traits.max_buffer_bytes, other.max_buffer_bytes);
    traits.float64 = traits.float64 && other.float64;
    traits.dispatch_ns = traits.group_barrier_ns = 0;
    return traits;
}

PlanOptions without_groups(PlanOptions options)
{
    options.small_bodies = PlanOptions::SmallBodies::never;
    return options;
}

template <typename Real>
std::vector<glm::dvec3> vectors(const std::vector<std::byte>& bytes)
{
    std::vector<glm::vec<4, Real>> values(bytes.size() / sizeof(glm::vec<4, Real>));
    std::copy(bytes.begin(), bytes.end(), std::as_writable_bytes(std::span(values)).begin());
    return {values.begin(), values.end()};
}

} // namespace

struct SplitWorld::Impl
{
    Scene scene;
    SplitOptions options;
    Plan whole;
    std::array<SplitSide, 2> sides;
    std::vector<std::vector<std::uint32_t>> exchanged; ///< buffers, after each segment but the last
    std::array<std::vector<std::byte>, 2> mail;        ///< what each side sends
    std::unique_ptr<Beside> beside;                    ///< steps the second side where both are native
    SplitCosts costs;
    double share = 1;
    std::uint64_t steps = 0;
    Moved program;
    bool moves = false; ///< inputs change from step to step
    bool stale = true;  ///< they have not been handed over

    double time() const { return static_cast<double>(steps) * scene.timestep; }
    void cut(double wanted);
    void measure();
    std::array<std::vector<InputWrite>, 2> take_inputs();
    void run_segment(std::size_t segment, const std::array<std::vector<InputWrite>, 2>& inputs);
    void exchange(std::size_t after);
    std::vector<std::byte> collected(std::uint32_t buffer) const;
    std::vector<glm::dvec3> read(std::uint32_t buffer) const;
    std::vector<glm::dvec3> in_scene_order(const std::vector<glm::dvec3>& values) const;
};

void SplitWorld::Impl::cut(double wanted)
{
    const double n = whole.vertex_count;
    const auto count = static_cast<std::uint32_t>(std::lround(wanted * n));
    PlanCut cut = cut_plan(whole, count, options.exchange);
    for (std::size_t s = 0; s < 2; ++s)
        sides[s].take(std::move(cut.parts[s]));
    exchanged = std::move(cut.exchanged);
    share = n > 0 ? count / n : 1;
    stale = true;
    const bool threads = std::all_of(sides.begin(), sides.end(),
                                     [](const SplitSide& s) { return s.is_native() && !s.idle(); });
    beside = threads ? std::make_unique<Beside>() : nullptr;
}

/// Times both halves, each alone, and the exchanges. What has moved is thrown away by the next cut.
void SplitWorld::Impl::measure()
{
    const auto inputs = take_inputs();
    std::array<double, 2> alone = {0, 0};
    const auto total = static_cast<double>(sides[0].part.own_work + sides[1].part.own_work);
    for (std::size_t s = 0; s < 2; ++s)
    {
        SplitSide& side = sides[s];
        const double half = least_ms([&] {
            for (std::size_t segment = 0; segment < side.segments.size(); ++segment)
                side.start(segment, segment == 0 ? inputs[s] : std::vector<InputWrite>());
            side.device->wait();
        });
        alone[s] = half * total / static_cast<double>(std::max<std::uint64_t>(side.part.work, 1));
    }
    const double exchanges = least_ms([&] {
        for (std::size_t k = 0; k < exchanged.size(); ++k)
            exchange(k);
    });
    const std::size_t count = exchanged.size();
    costs = {alone[0], alone[1], count > 0 ? exchanges / static_cast<double>(count) : 0, count};
}

std::array<std::vector<InputWrite>, 2> SplitWorld::Impl::take_inputs()
{
    std::array<std::vector<InputWrite>, 2> inputs;
    const Stretch step{time(), static_cast<double>(steps + 1) * scene.timestep};
    const bool ordered = program.begin_step(scene, step.from, step.to);
    for (std::size_t s = 0; s < 2; ++s)
        if ((moves || stale || ordered) && !sides[s].idle())
            inputs[s] = step_inputs(scene, sides[s].part.plan, step, program.values());
    stale = false;
    return inputs;
}

/// The native CPU computes where it is asked, so other devices go first.
void SplitWorld::Impl::run_segment(std::size_t segment, const std::array<std::vector<InputWrite>, 2>& inputs)
{
    if (!beside)
    {
        for (const bool native : {false, true})
            for (std::size_t s = 0; s < 2; ++s)
                if (sides[s].is_native() == native)
                    sides[s].start(segment, inputs[s]);
        return;
    }
    beside->start([&] { sides[1].start(segment, inputs[1]); });
    std::exception_ptr error;
    try
    {
        sides[0].start(segment, inputs[0]);
    }
    catch (...)
    {
        error = std::current_exception(); // the other side still uses what this one was given
    }
    beside->finish();
    if (error)
        std::rethrow_exception(error);
}

void SplitWorld::Impl::exchange(std::size_t after)
{
    for (const std::uint32_t buffer : exchanged[after])
    {
        for (std::size_t s = 0; s < 2; ++s)
            sides[s].send(buffer, mail[s]);
        for (std::size_t s = 0; s < 2; ++s)
            sides[s].receive(buffer, mail[1 - s]);
    }
}

std::vector<std::byte> SplitWorld::Impl::collected(std::uint32_t buffer) const
{
    if (buffer == kNoBuffer)
        return {};
    std::vector<std::byte> out(whole.buffers[buffer].bytes);
    for (const SplitSide& side : sides)
        side.collect(buffer, out);
    return out;
}

std::vector<glm::dvec3> SplitWorld::Impl::read(std::uint32_t buffer) const
{
    const std::vector<std::byte> bytes = collected(buffer);
    return whole.precision == Precision::float64 ? vectors<double>(bytes) : vectors<float>(bytes);
}

std::vector<glm::dvec3> SplitWorld::Impl::in_scene_order(const std::vector<glm::dvec3>& values) const
{
    std::vector<glm::dvec3> out(values.size());
    for (std::size_t v = 0; v < values.size(); ++v)
        out[whole.original[v]] = values[v];
    return out;
}

SplitWorld::SplitWorld(const Scene& scene, std::shared_ptr<Device> first, std::shared_ptr<Device> second,
                       const SplitOptions& options)
    : impl_(std::make_unique<Impl>())
{
    Impl& my = *impl_;
    my.sides[0].device = required(std::move(first), "a SplitWorld");
    my.sides[1].device = required(std::move(second), "a SplitWorld");
    check(scene, options.share);
    const bool meshes = std::all_of(scene.bodies.begin(), scene.bodies.end(),
                                    [](const Body& b) { return !b.mesh.positions.empty(); });
    my.scene = meshes ? scene : resolve(scene);
    my.options = options;
    my.whole = make_plan(my.scene, traits_of_both(*my.sides[0].device, *my.sides[1].device),
                         without_groups(options.plan));
    my.moves = inputs_move(my.scene, my.whole);
    my.program.start(my.scene);
    moved_ = &my.program;
    double share = options.share;
    if (share < 0)
    {
        my.cut(0.5);
        const bool both = !my.sides[0].idle() && !my.sides[1].idle();
        if (both)
            my.measure();
        share = both ? best_share(my.costs) : 1;
    }
    my.cut(share);
}

SplitWorld::~SplitWorld() = default;
SplitWorld::SplitWorld(SplitWorld&&) noexcept = default;
SplitWorld& SplitWorld::operator=(SplitWorld&&) noexcept = default;

void SplitWorld::step()
{
    Impl& my = *impl_;
    auto inputs = my.take_inputs();
    for (std::size_t segment = 0; segment <= my.exchanged.size(); ++segment)
    {
        if (segment > 0)
            my.exchange(segment - 1);
        my.run_segment(segment, inputs);
        inputs = {};
    }
    for (const SplitSide& side : my.sides)
        side.device->wait();
    my.program.end_step(my.scene.timestep);
    ++my.steps;
}

std::uint64_t SplitWorld::steps() const { return impl_->steps; }
double SplitWorld::time() const { return impl_->time(); }
const Scene& SplitWorld::scene() const { return impl_->scene; }
const Plan& SplitWorld::plan() const { return impl_->whole; }
double SplitWorld::share() const { return impl_->share; }
const SplitCosts& SplitWorld::costs() const { return impl_->costs; }
std::uint64_t SplitWorld::work() const
{
    return impl_->sides[0].part.own_work + impl_->sides[1].part.own_work;
}
std::uint64_t SplitWorld::exchanges() const { return impl_->exchanged.size(); }

std::uint64_t SplitWorld::exchanged_bytes() const
{
    const std::uint64_t each = 4 * real_bytes(impl_->whole.precision);
    std::uint64_t bytes = 0;
    for (const auto& buffers : impl_->exchanged)
        for (const SplitSide& side : impl_->sides)
            bytes += buffers.size() * side.part.sent * each;
    return bytes;
}

std::vector<glm::dvec3> SplitWorld::positions() const
{
    std::vector<glm::dvec3> out = impl_->read(impl_->whole.position);
    const std::vector<glm::dvec3> low = impl_->read(impl_->whole.low);
    for (std::size_t v = 0; v < out.size(); ++v)
        out[v] += low[v];
    return impl_->in_scene_order(out);
}

std::vector<glm::dvec3> SplitWorld::velocities() const
{
    const Plan& plan = impl_->whole;
    const Pace pace{impl_->scene.timestep / plan.substeps, impl_->scene.gravity, plan.velocity_lead};
    std::vector<glm::dvec3> out = impl_->read(plan.velocity);
    const std::vector<glm::dvec3> delta = impl_->read(plan.delta);
    const std::vector<glm::dvec3> coasting = plan.coasting == kNoBuffer ? delta : impl_->read(plan.coasting);
    for (std::size_t v = 0; v < out.size(); ++v)
        out[v] = velocity_at_step(pace, {plan.pull[v], out[v], delta[v], coasting[v]});
    return impl_->in_scene_order(out);
}

Events SplitWorld::events() const
{
    Events sum;
    for (const SplitSide& side : impl_->sides)
    {
        if (side.idle())
            continue;
        const auto counts =
            side.device->read<std::uint32_t>(side.buffers[impl_->whole.events], TAUT_EVENT_COUNT);
        add(sum, {counts[TAUT_EVENT_NON_FINITE], counts[TAUT_EVENT_SPEED_CLAMP],
                  counts[TAUT_EVENT_DEGENERATE], counts[TAUT_EVENT_CONFLICT]});
    }
    return sum;
}

std::vector<HybridPart> SplitWorld::parts() const
{
    const Plan& plan = impl_->whole;
    std::vector<HybridPart> out;
    for (const SplitSide& side : impl_->sides)
    {
        const PlanPart& part = side.part;
        const bool first = &side == impl_->sides.data();
        const double whole_ms = first ? impl_->costs.first_ms : impl_->costs.second_ms;
        HybridPart row{side.device->info(),
                       {},
                       part.own,
                       part.work,
                       whole_ms * static_cast<double>(part.work) / static_cast<double>(work())};
        std::vector<bool> has(plan.body_start.size(), false);
        for (std::uint32_t v = 0; v < part.own; ++v)
            has[static_cast<std::size_t>(std::upper_bound(plan.body_start.begin(), plan.body_start.end(),
                                                          plan.original[part.vertices[v]]) -
                                         plan.body_start.begin() - 1)] = true;
        for (std::uint32_t b = 0; b < impl_->scene.bodies.size(); ++b)
            if (has[b])
                row.bodies.push_back(b);
        out.push_back(std::move(row));
    }
    return out;
}

void SplitWorld::copy_into(World& whole) const
{
    const Plan& plan = impl_->whole;
    const std::uint32_t buffers[kCarriedArrays] = {plan.position, plan.low,      plan.velocity, plan.delta,
                                                   plan.force,    plan.coasting, plan.owed};
    CarriedState state;
    for (std::size_t k = 0; k < kCarriedArrays; ++k)
    {
        const std::vector<std::byte> bytes = impl_->collected(buffers[k]);
        const std::size_t each = bytes.size() / plan.vertex_count;
        state.arrays[k].resize(bytes.size());
        for (std::uint32_t v = 0; v < plan.vertex_count && each > 0; ++v)
            std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(v * each), each,
                        state.arrays[k].begin() + static_cast<std::ptrdiff_t>(plan.original[v] * each));
    }
    state.step = impl_->steps;
    state.clock.timestep = impl_->scene.timestep;
    state.clock.gravity = impl_->scene.gravity;
    state.clock.substep = impl_->scene.timestep / plan.substeps;
    state.clock.lead = plan.velocity_lead;
    std::vector<std::uint32_t> all(impl_->scene.bodies.size());
    std::iota(all.begin(), all.end(), 0u);
    state.moved = impl_->program.values();
    deliver(whole, scene_vertices(whole.plan(), all, plan.body_start), all, state);
}

} // namespace taut
