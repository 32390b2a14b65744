// Based on: cost-ascending racing over short runs (tune_race.cpp), guards by conservation laws.
// Departures: perturbed starts are pushes, not displacements: those would strain the stiffest springs, which
//   then shake faster than any frame rate shows (docs/tune.md).
#include "taut/report/tune.hpp"

#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "taut/world/separate_start.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace taut {
namespace {

using namespace tuning;

constexpr double kLooser[] = {0.02, 0.05, 0.1}; ///< bounds, where none is asked for and 1 % has no answer
constexpr double kFineEnough = 0.2; ///< of the bound: error of a reference by self-convergence that will do
constexpr double kMargin = 0.8;     ///< of the bound, at the last rung
constexpr double kHysteresis = 1.1; ///< the scene's own setting stays up to this price
constexpr std::size_t kFinalists = 3;
constexpr double kFarthest = 3; ///< finalists cost at most so many times the first
// Parts of TuneOptions::seconds: what a reference may take, and when the race changes and ends.
constexpr double kOwnReference = 0.5, kPerturbedReference = 0.1, kHalfRace = 0.55, kRace = 0.75,
                 kRaceCut = 0.8;

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
        references_.methods = options.methods.empty() ? methods_listed({"all"}) : options.methods;
        references_.kind = out_.kind;
        references_.rest_seconds = options.rest_seconds;
        references_.reference_steps = options.reference_steps;
        references_.reference_error = kFineEnough * options.error;
        const std::size_t wanted = cost::wanted_frames(scene_, references_);
        references_.frames = std::min(options.frames, wanted > 0 ? wanted : options.frames);
        if (out_.kind == CostKind::moving && options.kind == CostKind::automatic)
            out_.notes = never_rests_note(scene_);
    }

    TuneResult run()
    {
        if (!begin())
            return std::move(out_);
        race(priced());
        while (finalists_.empty() && !out_.interrupted && loosened())
            race_again();
        if (out_.bound != options_.error)
            out_.notes.push_back(loosened_note(out_, options_));
        if (!finalists_.empty())
            choose();
        else
            out_.why = none_of_tried(out_);
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
        bool fits = start.reference.verified && fit_reference(start, out_.bound);
        while (!fits && start.reference.verified && loosened())
            fits = fit_reference(start, out_.bound);
        out_.reference = start.reference;
        out_.metric = start.metric;
        std::tie(out_.answer, out_.why) = refusal(start, fits, out_, options_);
        if (!out_.why.empty())
            return false;
        if (out_.kind == CostKind::at_rest)
            return true;
        out_.frames = references_.frames = start.frames;
        if (start.frames < wanted)
            out_.notes.push_back(frames_note(start.frames, verified, wanted));
        return true;
    }

    /// The next bound that is tried; false: there is none.
    bool loosened()
    {
        const auto next = std::upper_bound(std::begin(kLooser), std::end(kLooser), out_.bound);
        if (!options_.loosen || by_volume() || next == std::end(kLooser))
            return false;
        out_.bound = *next;
        return true;
    }

    /// What fell by an error that the bound allows now, the cheapest first.
    void race_again()
    {
        end_ = 1;
        std::stable_sort(run_.begin(), run_.end(),
                         [](const Ran& a, const Ran& b) { return a.candidate.prior < b.candidate.prior; });
        for (const auto& [candidate, error] : std::vector<Ran>(run_))
        {
            const std::string block = settings_block(candidate.settings);
            const auto fell = std::find_if(out_.rejected.begin(), out_.rejected.end(), [&](const auto& r) {
                return settings_block(r.settings) == block;
            });
            const bool may = fell != out_.rejected.end() && fell->error.value_or(1) <= kMargin * out_.bound;
            if (!may || (error && !(*error <= own_bound(0))) || !left_out(candidate, 1).empty())
                continue;
            out_.rejected.erase(fell);
            try_candidate(candidate, error);
        }
    }

    /// `part` of the time is for its reference.
    Start start_of(const Scene& scene, double part)
    {
        if (by_volume())
            return make_volume_start(scene, references_.frames);
        CostOptions options = references_;
        const double begun = watch_.spent();
        options.spent = [this, begun, part] {
            const double mine = part * options_.seconds;
            return mine > 0 ? (watch_.spent() - begun) / mine : 1;
        };
        return make_start(out_.kind == CostKind::at_rest ? damped_to_rest(scene) : scene, device_, out_.kind,
                          options);
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
        std::vector<Candidate> all = designed(scene_, references_.methods, options_.precisions), out;
        const bool chosen = by_volume() || !options_.methods.empty();
        for (Candidate& candidate : all)
        {
            const std::string reason = filtered(scene_, facts_, traits, out_.bound, candidate);
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

    /// Halfway through its time without a find it goes for accuracy.
    void pass(std::vector<Candidate> all, std::vector<Candidate>* twins)
    {
        bool hurried = false;
        for (auto at = all.begin(); at != all.end(); ++at)
        {
            if (!hurried && finalists_.empty() && watch_.over(kHalfRace))
            {
                hurried = true;
                std::stable_sort(at, all.end(),
                                 [this](auto& a, auto& b) { return accuracy_of(b) < accuracy_of(a); });
            }
            if (twins && fell_in_float(out_.rejected, at->settings))
                twins->push_back(*at);
            else if (const std::string reason = left_out(*at); !reason.empty())
                out_.not_tried.push_back({at->settings, reason});
            else
                try_candidate(*at);
        }
    }

    /// Most substeps; then the method that the reference is refined from, which converges to it for sure.
    std::pair<std::uint32_t, bool> accuracy_of(const Candidate& candidate) const
    {
        const auto& by = starts_[0].reference.methods;
        return {candidate.settings.substeps, !by.empty() && candidate.settings.type == by[0]};
    }

    /// Why a candidate is not tried when the race ends at that part of the time; empty: it is.
    std::string left_out(const Candidate& candidate, double end = kRace)
    {
        const std::size_t done = out_.tried.size() + out_.not_tried.size();
        out_.interrupted = out_.interrupted || (options_.progress && !options_.progress(done, total_));
        if (out_.interrupted)
            return "interrupted";
        if (watch_.over(end))
            return "the time was up";
        if (finalists_.empty())
            return {};
        const double first = finalists_[0].candidate.prior;
        if (candidate.prior > kFarthest * first)
            return "dearer than what was found";
        if (candidate.own || finalists_.size() < (options_.prior_only ? 1 : kFinalists))
            return {};
        return candidate.prior >= first ? "dearer than what was found" : "enough others were found before it";
    }

    /// `known`: its error over all frames, where it need not be simulated again.
    void try_candidate(const Candidate& candidate, std::optional<double> known = std::nullopt)
    {
        try
        {
            const TrialRun trial = known ? TrialRun{known, 0, {}, false} : on_start(0, candidate.settings);
            if (trial.cut)
                return out_.not_tried.push_back({candidate.settings, "the time was up"});
            note_run(candidate, trial);
            if (!trial.reason.empty())
                return reject(candidate, "race", trial.reason, trial.error);
            const Verdict law = broken_law(scene_, device_, candidate.settings, out_.kind, starts_[0].frames,
                                           [this] { return watch_.over(1); });
            if (!law)
                return out_.not_tried.push_back({candidate.settings, "the time was up"});
            if (!law->empty())
                return reject(candidate, "guard", *law, trial.error);
            confirm(candidate, *trial.error);
        }
        catch (const Error& error) // what the plan let pass and the device refuses
        {
            if (error.code() != ErrorCode::limit && error.code() != ErrorCode::unsupported)
                throw;
            reject(candidate, "filter", error.what());
        }
    }

    void note_run(const Candidate& candidate, const TrialRun& trial)
    {
        const std::string block = settings_block(candidate.settings);
        if (std::any_of(run_.begin(), run_.end(),
                        [&](const Ran& r) { return settings_block(r.candidate.settings) == block; }))
            return; // again, with a looser bound
        run_.push_back({candidate, trial.frames == starts_[0].frames ? trial.error : std::nullopt});
        out_.tried.push_back(candidate.settings);
    }

    /// What is left of the bound on a start: with the margin, and less the reference's own error.
    double own_bound(std::size_t which) const
    {
        return kMargin * out_.bound - starts_[which].reference.error.value_or(0);
    }

    TrialRun on_start(std::size_t which, const MethodSettings& settings)
    {
        return run_trial(starts_[which], device_, settings, out_.kind, own_bound(which),
                         options_.rest_seconds, [this] { return watch_.over(end_); });
    }

    /// Two perturbed starts beside the scene's own; their references are made when first needed. What passed
    /// on the scene's own start has all the time that is left.
    void confirm(const Candidate& candidate, double predicted)
    {
        Finalist finalist{candidate, predicted, predicted, 1, std::nullopt};
        end_ = 1;
        for (std::size_t which = 1; which <= 2; ++which)
        {
            if (starts_.size() <= which)
                add_perturbed(static_cast<std::uint32_t>(which));
            if (!starts_[which].reference.verified)
                continue;
            const TrialRun trial = on_start(which, candidate.settings);
            if (trial.cut)
                continue;
            if (!trial.reason.empty())
                return reject(candidate, "perturbed", "start " + std::to_string(which) + ": " + trial.reason,
                              trial.error);
            finalist.confirmed = std::max(finalist.confirmed, *trial.error);
            ++finalist.starts;
        }
        finalists_.push_back(finalist);
    }

    /// A reference of the class of the scene's own, of R4 by its methods: others would bound another error.
    /// A start whose reference is not good enough is left out.
    void add_perturbed(std::uint32_t which)
    {
        const std::vector<MethodKind>& methods = starts_[0].reference.methods;
        references_.refined = methods;
        references_.coarsest = starts_[0].reference.substeps / 4; // the three levels that were good enough
        starts_.push_back(start_of(perturbed(scene_, which), kPerturbedReference));
        Start& start = starts_.back();
        if (start.reference.verified && fit_reference(start, out_.bound))
            return;
        out_.notes.push_back(perturbed_note(which, start.reference, out_.bound));
        start.reference.verified = false;
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
        if (!options_.prior_only && !watch_.over(1))
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
    std::vector<Ran> run_;      ///< simulated
    double end_ = kRaceCut;     ///< the part of the time at which a candidate's run is cut off
    std::vector<Finalist> finalists_;
    TuneResult out_;
};

} // namespace

TuneResult tune(const Scene& scene, std::shared_ptr<Device> device, const TuneOptions& options)
{
    check_input(scene, options);
    const bool done = std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const Body& body) { return body.mesh.positions.empty(); });
    const Scene resolved = with_start(done ? scene : resolve(scene));
    check_volumes(resolved, options);
    return Tuner(resolved, std::move(device), options).run();
}

} // namespace taut
