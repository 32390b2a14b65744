// What a search does to have an answer in its time: references no finer than they must be, runs to rest under
// damping, bounds that are loosened. Clocks are injected, so nothing depends on the machine's speed.
#include "support/catch.hpp"

#include "taut/report/cost_self.hpp"
#include "taut/report/tune_parts.hpp"
#include "tune_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

using namespace taut;
using namespace samples;

namespace {

/// A reference by self-convergence of one method, from coarse to fine.
cost::Refined climbed(const Scene& scene, double error, std::function<double()> spent = {})
{
    const PhysicalModel model = make_model(scene);
    const ErrorWeights weights = error_weights(model);
    CostOptions options;
    options.reference_error = error;
    options.spent = std::move(spent);
    const cost::CostInput input{scene, model, weights, options, serial()};
    return cost::climb(input, MethodKind::xpbd, 12);
}

} // namespace

TEST_CASE("a reference is refined until its error is the one asked for, and no further", "[tune]")
{
    const Scene scene = swinging(6, 200, 0.05);
    const cost::Refined rough = climbed(scene, 1e-2), fine = climbed(scene, 1e-3);
    REQUIRE((rough.reason.empty() && fine.reason.empty()));
    CHECK(rough.found.frames == 12);
    CHECK(fine.found.frames == 12);
    CHECK(rough.found.errors.back() <= 1e-2);
    CHECK(fine.found.errors.back() <= 1e-3);
    CHECK(rough.substeps < fine.substeps);
    // And the estimate is one of the distance from what is finer.
    const ErrorWeights weights = error_weights(make_model(scene));
    const double apart = *trajectory_error(weights, rough.finest, fine.finest);
    CHECK(apart <= rough.found.errors.back() + fine.found.errors.back());
}

TEST_CASE("when the time ends a reference, how many times it needs is said", "[tune]")
{
    double now = 0;
    const cost::Refined cut = climbed(swinging(6, 200, 0.05), 1e-9, [&now] { return now += 0.05; });
    CHECK(cut.found.frames < 6);
    CHECK(cut.reason.find("the time for the reference was up") != std::string::npos);
    CHECK(cut.times > 1);
    const cost::Refined whole = climbed(swinging(6, 200, 0.05), 1e-2);
    CHECK(whole.times == 0);
}

TEST_CASE("frames that do not converge may lie between when the rule says so", "[tune]")
{
    const ErrorWeights weights{{1}, 1};
    std::array<Frames, 3> level; // one point; at frame 2 the three runs stand in no order
    for (std::size_t l = 0; l < 3; ++l)
        for (std::size_t f = 0; f < 9; ++f)
        {
            const double t = static_cast<double>(f), h = 1.0 / static_cast<double>(1u << l);
            const double off = f == 2 ? (l == 1 ? 0 : 2e-2) : 1e-3 * h * t;
            level[l].push_back({{t + off, 0, 0}});
        }
    const cost::Refinement unbroken = cost::refine(weights, level[0], level[1], level[2]);
    CHECK(unbroken.frames == 1);
    cost::RefineRule rule;
    rule.lowest = 0.01;
    rule.rejoins = true;
    const cost::Refinement rejoined = cost::refine(weights, level[0], level[1], level[2], rule);
    CHECK(rejoined.frames == 8);
    CHECK(rejoined.errors.size() == 9);
}

TEST_CASE("damping to rest changes how long it takes and not where, and is left out where scenes remember",
          "[tune]")
{
    Scene scene = resting(6, 200, 0.05);
    scene.damping = 0.5;
    const Scene damped = tuning::damped_to_rest(scene);
    CHECK(damped.damping > 2);
    TuneOptions options = by_prior(0.01);
    options.methods = {MethodKind::xpbd};
    CostOptions references;
    references.rest_seconds = 60;
    const tuning::Start start = tuning::make_start(scene, serial(), CostKind::at_rest, references);
    tuning::Start fast = start;
    fast.scene = damped;
    MethodSettings settings;
    settings.substeps = 4;
    const auto trial = [&](const tuning::Start& from) {
        return tuning::run_trial(from, serial(), settings, CostKind::at_rest, 0.9, 60);
    };
    const tuning::TrialRun slow_trial = trial(start), fast_trial = trial(fast);
    REQUIRE((slow_trial.error && fast_trial.error));
    // Each may still wander by a tenth of its error.
    CHECK(std::abs(*slow_trial.error - *fast_trial.error) <=
          0.2 * std::max(*slow_trial.error, *fast_trial.error));
    Scene waxen = scene;
    waxen.bodies[0].material.plastic_yield = 0.1;
    CHECK(tuning::damped_to_rest(waxen).damping == 0.5);
    Scene floored = scene;
    floored.colliders.resize(1);
    CHECK(tuning::damped_to_rest(floored).damping == 0.5);
}

TEST_CASE("a bound that is not asked for is loosened to the first that has a setting, and that is said",
          "[tune]")
{
    TuneOptions options = by_prior(1e-12);
    options.methods = {MethodKind::xpbd};
    const TuneResult strict = tune(resting(6, 2000, 0.05), serial(), options);
    CHECK_FALSE(strict.found);
    CHECK(strict.bound == 1e-12);
    options.loosen = true;
    const TuneResult loose = tune(resting(6, 2000, 0.05), serial(), options);
    REQUIRE(loose.found);
    CHECK(loose.bound == 0.02);
    CHECK(loose.confirmed_error <= 0.8 * loose.bound);
    CHECK(std::any_of(loose.notes.begin(), loose.notes.end(),
                      [](const std::string& note) { return note.find("the bound is 2 %") == 0; }));
    CHECK(loose.tried.size() == strict.tried.size()); // those that it has run, each once
    const auto is_answer = [&](const TuneRejection& r) {
        return r.settings.substeps == loose.settings.substeps &&
               r.settings.iterations == loose.settings.iterations;
    };
    CHECK(std::none_of(loose.rejected.begin(), loose.rejected.end(), is_answer));
}

TEST_CASE("a guard that the time cuts off has no verdict", "[tune]")
{
    MethodSettings settings;
    const auto late = [] { return true; };
    CHECK_FALSE(
        tuning::broken_law(sheet(4, 500), serial(), settings, CostKind::moving, 18, late).has_value());
    CHECK(tuning::broken_law(sheet(4, 500), serial(), settings, CostKind::moving, 18) == "");
}

TEST_CASE("a reference is not cut to frames in which nothing has moved yet", "[tune]")
{
    tuning::Start start{sheet(4, 200), {}, {}, {}, "e_traj", 20};
    start.weights = {{1}, 1};
    for (std::size_t f = 0; f <= 20; ++f)
    {
        const double moved = f > 12 ? static_cast<double>(f) : 0;
        start.reference.frames.push_back({{moved, 0, 0}});
        start.reference.errors.push_back(f > 12 ? 0.005 : 0);
    }
    start.reference.error = 0.005;
    CHECK_FALSE(tuning::fit_reference(start, 0.01)); // 0.4 of it leaves the still ones
    CHECK(start.frames == 20);
    CHECK(tuning::fit_reference(start, 0.02));
    CHECK(start.frames == 20);
}
