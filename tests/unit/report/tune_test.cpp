// The search for the cheapest setting: that what it promises holds, and each of its parts. Prices are priors
// here, so nothing depends on the machine's speed.
#include "support/catch.hpp"

#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "tune_samples.hpp"

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>

using namespace taut;
using namespace samples;

namespace {

/// The error of the setting, measured by a study of its own.
double measured(const Scene& scene, const TuneResult& result)
{
    Scene same = scene;
    same.method = result.settings;
    CostOptions options;
    options.methods = {result.settings.type};
    options.substeps = {result.settings.substeps};
    options.iterations = {result.settings.iterations};
    options.precisions = {Precision::float32};
    options.frames = result.frames;
    options.timing_seconds = 0;
    options.rest_seconds = 10;
    options.reference_steps = 2e8;
    const CostStudy study = run_cost(same, serial(), options);
    REQUIRE(study.points.size() == 1);
    INFO(study.points[0].reason);
    REQUIRE(study.points[0].error.has_value());
    return *study.points[0].error;
}

} // namespace

TEST_CASE("on six scenes of different stiffness and size the confirmed error is within the bound", "[tune]")
{
    struct Case
    {
        Scene scene;
        double bound;
    };
    const Case cases[] = {{resting(6, 200, 0.05), 0.01},   {resting(12, 5000, 0.02), 0.1},
                          {resting(4, 50, 0.01), 0.01},    {swinging(6, 200, 0.05), 0.05},
                          {swinging(10, 2000, 0.02), 0.1}, {sheet(6, 20), 0.1}};
    for (const Case& c : cases)
    {
        const TuneResult result = tune(c.scene, serial(), by_prior(c.bound));
        INFO(c.scene.name << ", " << result.reference.text << " " << settings_text(result.settings));
        REQUIRE(result.found);
        CHECK(result.confirmed_error <= 0.8 * c.bound);
        CHECK(result.predicted_error <= result.confirmed_error);
        // A start confirms, or has no reference of the class of the scene's own: then a note says so.
        const auto left_out = std::count_if(result.notes.begin(), result.notes.end(), [](const auto& note) {
            return note.find("perturbed start") == 0;
        });
        CHECK(result.starts >= 2);
        CHECK(result.starts + static_cast<std::size_t>(left_out) == 3);
        CHECK(measured(c.scene, result) <= c.bound);
        CHECK_FALSE(result.ms.has_value()); // nothing was timed
        CHECK(result.predicted_ms > 0);
    }
}

TEST_CASE("of what holds the bound the cheapest is taken, by the prior the same every time", "[tune]")
{
    const Scene scene = resting(6, 200, 0.05);
    const TuneResult loose = tune(scene, serial(), by_prior(0.2));
    const TuneResult tight = tune(scene, serial(), by_prior(0.005));
    REQUIRE((loose.found && tight.found));
    CHECK(loose.predicted_ms <= tight.predicted_ms);
    const TuneResult again = tune(scene, serial(), by_prior(0.005));
    CHECK(settings_block(again.settings) == settings_block(tight.settings));
    CHECK(again.confirmed_error == tight.confirmed_error);
}

TEST_CASE("a bound that nothing holds is answered with none, and with what each setting lacked", "[tune]")
{
    TuneOptions options = by_prior(1e-9);
    options.methods = {MethodKind::pbd};
    options.kind = CostKind::at_rest; // whose reference has no error to speak of
    const TuneResult result = tune(resting(6, 200, 0.05), serial(), options);
    CHECK_FALSE(result.found);
    CHECK(result.answer == TuneAnswer::none_of_tried);
    CHECK(result.why.find("None of the " + std::to_string(result.tried.size()) + " settings tried") == 0);
    CHECK(result.tried.size() >= 10);
    CHECK(result.rejected.size() >= 10);
    for (const TuneRejection& rejection : result.rejected)
        CHECK_FALSE(rejection.reason.empty());
    const auto json = nlohmann::json::parse(tune_json(result));
    CHECK(json["method"].is_null());
    CHECK(json["confirmed_error"].is_null());
    CHECK(json["rejected"].size() == result.rejected.size());
    CHECK(json["tried"].size() == result.tried.size());
    CHECK(json["tried"][0]["type"] == "pbd");
    CHECK(json["answer"] == "none_of_tried");
}

TEST_CASE("a method that is not there or refuses the scene is rejected before anything runs", "[tune]")
{
    TuneOptions options = by_prior(0.1);
    options.methods = {MethodKind::mass_spring, MethodKind::xpbd};
    // Explicit steps are stable from 235 substeps on, more than the design has.
    const TuneResult result = tune(resting(6, 2e5, 0.001), serial(), options);
    INFO(result.reference.text);
    REQUIRE(result.reference.verified);
    for (const TuneRejection& rejection : result.rejected)
        if (rejection.settings.type == MethodKind::mass_spring)
            CHECK(rejection.stage == "filter");
    CHECK(std::any_of(result.rejected.begin(), result.rejected.end(),
                      [](const TuneRejection& r) { return r.settings.type == MethodKind::mass_spring; }));
    CHECK(result.settings.type != MethodKind::mass_spring);
}

TEST_CASE("the scene's own setting stays while nothing is 10 % cheaper", "[tune]")
{
    Scene scene = resting(6, 200, 0.05);
    const TuneResult first = tune(scene, serial(), by_prior(0.01));
    REQUIRE(first.found);
    scene.method = first.settings;
    const TuneResult second = tune(scene, serial(), by_prior(0.01));
    REQUIRE(second.found);
    CHECK(second.kept);
    CHECK(settings_block(second.settings) == settings_block(first.settings));
}

TEST_CASE("with timing the winner has a measured time beside the predicted one", "[tune]")
{
    TuneOptions options = by_prior(0.1);
    options.prior_only = false;
    options.timing_seconds = 0;
    options.methods = {MethodKind::xpbd};
    const TuneResult result = tune(resting(6, 200, 0.05), serial(), options);
    REQUIRE(result.found);
    REQUIRE(result.ms.has_value());
    CHECK(*result.ms > 0);
    REQUIRE(result.cpu_ms.has_value());
    const auto json = nlohmann::json::parse(tune_json(result));
    CHECK(json["ms_per_simulated_second"].get<double>() == *result.ms);
    CHECK(json["method"]["type"] == "xpbd");
}

TEST_CASE("the filter knows mass ratios, steps longer than a spring, and too many constraints", "[tune]")
{
    const Scene scene = resting(6, 200, 0.05);
    const DeviceTraits traits;
    tuning::Candidate candidate;
    candidate.settings.type = MethodKind::xpbd;
    tuning::SceneFacts facts{0, 0.1, 1e4, 18, 6, 0};
    CHECK(tuning::filtered(scene, facts, traits, 0.005, candidate).find("mass ratio") == 0);
    CHECK(tuning::filtered(scene, facts, traits, 0.05, candidate).empty());
    CHECK(candidate.prior > 0);
    candidate.settings.type = MethodKind::implicit_constraints;
    candidate.settings.substeps = 1;
    facts = {30, 0.1, 1, 18, 6, 0};
    CHECK(tuning::filtered(scene, facts, traits, 0.05, candidate).find("shortest spring") !=
          std::string::npos);
    facts = {0, 0.1, 1, 5, 6, 6};
    CHECK(tuning::filtered(scene, facts, traits, 0.05, candidate).find("without compliance") !=
          std::string::npos);
    candidate.settings.type = MethodKind::xpbd;
    candidate.settings.precision = Precision::float64;
    DeviceTraits single;
    single.float64 = false;
    CHECK(tuning::filtered(scene, facts, single, 0.05, candidate) == "the device has no double");
}

TEST_CASE("a scene's facts are its speed, shortest spring, mass ratio and freedom", "[tune]")
{
    Scene scene = test::chain(4, 100, 0.05, 0.4);
    scene.bodies[0].vertex_masses.back() = 5;
    const PhysicalModel model = make_model(scene);
    CostReference reference;
    reference.frames.assign(3, model.start);
    reference.frames[2][4].y -= 0.05;
    const tuning::SceneFacts facts = tuning::scene_facts(model, reference);
    CHECK(facts.largest_speed == Approx(0.05 / scene.timestep));
    CHECK(facts.shortest == Approx(0.1));
    CHECK(facts.mass_ratio == Approx(100));
    CHECK(facts.free_coordinates == 12);
    CHECK(facts.rigid == 0);
}

TEST_CASE("more substeps have a higher prior, in proportion to dispatches and bytes", "[tune]")
{
    Scene scene = sheet(8, 100);
    DeviceTraits traits;
    const auto prior = [&](std::uint32_t substeps) {
        scene.method.substeps = substeps;
        return tuning::prior_ms(make_plan(scene, traits), traits);
    };
    const double one = prior(1), two = prior(2), four = prior(4);
    CHECK(one > 0);
    CHECK(four - two == Approx(2 * (two - one)));
}

TEST_CASE("XPBD passes the guards: free fall keeps momentum, rest stays at rest", "[tune]")
{
    MethodSettings settings;
    for (const std::uint32_t substeps : {1u, 10u})
    {
        settings.substeps = substeps;
        CHECK(tuning::momentum_guard(sheet(6, 500), serial(), settings, 18) == "");
        CHECK(tuning::rest_guard(sheet(6, 500), serial(), settings, 18) == "");
    }
}

TEST_CASE("bodies that start within each other's thickness pass the guard of rest", "[tune]")
{
    Scene scene;
    Body body;
    body.shape.cells = {6, 6};
    body.contact.thickness = 0.02;
    scene.bodies = {body, body};
    scene.contact.between = true;
    scene.bodies[1].transform.translate = {0, 0, 0.001};
    scene = resolve(scene);
    MethodSettings settings;
    settings.substeps = 10;
    CHECK(tuning::rest_guard(scene, serial(), settings, 18) == "");
    scene.gravity = {0, 0, 0}; // they do push: else the guard would have nothing to leave out
    World apart(scene, serial());
    const std::vector<glm::dvec3> before = apart.positions();
    for (int step = 0; step < 6; ++step)
        apart.step();
    const std::vector<glm::dvec3> after = apart.positions();
    double furthest = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
        furthest = std::max(furthest, glm::distance(after[v], before[v]));
    CHECK(furthest > 1e-3);
}

TEST_CASE("a perturbed start pushes what is free, the same every time, and displaces nothing", "[tune]")
{
    const Scene scene = sheet(8, 100);
    const PhysicalModel before = make_model(scene);
    const PhysicalModel one = make_model(tuning::perturbed(scene, 1));
    const PhysicalModel again = make_model(tuning::perturbed(scene, 1));
    const PhysicalModel two = make_model(tuning::perturbed(scene, 2));
    const double push = 1e-4 * before.diameter / scene.timestep; // of the diagonal a frame
    for (std::size_t i = 0; i < before.mass.size(); ++i)
    {
        CHECK(one.start[i] == before.start[i]);
        CHECK(one.velocity[i] == again.velocity[i]);
        if (before.pinned[i])
            CHECK(one.velocity[i] == before.velocity[i]);
        else
        {
            CHECK(glm::distance(one.velocity[i], before.velocity[i]) == Approx(push));
            CHECK(glm::distance(one.velocity[i], two.velocity[i]) > 0.01 * push);
        }
    }
}

TEST_CASE("a trial ends at the first rung whose error is above the bound times its slack", "[tune]")
{
    CostOptions options;
    options.reference_steps = 2e8;
    options.frames = 24;
    const tuning::Start start =
        tuning::make_start(swinging(6, 200, 0.05), serial(), CostKind::moving, options);
    REQUIRE(start.reference.verified);
    REQUIRE(start.reference.frames.size() == 25);
    MethodSettings settings;
    settings.substeps = 4;
    const auto trial = [&](double bound) {
        return tuning::run_trial(start, serial(), settings, CostKind::moving, bound, 1);
    };
    const tuning::TrialRun whole = trial(0.9);
    REQUIRE(whole.reason.empty());
    CHECK(whole.frames == 24);
    const tuning::TrialRun last = trial(*whole.error * 0.99); // only the last rung is above
    CHECK(last.frames == 24);
    CHECK(last.reason.find("after 24 frames") != std::string::npos);
    const tuning::TrialRun first = trial(1e-6);
    CHECK(first.frames == 18);
    CHECK(*first.error > 2e-6);
}

TEST_CASE("impossible bounds and empty scenes are refused", "[tune]")
{
    const Scene scene = resting(4, 50, 0.01);
    for (const double bound : {0.0, 1.0, -1.0})
        CHECK_THROWS_AS(tune(scene, serial(), by_prior(bound)), Error);
    Scene nothing = scene;
    nothing.bodies.clear();
    CHECK_THROWS_AS(tune(nothing, serial(), by_prior(0.1)), Error);
}
