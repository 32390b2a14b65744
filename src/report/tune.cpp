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
// Parts of TuneOptions::seconds: what a reference may take, and when the race changes and ends.
constexpr double kOwnReference = 0.35, kPerturbedReference = 0.1, kHalfRace = 0.6, kRace = 0.8;

void check_input(const Scene& scene, const TuneOptions& options)
{
    if (!(options.error > 0 && options.error < 1))
        throw Error(ErrorCode::bad_input, "the error to keep must be above 0 and below 1; 0.01 is 1 %.");
    if (options.precisions.empty())
        throw Error(ErrorCode::bad_input, "precisions to try must name float, double or both.");
    if (scene.bodies.empty())
        throw Error(ErrorCode::bad_input, "bodies is empty: there is nothing to tune; add a body.");
    if (!(options.seconds >= 0))
        throw Error(ErrorCode::bad_input, "the seconds of the search must be 0 or more.");
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
          watch_(options),
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
        if (out_.kind == CostKind::moving && options.kind == CostKind::automatic && held_still(scene_) &&
            scene_.colliders.empty())
            out_.notes.push_back("without damping the scene never rests: the error is that of its "
                                 "trajectory; with damping above 0 it would be that at rest");
    }

    TuneResult run()
    {
        if (!begin())
            return std::move(out_);
        race(priced());
        if (!finalists_.empty())
            choose();
        else
            say_none();
        return std::move(out_);
    }

private:
    bool by_volume() const { return options_.by == TuneCriterion::volume; }

    /// The scene's own start. False: nothing can be tried, and the result says why.
    bool begin()
    {
        starts_.push_back(start_of(scene_, kOwnReference));
        Start& start = starts_[0];
        const std::size_t verified = start.frames, wanted = references_.frames;
        const bool fits = start.reference.verified && fit_reference(start, options_.error);
        out_.reference = start.reference;
        out_.metric = start.metric;
        if (!fits)
        {
            out_.answer = start.reference.verified ? TuneAnswer::poor_reference : TuneAnswer::no_reference;
            out_.why =
                start.reference.verified ? poor_reference(out_, options_) : no_reference(out_, options_);
            return false;
        }
        if (out_.kind == CostKind::at_rest)
            return true;
        out_.frames = references_.frames = start.frames;
        if (start.frames < wanted)
            out_.notes.push_back(frames_note(start.frames, verified, wanted));
        return true;
    }

    /// `part` of the time is for its reference.
    Start start_of(const Scene& scene, double part)
    {
        if (by_volume())
            return make_volume_start(scene, references_.frames);
        CostOptions options = references_;
        const double begun = watch_.spent();
        options.enough = [&, begun](double share) {
            return watch_.spent() - begun >= share * part * options_.seconds;
        };
        return make_start(scene, device_, out_.kind, options);
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
        facts_ = scene_facts(starts_[0].model, starts_[0].reference);
        std::vector<Candidate> all{{scene_.method, 0, true}}, out;
        for (const MethodKind kind : references_.methods)
            for (const Precision precision : options_.precisions)
                for (MethodSettings& settings : method_design(kind, precision, scene_.method))
                    if (settings_block(settings) != settings_block(scene_.method))
                        all.push_back({std::move(settings), 0, false});
        const bool chosen = by_volume() || !options_.methods.empty();
        for (Candidate& candidate : all)
        {
            const std::string reason = filtered(scene_, facts_, traits, options_.error, candidate);
            const std::string other = other_material(facts_, candidate.settings);
            if (!reason.empty())
                reject(candidate, "filter", reason);
            else if (!other.empty() && !chosen && candidate.settings.type != scene_.method.type)
                reject(candidate, "material", other + "; name it in --methods to try it");
            else
                out.push_back(std::move(candidate));
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const Candidate& a, const Candidate& b) { return a.prior < b.prior; });
        return out;
    }

    /// From the cheapest on. What fell in float is tried in double only when nothing else is found.
    void race(std::vector<Candidate> all)
    {
        std::vector<Candidate> twins;
        total_ = all.size();
        pass(std::move(all), &twins);
        if (finalists_.empty())
            return pass(std::move(twins), nullptr);
        for (const Candidate& twin : twins)
            out_.not_tried.push_back({twin.settings, "it fell in float"});
    }

    /// Halfway through its time without a find it goes for accuracy: most substeps first.
    void pass(std::vector<Candidate> all, std::vector<Candidate>* twins)
    {
        bool hurried = false;
        for (auto at = all.begin(); at != all.end(); ++at)
        {
            if (!hurried && finalists_.empty() && watch_.over(kHalfRace))
            {
                hurried = true;
                std::stable_sort(at, all.end(), [](const Candidate& a, const Candidate& b) {
                    return a.settings.substeps > b.settings.substeps;
                });
            }
            if (twins && fell_in_float(at->settings))
                twins->push_back(*at);
            else if (const std::string reason = left_out(*at); !reason.empty())
                out_.not_tried.push_back({at->settings, reason});
            else
                try_candidate(*at);
        }
    }

    /// Why a candidate is not tried; empty: it is.
    std::string left_out(const Candidate& candidate)
    {
        const std::size_t done = out_.tried.size() + out_.not_tried.size();
        out_.interrupted = out_.interrupted || (options_.progress && !options_.progress(done, total_));
        if (out_.interrupted)
            return "interrupted";
        if (watch_.over(kRace))
            return "the time was up";
        if (finalists_.empty())
            return {};
        const double first = finalists_[0].candidate.prior;
        if (candidate.prior > kFarthest * first)
            return "dearer than what was found";
        const std::size_t wanted = options_.prior_only ? 1 : kFinalists;
        if (candidate.own || finalists_.size() < wanted)
            return {};
        return candidate.prior >= first ? "dearer than what was found" : "enough others were found before it";
    }

    static bool was_run(const TuneRejection& r) { return r.stage != "filter" && r.stage != "material"; }
    /// A step that diverges in float does so in double too: it counts, though it has no error.
    bool fell_in_float(const MethodSettings& settings) const
    {
        MethodSettings twin = settings;
        twin.precision = "float";
        const std::string block = settings_block(twin);
        return settings.precision == "double" &&
               std::any_of(out_.rejected.begin(), out_.rejected.end(), [&](const TuneRejection& r) {
                   return was_run(r) && settings_block(r.settings) == block;
               });
    }

    void try_candidate(const Candidate& candidate)
    {
        try
        {
            const Lap lap = on_start(0, candidate.settings);
            if (lap.cut)
                return out_.not_tried.push_back({candidate.settings, "the time was up"});
            out_.tried.push_back(candidate.settings);
            if (!lap.reason.empty())
                return reject(candidate, "race", lap.reason, lap.error);
            if (std::string law = broken_law(scene_, device_, candidate.settings, out_.kind); !law.empty())
                return reject(candidate, "guard", std::move(law), lap.error);
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
        return run_lap(start, device_, settings, out_.kind, bound, options_.rest_seconds,
                       [this] { return watch_.over(1); });
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
            if (lap.cut)
                continue;
            if (!lap.reason.empty())
                return reject(candidate, "perturbed", "start " + std::to_string(which) + ": " + lap.reason,
                              lap.error);
            finalist.confirmed = std::max(finalist.confirmed, *lap.error);
            ++finalist.starts;
        }
        finalists_.push_back(finalist);
    }

    /// Of the class that the scene's own reference has: another one would bound another error. A start whose
    /// reference is not good enough is left out.
    void add_perturbed(std::uint32_t which)
    {
        const std::vector<MethodKind>& methods = starts_[0].reference.methods;
        references_.self_reference = !methods.empty();
        references_.refined = methods;
        starts_.push_back(start_of(perturbed(scene_, which), kPerturbedReference));
        Start& start = starts_.back();
        if (start.reference.verified && fit_reference(start, options_.error))
            return;
        out_.notes.push_back(perturbed_note(which, start.reference, options_.error));
        start.reference.verified = false;
    }

    void say_none()
    {
        out_.answer = TuneAnswer::none_of_tried;
        out_.why = none_of_tried(out_);
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
            finalist.timing = trial.time(frames, std::min(options_.timing_seconds, 0.03 * options_.seconds));
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
        out_.answer = TuneAnswer::found;
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
        if (out_.starts == 1)
            out_.notes.push_back(
                "no perturbed start confirms the setting: it is confirmed on the scene's own");
        if (const std::string other = other_material(facts_, out_.settings); !other.empty())
            out_.notes.push_back("the setting is of another material: " + other);
    }

    const TuneOptions& options_;
    std::shared_ptr<Device> device_;
    Watch watch_;
    Scene scene_;
    SceneFacts facts_;
    CostOptions references_;
    std::size_t total_ = 0;     ///< candidates that the filter let pass
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
