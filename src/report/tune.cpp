// Based on: cost-ascending racing over short runs (tune_race.cpp), guards by conservation laws.
// Departures: perturbed starts are smooth waves, not noise: noise would shake the stiffest springs, which no
//   frame rate shows (docs/tune.md).
#include "taut/report/tune.hpp"

#include "taut/report/cost_design.hpp"
#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/report/volume.hpp"

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

using namespace tuning;

constexpr double kMargin = 0.8;     ///< of the bound, at the last rung
constexpr double kHysteresis = 1.1; ///< the scene's own setting stays up to this price
constexpr std::size_t kFinalists = 3;
constexpr double kFarthest = 3; ///< finalists cost at most so many times the first

void check_input(const Scene& scene, const TuneOptions& options)
{
    if (!(options.error > 0 && options.error < 1))
        throw Error(ErrorCode::bad_input, "the error to keep must be above 0 and below 1; 0.01 is 1 %.");
    if (options.precisions.empty())
        throw Error(ErrorCode::bad_input, "precisions to try must name float, double or both.");
    if (scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "bodies is empty: there is nothing to tune; add a body.");
    if (options.by == TuneCriterion::volume && options.kind == CostKind::at_rest)
        throw Error(ErrorCode::bad_input,
                    "an error of volume is the worst of all frames; leave out that it is at rest.");
}

void check_volumes(const Scene& resolved)
{
    if (!measure_volume(resolved, make_model(resolved).start).any)
        throw Error(ErrorCode::bad_input, "no body has a volume: an error of volume is one of bodies of "
                                          "tetrahedra, or of closed cloth that holds its volume.");
}

/// A candidate that passed everything.
struct Finalist
{
    Candidate candidate;
    double predicted = 0, confirmed = 0;
    std::size_t starts = 0;
    std::optional<cost::Timing> timing;
};

class Tuner
{
public:
    Tuner(const Scene& scene, std::shared_ptr<Device> device, const TuneOptions& options)
        : options_(options),
          device_(std::move(device)),
          scene_(scene)
    {
        out_.scene = scene_.name;
        out_.device = device_->info();
        out_.bound = options.error;
        out_.kind = by_volume()                           ? CostKind::moving
                    : options.kind == CostKind::automatic ? cost_kind(scene_)
                                                          : options.kind;
        if (by_volume())
            check_volumes(scene_);
        references_.methods = options.methods.empty() ? methods_listed({"all"}) : options.methods;
        references_.kind = out_.kind;
        references_.rest_seconds = options.rest_seconds;
        references_.reference_steps = options.reference_steps;
        const std::size_t wanted = cost::wanted_frames(scene_, references_);
        references_.frames = std::min(options.frames, wanted > 0 ? wanted : options.frames);
    }

    TuneResult run()
    {
        starts_.push_back(start_of(scene_));
        const Start& start = starts_[0];
        out_.reference = start.reference;
        out_.metric = start.metric;
        if (!start.reference.verified)
        {
            out_.notes.push_back("without a reference no error can be bounded");
            return std::move(out_);
        }
        if (out_.kind == CostKind::moving)
            out_.frames = references_.frames = start.frames;
        race(priced());
        if (!finalists_.empty())
            choose();
        return std::move(out_);
    }

private:
    bool by_volume() const { return options_.by == TuneCriterion::volume; }

    Start start_of(const Scene& scene)
    {
        return by_volume() ? make_volume_start(scene, references_.frames)
                           : make_start(scene, device_, out_.kind, references_);
    }

    void reject(const Candidate& candidate, const char* stage, std::string reason,
                std::optional<double> error = std::nullopt)
    {
        out_.rejected.push_back({candidate.settings, stage, std::move(reason), error});
    }

    /// All candidates that the filter lets pass, the cheapest first.
    std::vector<Candidate> priced()
    {
        const DeviceTraits traits =
            options_.prior_only ? limits_as_traits(*device_) : measure_traits(*device_);
        const SceneFacts facts = scene_facts(starts_[0].model, starts_[0].reference);
        std::vector<Candidate> all{{scene_.method, 0, true}}, out;
        for (const MethodKind kind : references_.methods)
            for (const Precision precision : options_.precisions)
                for (MethodSettings& settings : method_design(kind, precision, scene_.method))
                    if (settings_block(settings) != settings_block(scene_.method))
                        all.push_back({std::move(settings), 0, false});
        for (Candidate& candidate : all)
        {
            std::string reason = filtered(scene_, facts, traits, options_.error, candidate);
            if (reason.empty())
                out.push_back(std::move(candidate));
            else
                reject(candidate, "filter", std::move(reason));
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const Candidate& a, const Candidate& b) { return a.prior < b.prior; });
        return out;
    }

    void race(const std::vector<Candidate>& candidates)
    {
        const std::size_t wanted = options_.prior_only ? 1 : kFinalists;
        for (std::size_t i = 0; i < candidates.size(); ++i)
        {
            const Candidate& candidate = candidates[i];
            out_.interrupted =
                out_.interrupted || (options_.progress && !options_.progress(i, candidates.size()));
            const bool enough =
                finalists_.size() >= wanted ||
                (!finalists_.empty() && candidate.prior > kFarthest * finalists_[0].candidate.prior);
            const double most = finalists_.empty() ? 0 : kFarthest * finalists_[0].candidate.prior;
            if (out_.interrupted || (enough && !(candidate.own && candidate.prior <= most)))
                ++out_.not_tried;
            else
                try_candidate(candidate);
        }
    }

    void try_candidate(const Candidate& candidate)
    {
        try
        {
            const Lap lap = on_start(0, candidate.settings);
            if (!lap.reason.empty())
                return reject(candidate, "race", lap.reason, lap.error);
            for (const auto guard : {momentum_guard, rest_guard})
                if (std::string reason = guard(scene_, device_, candidate.settings); !reason.empty())
                    return reject(candidate, "guard", std::move(reason), lap.error);
            confirm(candidate, *lap.error);
        }
        catch (const Error& error) // what the plan let pass and the device refuses
        {
            if (error.code() != ErrorCode::limit && error.code() != ErrorCode::unsupported)
                throw;
            reject(candidate, "filter", error.what());
        }
    }

    /// The bound holds with the margin, and the reference's own error counts.
    Lap on_start(std::size_t which, const MethodSettings& settings)
    {
        const Start& start = starts_[which];
        const double bound = kMargin * options_.error - start.reference.error.value_or(0);
        return run_lap(start, device_, settings, out_.kind, bound, options_.rest_seconds);
    }

    /// Two perturbed starts beside the scene's own; their references are made when first needed.
    void confirm(const Candidate& candidate, double predicted)
    {
        Finalist finalist{candidate, predicted, predicted, 1, std::nullopt};
        for (std::size_t which = 1; which <= 2; ++which)
        {
            if (starts_.size() <= which)
                add_perturbed(static_cast<std::uint32_t>(which));
            if (!starts_[which].reference.verified)
                continue;
            const Lap lap = on_start(which, candidate.settings);
            if (!lap.reason.empty())
                return reject(candidate, "perturbed", "start " + std::to_string(which) + ": " + lap.reason,
                              lap.error);
            finalist.confirmed = std::max(finalist.confirmed, *lap.error);
            ++finalist.starts;
        }
        finalists_.push_back(finalist);
    }

    void add_perturbed(std::uint32_t which)
    {
        starts_.push_back(start_of(perturbed(scene_, which)));
        if (!starts_.back().reference.verified)
            out_.notes.push_back("perturbed start " + std::to_string(which) +
                                 " has no reference that can be trusted and is left out");
    }

    double price(const Finalist& finalist) const
    {
        if (!finalist.timing)
            return finalist.candidate.prior;
        return device_->info().hardware_gpu ? finalist.timing->median : finalist.timing->cpu;
    }

    void time_all()
    {
        const auto second = static_cast<std::size_t>(std::ceil(1 / scene_.timestep));
        const std::size_t frames = out_.frames > 0 ? std::min(out_.frames, second) : second;
        for (Finalist& finalist : finalists_)
        {
            cost::Trial trial(scene_, device_, finalist.candidate.settings);
            finalist.timing = trial.time(frames, options_.timing_seconds);
        }
    }

    void choose()
    {
        if (!options_.prior_only)
            time_all();
        std::stable_sort(finalists_.begin(), finalists_.end(),
                         [&](const Finalist& a, const Finalist& b) { return price(a) < price(b); });
        const auto own = std::find_if(finalists_.begin(), finalists_.end(),
                                      [](const Finalist& f) { return f.candidate.own; });
        out_.kept = own != finalists_.end() && price(*own) <= kHysteresis * price(finalists_[0]);
        const Finalist& best = out_.kept ? *own : finalists_[0];
        for (const Finalist& finalist : finalists_)
            if (&finalist != &best)
                reject(finalist.candidate, "price",
                       out_.kept ? "the scene's own setting is not 10 % dearer"
                                 : "a cheaper one keeps the bound",
                       finalist.confirmed);
        out_.found = true;
        out_.settings = best.candidate.settings;
        out_.predicted_error = best.predicted;
        out_.confirmed_error = best.confirmed;
        out_.starts = best.starts;
        out_.predicted_ms = best.candidate.prior;
        if (best.timing)
        {
            out_.ms = best.timing->median;
            if (!device_->info().hardware_gpu)
                out_.cpu_ms = best.timing->cpu;
        }
    }

    const TuneOptions& options_;
    std::shared_ptr<Device> device_;
    Scene scene_;
    CostOptions references_;
    std::vector<Start> starts_; ///< the scene's own, then perturbed ones
    std::vector<Finalist> finalists_;
    TuneResult out_;
};

} // namespace

TuneResult tune(const Scene& scene, std::shared_ptr<Device> device, const TuneOptions& options)
{
    check_input(scene, options);
    const bool done = std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.mesh.positions.empty(); });
    return Tuner(done ? scene : resolve(scene), std::move(device), options).run();
}

} // namespace taut
