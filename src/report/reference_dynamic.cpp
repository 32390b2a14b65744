// Reference R3: plain loops over springs, hinges, tetrahedra and colliders.
// Based on: Hairer, Lubich, Wanner, Geometric Numerical Integration, 2006 (symplectic Euler,
//   Stoermer-Verlet); Roache, Verification and Validation, 1998 (observed order, Richardson estimate).
// Departures: contacts are projections of the position at the end of a step, the velocity follows; with
//   them everything is first order, but for gravity, whose first kick is half. Damping is exp(-c h), before
//   gravity. Spheres do not spin, and the speed limit of the scene is not applied.
#include "taut/report/reference_dynamic.hpp"

#include "taut/report/contact.hpp"
#include "taut/runtime/base/in_parallel.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace taut {
namespace {

using Scheme = DynamicOptions::Scheme;
using reference::Surface;

/// One run at one step size.
class MotionRun
{
public:
    MotionRun(const PhysicalModel& model, Scheme scheme, std::uint64_t steps_per_frame)
        : model_(model),
          scheme_(scheme),
          steps_(steps_per_frame),
          h_(model.timestep / static_cast<double>(steps_per_frame)),
          x_(model.start),
          v_(model.velocity),
          before_(model.start),
          force_(model.start.size(), glm::dvec3(0))
    {
        for (const Collider& collider : model.colliders)
            surfaces_.push_back(reference::surface_at(collider, 0));
        for (const ModelPin& pin : model.pins)
            x_[pin.vertex] = pose(pin.motion, 0, model.start[pin.vertex]);
        add_forces(model_, x_, force_);
        for (std::size_t i = 0; scheme == Scheme::symplectic_euler && i < x_.size(); ++i)
            if (!model.pinned[i])
                v_[i] -= h_ / 2 * model.gravity;
    }

    Frames frames(std::size_t count)
    {
        Frames out{x_};
        for (std::size_t f = 0; f < count; ++f)
        {
            for (std::uint64_t s = 0; s < steps_; ++s)
                step(model_.timestep * static_cast<double>(f) + h_ * static_cast<double>(s + 1));
            out.push_back(x_);
        }
        return out;
    }

private:
    /// v += dt force/m; force_ is of x_.
    void kick(double dt)
    {
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (!model_.pinned[i])
                v_[i] += (dt / model_.mass[i]) * force_[i];
    }

    void damp(double dt)
    {
        if (model_.damping > 0)
            for (glm::dvec3& v : v_)
                v *= std::exp(-model_.damping * dt);
    }

    void drift(double end)
    {
        before_ = x_;
        for (std::size_t i = 0; i < x_.size(); ++i)
            if (!model_.pinned[i])
                x_[i] += h_ * v_[i];
        for (const ModelPin& pin : model_.pins)
            if (!pin.motion.empty())
                x_[pin.vertex] = pose(pin.motion, end, model_.start[pin.vertex]);
    }

    void step(double end)
    {
        const bool verlet = scheme_ == Scheme::verlet;
        damp(verlet ? h_ / 2 : h_);
        kick(verlet ? h_ / 2 : h_);
        drift(end);
        collide(end);
        std::fill(force_.begin(), force_.end(), glm::dvec3(0));
        add_forces(model_, x_, force_);
        if (verlet)
        {
            kick(h_ / 2);
            damp(h_ / 2);
        }
    }

    void collide(double end)
    {
        for (std::size_t c = 0; c < surfaces_.size(); ++c)
        {
            const Surface now = reference::surface_at(model_.colliders[c], end);
            for (std::size_t i = 0; i < x_.size(); ++i)
                if (!model_.pinned[i])
                    push_out(i, now, surfaces_[c], model_.colliders[c].friction);
            surfaces_[c] = now;
        }
    }

    /// The way out is the normal impulse times h/m, so the cone of Coulomb holds between lengths too.
    void push_out(std::size_t i, const Surface& surface, const Surface& before, double friction)
    {
        const reference::Touch touch = surface.touch(x_[i], model_.gap[i]);
        if (!(touch.height < 0))
            return;
        glm::dvec3 push = -touch.height * touch.normal;
        const glm::dvec3 shift = surface.carried(before, x_[i] + push);
        const glm::dvec3 slide = x_[i] + push - before_[i] - shift;
        const glm::dvec3 along = slide - glm::dot(slide, touch.normal) * touch.normal;
        const double length = glm::length(along), most = -friction * touch.height;
        if (length > 0 && most > 0)
            push -= std::min(1.0, most / length) * along;
        x_[i] += push;
        v_[i] += push / h_;
    }

    const PhysicalModel& model_;
    Scheme scheme_;
    std::uint64_t steps_; // per frame
    double h_;
    std::vector<glm::dvec3> x_, v_, before_, force_;
    std::vector<Surface> surfaces_; // at the end of the last step
};

bool starts_inside(const PhysicalModel& model)
{
    for (const Collider& collider : model.colliders)
    {
        const Surface surface = reference::surface_at(collider, 0);
        for (std::size_t i = 0; i < model.start.size(); ++i)
        {
            const double height = surface.touch(model.start[i], model.gap[i]).height;
            if (!model.pinned[i] && height < -1e-9 * model.diameter)
                return true;
        }
    }
    return false;
}

std::string refusal(const PhysicalModel& model, const DynamicOptions& options, double element_steps)
{
    if (!model.plates.empty())
        return "there are plates, which the dynamic reference does not model";
    if (!model.added.empty())
        return "there are membranes, or elements of its own: the dynamic reference knows their energy only";
    if (const std::size_t rigid = rigid_element_count(model); rigid > 0)
        return std::to_string(rigid) + " elements are rigid (compliance 0): no step is small enough";
    if (options.scheme == Scheme::verlet && !model.colliders.empty())
        return "contacts are first order: ask for symplectic_euler with colliders";
    if (model.faces_meet)
        return "a collider meets triangles, and the dynamic reference knows those that meet vertices: say "
               "\"meets\": \"vertices\" where that is what you want to study";
    if (starts_inside(model))
        return "a vertex starts inside a collider: how fast it comes out is a choice, not physics";
    if (!(element_steps <= options.max_element_steps))
        return "too stiff or too long for explicit steps: " + shown(element_steps, 3) +
               " element steps, the limit is " + shown(options.max_element_steps, 3);
    return {};
}

std::uint64_t coarsest_steps(const PhysicalModel& model, double safety)
{
    const double frequency = frequency_bound(model, model.start);
    const double wanted = model.timestep * frequency / (2 * safety);
    return wanted < 1e12 ? std::max<std::uint64_t>(8, static_cast<std::uint64_t>(std::ceil(wanted)))
                         : 1'000'000'000'000;
}

std::vector<Frames> run_levels(const PhysicalModel& model, Scheme scheme, std::uint64_t coarsest,
                               std::size_t frame_count, const DynamicOptions& options)
{
    std::vector<Frames> out(options.levels);
    const auto level = [&](std::uint32_t l) {
        out[l] = MotionRun(model, scheme, coarsest << l).frames(frame_count);
    };
    const std::uint32_t finest = options.levels - 1;
    const auto coarser = [&] {
        for (std::uint32_t l = 0; l < finest; ++l)
            level(l);
    };
    if (options.two_threads)
        in_parallel(2, [&](std::uint32_t k) { k == 0 ? level(finest) : coarser(); });
    else
    {
        coarser();
        level(finest);
    }
    return out;
}

/// |a - b|_M^2 summed over frames, after each frame.
std::vector<double> running_square(const ErrorWeights& weights, const Frames& a, const Frames& b)
{
    std::vector<double> out;
    for (std::size_t f = 0; f < a.size(); ++f)
    {
        const double d = distance_by_mass(weights, a[f], b[f]);
        out.push_back(d * d + (f > 0 ? out.back() : 0));
    }
    return out;
}

/// Differences of successive levels and the motion, over the frames up to each.
struct Convergence
{
    std::vector<std::vector<double>> square; ///< [level][frame]
    std::vector<double> moved;               ///< [frame], squared
    double order = 1;

    /// Over the motion, as e_traj is.
    double difference(std::size_t level, std::size_t frame) const
    {
        return moved[frame] == 0 ? 0 : std::sqrt(square[level][frame] / moved[frame]);
    }
    double observed(std::size_t level, std::size_t frame) const
    {
        return 0.5 * std::log2(square[level][frame] / square[level + 1][frame]);
    }
    bool verified(std::size_t frame) const
    {
        const std::size_t last = square.size() - 1;
        const auto good = [&](double p) { return std::abs(p - order) <= 0.15; };
        return difference(last, frame) < 1e-10 ||
               (difference(last, frame) < 1e-2 && good(observed(last - 1, frame)) &&
                good(observed(last - 2, frame)));
    }
    /// The end of the first unbroken stretch of verified frames: what passes later passes by chance.
    std::size_t verified_frames() const
    {
        std::size_t f = 1;
        while (f < moved.size() && !verified(f))
            ++f;
        while (f < moved.size() && verified(f))
            ++f;
        return verified(f - 1) ? f - 1 : 0;
    }
};

Convergence converge(const ErrorWeights& weights, const std::vector<Frames>& levels, double order)
{
    Convergence out;
    out.order = order;
    for (std::size_t l = 0; l + 1 < levels.size(); ++l)
        out.square.push_back(running_square(weights, levels[l], levels[l + 1]));
    const Frames still(levels.back().size(), levels.back().front());
    out.moved = running_square(weights, levels.back(), still);
    return out;
}

/// Observed orders, error estimates and the verdict, on the longest verified beginning.
void judge(const PhysicalModel& model, std::vector<Frames>& levels, DynamicReference& out)
{
    const ErrorWeights weights = error_weights(model);
    const Convergence all = converge(weights, levels, out.order);
    const std::size_t count = levels.back().size() - 1, last = all.square.size() - 1;
    out.verified_frames = all.verified_frames();
    out.verified = out.verified_frames == count;
    if (!out.verified)
    {
        const std::size_t f =
            out.verified_frames + 1; // the one that fails, not the last: errors cancel by chance
        out.reason = "only " + std::to_string(out.verified_frames) + " of " + std::to_string(count) +
                     " frames are verified: up to frame " + std::to_string(f) + " the observed orders are " +
                     shown(all.observed(last - 2, f), 3) + " and " + shown(all.observed(last - 1, f), 3) +
                     ", " + shown(out.order, 3) + " +- 0.15 is asked, and the last difference is " +
                     shown(all.difference(last, f), 3) + ", below 0.01 is asked";
    }
    const std::size_t judged = out.verified_frames > 0 ? out.verified_frames : count;
    for (std::size_t l = 0; l < last; ++l)
        out.orders.push_back(all.observed(l, judged));
    const double fraction = 1 / (std::exp2(out.order) - 1);
    out.error = all.difference(last, judged) * fraction;
    for (std::size_t f = 0; f <= out.verified_frames; ++f)
        out.errors.push_back(f == 0 || all.verified(f) ? all.difference(last, f) * fraction
                                                       : std::numeric_limits<double>::infinity());
    if (weights.diameter > 0) // a lone particle has no size
        for (std::size_t f = 0; f <= judged; ++f)
            out.largest_error = std::max(out.largest_error, fraction * largest_error(weights, levels[last][f],
                                                                                     levels[last + 1][f]));
    out.frames = std::move(levels.back());
}

} // namespace

DynamicReference solve_dynamic(const PhysicalModel& model, const DynamicOptions& options)
{
    DynamicReference out;
    Scheme scheme = options.scheme;
    if (scheme == Scheme::automatic)
        scheme = model.colliders.empty() ? Scheme::verlet : Scheme::symplectic_euler;
    out.order = scheme == Scheme::verlet ? 2 : 1;
    DynamicOptions wanted = options;
    wanted.levels = std::max(options.levels, 4u);
    const double duration = options.duration < 0 ? model.duration : options.duration;
    const auto frame_count = static_cast<std::size_t>(std::llround(duration / model.timestep));
    const std::uint64_t coarsest = coarsest_steps(model, options.safety);
    const std::size_t elements = element_cost(model);
    const double fine = std::exp2(wanted.levels - 1.0), coarse = static_cast<double>(coarsest);
    out.element_steps = static_cast<double>(elements * frame_count) * coarse * (2 * fine - 1);
    out.step = model.timestep / (coarse * fine);
    out.reason = refusal(model, options, out.element_steps);
    if (!out.reason.empty())
        return out;
    std::vector<Frames> levels = run_levels(model, scheme, coarsest, frame_count, wanted);
    judge(model, levels, out);
    return out;
}

} // namespace taut
