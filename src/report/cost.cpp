// Runs a study: reference, then every setting.
// Based on: the work-precision protocol of SciML's DiffEqDevTools (a failed solve is a gap); warm-up,
//   repetitions, median and least as docs/cost.md says.
// Departures: none.
#include "taut/report/cost.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/report/cost_design.hpp"
#include "taut/report/cost_reference.hpp"
#include "taut/report/cost_self.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/pose.hpp"
#include "taut/world/separate_start.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

using cost::Motion;
using cost::Trial;

void check_input(const Scene& scene, const CostOptions& options)
{
    const auto bad = [](const std::vector<std::uint32_t>& list) {
        return list.empty() ||
               std::any_of(list.begin(), list.end(), [](auto n) { return n < 1 || n > 1000; });
    };
    if (bad(options.substeps))
        throw Error(ErrorCode::bad_input, "substeps to try must be a list of numbers from 1 to 1000.");
    if (bad(options.iterations))
        throw Error(ErrorCode::bad_input, "iterations to try must be a list of numbers from 1 to 1000.");
    if (options.methods.empty())
        throw Error(ErrorCode::bad_input, "methods to try must name at least one.");
    if (options.precisions.empty())
        throw Error(ErrorCode::bad_input, "precisions to try must name float, double or both.");
    if (!(options.rest_seconds >= 1 && options.rest_seconds <= 1e6))
        throw Error(ErrorCode::bad_input, "the seconds until rest must be from 1 to 1000000.");
    if (!(options.rest_tolerance >= 0 && options.rest_tolerance <= 0.1))
        throw Error(ErrorCode::bad_input, "the tolerance of rest must be from 0 to 0.1.");
    if (options.linear_tolerance && !(*options.linear_tolerance > 0 && *options.linear_tolerance < 1))
        throw Error(ErrorCode::bad_input, "the tolerance of linear solves must be above 0 and below 1.");
    if (options.repeats < 1 || options.repeats > 1000)
        throw Error(ErrorCode::bad_input, "repeats must be from 1 to 1000.");
    if (scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "bodies is empty: there is nothing to measure; add a body.");
}

Scene resolved(const Scene& scene)
{
    const bool done = std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.mesh.positions.empty(); });
    return with_start(done ? scene : resolve(scene));
}

/// Whether a program has the method at all.
bool built(MethodKind kind)
{
    try
    {
        find_method(kind);
        return true;
    }
    catch (const Error&)
    {
        return false;
    }
}

std::vector<MethodSettings> settings_to_try(const Scene& scene, const CostOptions& options)
{
    std::vector<MethodSettings> out;
    for (const MethodKind kind : options.methods)
        for (const Precision precision : options.precisions)
        {
            std::vector<MethodSettings> more = options.designed
                                                   ? method_design(kind, precision, scene.method)
                                                   : method_product(kind, precision, options, scene.method);
            if (!built(kind))
                more.resize(1); // one gap says it
            for (MethodSettings& settings : more)
                settings.linear_tolerance = options.linear_tolerance.value_or(settings.linear_tolerance);
            out.insert(out.end(), more.begin(), more.end());
        }
    return out;
}

/// A setting that a method or a device cannot do is a gap; a lost device is not.
bool is_refusal(ErrorCode code)
{
    switch (code)
    {
    case ErrorCode::bad_input:
    case ErrorCode::no_device:
    case ErrorCode::device_lost:
    case ErrorCode::out_of_memory:
    case ErrorCode::io:
    case ErrorCode::kernel_compilation: return false;
    default: return true;
    }
}

class Study
{
public:
    Study(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options)
        : options_(options),
          device_(std::move(device)),
          scene_(resolved(scene)),
          model_(make_model(scene_)),
          weights_(error_weights(model_))
    {
        out_.scene = scene_.name;
        out_.device = device_->info();
        out_.kind = options.kind == CostKind::automatic ? cost_kind(scene_) : options.kind;
        out_.vertices = model_.mass.size();
        out_.constraints = model_.springs.size() + model_.hinges.size() + model_.plates.size() +
                           model_.volumes.size() + model_.solids.size() + model_.surfaces.size();
        out_.timestep = scene_.timestep;
        out_.basis = options.basis;
        out_.rest_tolerance = options.rest_tolerance;
        take_continuum();
        if (!at_rest() && cost::wanted_frames(scene_, options) == 0)
            throw Error(
                ErrorCode::bad_input,
                "duration is shorter than one time step: nothing moves; lengthen it or ask for frames.");
    }

    CostStudy run()
    {
        const cost::CostInput input{scene_, model_, weights_, options_, device_};
        out_.reference = at_rest() ? cost::reference_at_rest(input) : cost::reference_of_motion(input);
        if (!at_rest() && out_.reference.verified)
            out_.frames = out_.reference.frames.size() - 1;
        choose_metric();
        compare_places_of_rest();
        trace_reference(input);
        facts_ = tuning::scene_facts(model_, out_.reference);
        const std::vector<MethodSettings> all = settings_to_try(scene_, options_);
        for (const MethodSettings& settings : all)
        {
            out_.interrupted =
                out_.interrupted || (options_.progress && !options_.progress(out_.points.size(), all.size()));
            out_.points.push_back(point(settings));
        }
        time_in_turns();
        if (options_.progress)
            options_.progress(all.size(), all.size());
        rank(out_);
        return std::move(out_);
    }

private:
    void take_continuum()
    {
        if (options_.continuum && !at_rest())
            throw Error(ErrorCode::bad_input,
                        "a continuum needs a scene that comes to rest: held by pins that "
                        "stand still, without colliders, with damping; or compare the "
                        "state at rest (--static).");
        out_.continuum = options_.continuum;
        if (out_.has_continuum() && out_.continuum->positions.size() != model_.mass.size())
            throw Error(ErrorCode::bad_input, "the continuum has " +
                                                  std::to_string(out_.continuum->positions.size()) +
                                                  " vertices for " + std::to_string(model_.mass.size()) +
                                                  ": it is that of another scene.");
    }

    bool at_rest() const { return out_.kind == CostKind::at_rest; }

    void choose_metric()
    {
        const auto& frames = out_.reference.frames;
        const bool moves = std::any_of(frames.begin(), frames.end(), [&](const auto& x) {
            return distance_by_mass(weights_, x, frames[0]) > 0;
        });
        out_.metric = !moves && !frames.empty() ? "e_L" : at_rest() ? "e_disp" : "e_traj";
        if (out_.metric == "e_L")
            out_.reference.error = out_.reference.error_l;
    }

    /// A scene with several equilibria may have the one as its reference and another one in the continuum.
    void compare_places_of_rest()
    {
        if (!out_.has_continuum() || !out_.reference.verified)
            return;
        const auto off = displacement_error(weights_, out_.continuum->own, out_.reference.frames.back(),
                                            out_.reference.frames.front());
        if (!off || *off > 0.1 * out_.continuum->mesh_error)
            out_.continuum->reason = "the reference comes to rest elsewhere on the same mesh";
    }

    /// The finest run of the reference once more, for what its surfaces do to each other.
    void trace_reference(const cost::CostInput& input)
    {
        const CostReference& reference = out_.reference;
        if (!reference.verified || reference.methods.empty() || !wants_contact(scene_))
            return;
        Trial trial(scene_, cost::double_device(input),
                    cost::fine_settings(input, reference.methods[0], reference.substeps));
        run_traced(trial, {weights_, nullptr, options_.rest_seconds});
        if (trial.contacts()->impulse > 0)
            out_.contact = trial.contacts();
    }

    /// To the end of a study, adding up contacts: of what moves on the way, at rest for a second more.
    Motion run_traced(Trial& trial, const cost::RestRule& rule) const
    {
        if (!at_rest())
        {
            trial.trace_contacts();
            return trial.trajectory(out_.frames);
        }
        Motion motion = trial.settle(rule);
        trial.trace_contacts(static_cast<std::size_t>(std::ceil(1 / scene_.timestep)));
        return motion;
    }

    CostPoint point(const MethodSettings& settings)
    {
        CostPoint out;
        out.method = to_string(settings.type);
        out.substeps = settings.substeps;
        out.iterations = settings.iterations;
        out.precision = settings.precision;
        out.settings = settings;
        out.other_material = tuning::other_material(facts_, settings);
        out.sweeps = static_cast<double>(out.substeps) * out.iterations / scene_.timestep;
        if (out_.interrupted)
        {
            out.status = Status::interrupted;
            out.reason = "interrupted";
        }
        else if (!out_.reference.verified)
            out.reason = "no reference to measure the error against";
        else if (out.precision == Precision::float64 && !device_->limits().float64)
            out.reason = "the device has no double";
        else
            try_setting(out);
        return out;
    }

    void try_setting(CostPoint& out)
    {
        try
        {
            auto trial = std::make_unique<Trial>(scene_, device_, out.settings);
            measure_error(*trial, out);
            out.sweeps = trial->sweeps();
            if (out.error)
                timed_.push_back({out_.points.size(), std::move(trial), {}});
        }
        catch (const Error& error)
        {
            if (!is_refusal(error.code()))
                throw;
            out.refused = to_string(error.code());
            out.reason = error.what();
        }
    }

    void measure_error(Trial& trial, CostPoint& out)
    {
        const std::vector<glm::dvec3>& goal = out_.reference.frames.back();
        const bool displaced = out_.metric == "e_disp";
        const cost::RestRule rule{weights_,  &goal, options_.rest_seconds,
                                  displaced, {},    options_.rest_tolerance};
        const Motion motion = out_.contact ? run_traced(trial, rule)
                              : at_rest()  ? trial.settle(rule)
                                           : trial.trajectory(out_.frames);
        out.simulated_seconds = static_cast<double>(motion.steps) * scene_.timestep;
        out.status = motion.status;
        out.reason = motion.reason;
        if (!out.reason.empty())
            return;
        const Frames& reference = out_.reference.frames;
        out.error_l = weights_.diameter > 0 ? largest_error(weights_, motion.frames.back(), goal) : 0;
        if (out_.metric == "e_L")
            out.error = out.error_l;
        else if (at_rest())
            out.error = displacement_error(weights_, motion.frames.back(), goal, reference.front());
        else
            out.error = trajectory_error(weights_, motion.frames, reference);
        if (out_.contact)
            out.contact = cost::contact_error(*trial.contacts(), *out_.contact);
        if (out_.has_continuum())
            out.error_continuum = displacement_error(weights_, motion.frames.back(),
                                                     out_.continuum->positions, reference.front());
        for (std::optional<double>* error : {&out.error, &out.error_continuum})
            if (displaced && *error)
                **error += motion.wander / distance_by_mass(weights_, goal, reference.front());
        if (out_.metric == "e_traj" && reference.size() > 6)
            out.error_smoothed = trajectory_error(weights_, smoothed(motion.frames), smoothed(reference));
    }

    /// Every setting once, then every setting again: what the machine does beside it falls on all alike. A
    /// repetition is at most one simulated second, from the start on.
    void time_in_turns()
    {
        const auto second = static_cast<std::size_t>(std::ceil(1 / scene_.timestep));
        const std::size_t frames = at_rest() ? second : std::min(second, out_.frames);
        for (Timed& one : timed_)
            one.trial->warm_up(frames);
        for (std::size_t round = 0; round < options_.repeats; ++round)
            for (Timed& one : timed_)
            {
                const bool more = round == 0 || one.watch.spent < 1e3 * options_.timing_seconds;
                const bool stopped =
                    options_.progress && !options_.progress(out_.points.size(), out_.points.size());
                out_.interrupted = out_.interrupted || stopped;
                if (more && (!out_.interrupted || round == 0))
                    one.trial->repeat(frames, one.watch);
            }
        for (const Timed& one : timed_)
            set_timing(one.watch.timing(), out_.points[one.point]);
    }

    void set_timing(const cost::Timing& time, CostPoint& out) const
    {
        out.ms = time.median;
        out.ms_least = time.least;
        out.ms_low = time.low;
        out.ms_high = time.high;
        out.repetitions = time.repetitions;
        if (device_->info().hardware_gpu)
            return;
        out.cpu_ms = time.cpu;
        out.cpu_low = time.cpu_low;
        out.cpu_high = time.cpu_high;
    }

    /// A setting that has an error.
    struct Timed
    {
        std::size_t point;
        std::unique_ptr<Trial> trial;
        cost::Stopwatch watch;
    };

    const CostOptions& options_;
    std::shared_ptr<Device> device_;
    Scene scene_;
    PhysicalModel model_;
    tuning::SceneFacts facts_;
    ErrorWeights weights_;
    std::vector<Timed> timed_;
    CostStudy out_;
};

} // namespace

bool CostStudy::sound() const
{
    return std::any_of(points.begin(), points.end(), [](const CostPoint& p) { return p.error.has_value(); });
}

bool held_still(const Scene& scene)
{
    const auto held = [](const Body& body) {
        return !body.pins.empty() && std::none_of(body.pins.begin(), body.pins.end(), is_led);
    };
    return std::all_of(scene.bodies.begin(), scene.bodies.end(), held);
}

CostKind cost_kind(const Scene& scene)
{
    return held_still(scene) && scene.colliders.empty() && scene.damping > 0 ? CostKind::at_rest
                                                                             : CostKind::moving;
}

CostStudy run_cost(const Scene& scene, std::shared_ptr<Device> device, const CostOptions& options)
{
    check_input(scene, options);
    return Study(scene, std::move(device), options).run();
}

} // namespace taut
