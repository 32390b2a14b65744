// What a search answers beside a setting: references that are not good enough, time that is up, settings that
// were left out, and why.
#include "support/catch.hpp"

#include "taut/report/method_settings.hpp"
#include "taut/report/tune_parts.hpp"
#include "tune_samples.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

using namespace taut;
using namespace samples;

TEST_CASE("a reference that is not good enough is said at once, and what bound it would do for", "[tune]")
{
    const Scene scene = swinging(6, 200, 0.05);
    TuneOptions options = by_prior(1e-9);
    std::size_t asked = 0;
    options.progress = [&](std::size_t, std::size_t) { return ++asked > 0; };
    const TuneResult result = tune(scene, serial(), options);
    CHECK_FALSE(result.found);
    CHECK(result.answer == TuneAnswer::poor_reference);
    CHECK(asked == 0); // nothing raced
    CHECK(result.tried.empty());
    CHECK(result.rejected.empty());
    REQUIRE(result.reference.error.has_value());
    CHECK(*result.reference.error > tuning::kReferenceShare * 1e-9);
    CHECK(result.why.find("not good enough") != std::string::npos);
    CHECK(result.why.find("--error of ") != std::string::npos);
}

TEST_CASE("a reference that ends inside out is said at once: no setting that comes near it is accepted",
          "[tune]")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {2, 2, 2};
    body.shape.size = {0.6, 0.6};
    body.material = solid_material();
    body.material.model = SolidModel::springs;
    body.material.density = 50;
    body.material.youngs_modulus = 100; // a cushion that its own weight presses through the floor
    body.material.volume_stiffness = 0;
    Pin pin;
    pin.faces = {"bottom"};
    body.pins = {pin};
    scene.bodies = {body};
    scene.damping = 1;
    scene = resolve(scene);
    TuneOptions options = by_prior(0.01);
    options.kind = CostKind::at_rest;
    const TuneResult result = tune(scene, serial(), options);
    CHECK(result.answer == TuneAnswer::unsound_reference);
    CHECK(to_string(result.answer) == "unsound_reference");
    CHECK(result.tried.empty());
    CHECK(result.why.find("tetrahedra inside out, accept.inverted is 0") != std::string::npos);
    scene.accept.inverted = 1000;
    options.progress = [](std::size_t, std::size_t) { return false; };
    CHECK(tune(scene, serial(), options).answer == TuneAnswer::none_of_tried);
}

TEST_CASE("a moving start keeps the frames that its reference is good enough for", "[tune]")
{
    tuning::Start start{swinging(6, 200, 0.05), {}, {}, {}, "e_traj", 20};
    start.reference.frames.assign(21, {});
    for (std::size_t f = 0; f <= 20; ++f)
        start.reference.errors.push_back(1e-4 * static_cast<double>(f));
    start.reference.error = start.reference.errors.back();
    const tuning::Start whole = start;
    REQUIRE(tuning::fit_reference(start, 0.003)); // at most 0.4 of it: 1.2e-3, so 12 frames
    CHECK(start.frames == 12);
    CHECK(start.reference.frames.size() == 13);
    CHECK(*start.reference.error == Approx(1.2e-3));
    start = whole;
    CHECK_FALSE(tuning::fit_reference(start, 1e-3)); // 4 frames are too few
    CHECK(start.frames == 20);
    CHECK(tuning::fit_reference(start, 0.1));
    CHECK(start.frames == 20);
    start.reference.error.reset(); // nobody knows it
    CHECK(tuning::fit_reference(start, 1e-9));
    tuning::Start rest{swinging(6, 200, 0.05), {}, {}, {}, "e_disp", 0};
    rest.reference.error = 0.01;
    CHECK_FALSE(tuning::fit_reference(rest, 0.02));
    CHECK(tuning::fit_reference(rest, 0.03));
}

TEST_CASE("no bound of a race is negative: what fell did so by an error above it", "[tune]")
{
    for (const double bound : {0.01, 0.05})
    {
        const TuneResult result = tune(sheet(6, 200), serial(), by_prior(bound));
        INFO(result.why);
        for (const TuneRejection& rejection : result.rejected)
        {
            INFO(rejection.stage << ": " << rejection.reason);
            CHECK(rejection.reason.find("above -") == std::string::npos);
            if (rejection.stage == "race" || rejection.stage == "perturbed")
                CHECK((!rejection.error || *rejection.error > (0.8 - tuning::kReferenceShare) * bound));
        }
    }
}

TEST_CASE("a start whose reference is not good enough is left out with a note", "[tune]")
{
    CostReference reference;
    reference.verified = true;
    reference.error = 0.029;
    const std::string note = tuning::perturbed_note(2, reference, 0.01);
    CHECK(note ==
          "perturbed start 2 is left out: its reference's own error, 2.9 %, takes more than 0.4 of the "
          "bound of 1 %");
    reference.verified = false;
    CHECK(tuning::perturbed_note(1, reference, 0.01).find("no reference") != std::string::npos);
}

TEST_CASE("when the time is up what was not tried is named; a search of no time tries nothing", "[tune]")
{
    TuneOptions options = by_prior(0.01);
    options.seconds = 0;
    options.methods = {MethodKind::xpbd};
    const TuneResult nothing = tune(resting(6, 200, 0.05), serial(), options);
    CHECK_FALSE(nothing.found);
    CHECK(nothing.tried.empty());
    CHECK(nothing.not_tried.size() >= 10);
    for (const TuneLeft& left : nothing.not_tried)
        CHECK(left.reason == "the time was up");
    CHECK(nothing.why == "No setting was tried: the time was up.");
    // A clock that goes on by one with every look at it.
    double now = 0;
    options.seconds = 400;
    options.clock = [&now] { return now += 1; };
    options.error = 1e-7;
    const TuneResult some = tune(resting(6, 200, 0.05), serial(), options);
    INFO(some.why << " " << some.tried.size() << " " << some.not_tried.size());
    CHECK_FALSE(some.found);
    CHECK_FALSE(some.not_tried.empty());
    const auto json = nlohmann::json::parse(tune_json(some));
    CHECK(json["not_tried"].size() == some.not_tried.size());
    CHECK(json["not_tried"][0]["reason"] == "the time was up");
}

TEST_CASE("halfway through its time without a find the race takes most substeps first", "[tune]")
{
    TuneOptions options = by_prior(1e-7); // which none keeps
    options.methods = {MethodKind::xpbd};
    // No time passes before the race; with the first candidate 0.7 of it is gone.
    double now = 0;
    options.seconds = 10;
    options.clock = [&now] { return now; };
    options.progress = [&now](std::size_t, std::size_t) {
        now = 7;
        return true;
    };
    const TuneResult result = tune(resting(6, 200, 0.05), serial(), options);
    REQUIRE(result.tried.size() >= 3);
    CHECK(result.tried[0].substeps == 1); // the cheapest
    CHECK(result.tried[1].substeps == 128);
    for (std::size_t k = 2; k < result.tried.size(); ++k)
        CHECK(result.tried[k].substeps <= result.tried[k - 1].substeps);
}

TEST_CASE("what fell in float is not tried in double while something else is found", "[tune]")
{
    TuneOptions options = by_prior(0.01);
    options.precisions = {Precision::float32, Precision::float64};
    options.methods = {MethodKind::xpbd};
    const TuneResult result = tune(resting(6, 200, 0.05), serial(), options);
    REQUIRE(result.found);
    const auto doubles = std::count_if(result.tried.begin(), result.tried.end(), [](const MethodSettings& s) {
        return s.precision == Precision::float64;
    });
    CHECK(doubles == 0);
    CHECK(std::any_of(result.not_tried.begin(), result.not_tried.end(),
                      [](const TuneLeft& l) { return l.reason == "it fell in float"; }));
    options.error = 1e-12; // nothing keeps it: then doubles have their turn
    const TuneResult none = tune(resting(6, 200, 0.05), serial(), options);
    CHECK_FALSE(none.found);
    CHECK(std::count_if(none.tried.begin(), none.tried.end(),
                        [](const MethodSettings& s) { return s.precision == Precision::float64; }) >= 10);
}

TEST_CASE("methods of another material are left out unless they are named, and then it is said", "[tune]")
{
    Scene scene = swinging(6, 200, 0.05);
    TuneOptions options = by_prior(0.3);
    const TuneResult usual = tune(scene, serial(), options);
    REQUIRE(usual.found);
    CHECK(usual.settings.type != MethodKind::pbd);
    for (const MethodSettings& tried : usual.tried)
        CHECK(tried.type != MethodKind::pbd);
    const auto left_out = [](const TuneRejection& r) {
        return r.settings.type == MethodKind::pbd && r.stage == "material" &&
               r.reason.find("--methods") != std::string::npos;
    };
    CHECK(std::any_of(usual.rejected.begin(), usual.rejected.end(), left_out));
    options.error = 0.9;
    options.methods = {MethodKind::pbd};
    const TuneResult named = tune(scene, serial(), options);
    REQUIRE(named.found);
    CHECK(std::any_of(named.notes.begin(), named.notes.end(), [](const std::string& note) {
        return note.find("another material: pbd") != std::string::npos;
    }));
    scene.method.type = MethodKind::pbd; // the scene itself names it
    options.methods = {};
    const TuneResult own = tune(scene, serial(), options);
    CHECK(std::any_of(own.tried.begin(), own.tried.end(),
                      [](const MethodSettings& s) { return s.type == MethodKind::pbd; }));
}

TEST_CASE("acad is of another material beyond the strain that it holds springs at", "[tune]")
{
    MethodSettings acad;
    acad.type = MethodKind::acad;
    acad.activate_strain = 0.05;
    tuning::SceneFacts facts;
    facts.stiff = true;
    facts.strain = 0.06;
    CHECK(tuning::other_material(facts, acad).find("0.06") != std::string::npos);
    acad.constrained = ConstrainedSprings::structural; // the stretched ones are not held
    facts.structural_strain = 0.04;
    CHECK(tuning::other_material(facts, acad).empty());
    facts.shortening = 0.5;
    facts.structural_shortening = 0.07;
    CHECK(tuning::other_material(facts, acad).empty()); // it stays a spring
    acad.compress = true;
    CHECK_THAT(tuning::other_material(facts, acad), Contains("presses one by 0.07"));
    facts.structural_shortening = 0.04;
    CHECK(tuning::other_material(facts, acad).empty());
    MethodSettings rows;
    rows.type = MethodKind::implicit_constraints;
    CHECK(tuning::other_material(facts, rows).empty());
    rows.constraint_compliance = 0;
    CHECK(tuning::other_material(facts, rows).find("compliance") != std::string::npos);
    rows.type = MethodKind::xpbd; // which does not read it
    CHECK(tuning::other_material(facts, rows).empty());
    rows.type = MethodKind::pbd;
    facts.stiff = false; // nothing but rigid springs: pbd keeps them as well as anybody
    CHECK(tuning::other_material(facts, rows).empty());
}

TEST_CASE("free fall does not judge what pins hold up to its rest", "[tune]")
{
    // Explicit steps far beyond the stable ones: stretched links fly apart, links at their rest length (a
    // number without rounding) have no force to grow.
    Scene scene = test::chain(4, 1e6, 0.05, 1);
    for (const glm::dvec3& x : scene.bodies[0].mesh.positions)
        scene.bodies[0].start_positions.push_back(1.5 * x);
    MethodSettings settings;
    settings.type = MethodKind::mass_spring;
    settings.substeps = 1;
    settings.stability = StabilityRule::ignore;
    const auto broken = [&](CostKind kind) {
        return *tuning::broken_law(scene, serial(), settings, kind, 18);
    };
    CHECK_THAT(broken(CostKind::moving), Contains("free fall"));
    CHECK(broken(CostKind::at_rest) == "");
    scene.bodies[0].pins.clear(); // then it does fall
    CHECK_THAT(broken(CostKind::at_rest), Contains("free fall"));
}

TEST_CASE("a scene that pins would hold but nothing damps is said never to rest", "[tune]")
{
    const auto says = [](const TuneResult& result) {
        return std::any_of(result.notes.begin(), result.notes.end(), [](const std::string& note) {
            return note.find("without damping the scene never rests") == 0;
        });
    };
    TuneOptions options = by_prior(0.3);
    options.methods = {MethodKind::xpbd};
    CHECK(says(tune(swinging(6, 200, 0.05), serial(), options)));
    CHECK_FALSE(says(tune(resting(6, 200, 0.05), serial(), options)));
}

TEST_CASE("a scene of one method is tuned over all: what they read differently is put back", "[tune]")
{
    Scene scene = resting(6, 200, 0.05);
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = ElementScheme::coloured; // a word that mass_spring does not know
    TuneOptions options = by_prior(0.05);
    const TuneResult result = tune(scene, serial(), options);
    CHECK(result.found);
    MethodSettings settings = settings_for(MethodKind::mass_spring, scene.method);
    CHECK(settings.type == MethodKind::mass_spring);
    CHECK(settings.scheme == ElementScheme::automatic);
    CHECK(settings_for(MethodKind::pbd, scene.method).scheme == ElementScheme::coloured);
}

TEST_CASE("tried settings are listed by method, precision and choices", "[tune]")
{
    MethodSettings once;
    once.iterations = 1;
    std::vector<MethodSettings> all(4, once);
    all[0].substeps = 4;
    all[1].substeps = 1;
    all[2].substeps = 2;
    all[2].iterations = 16;
    all[3].type = MethodKind::mass_spring;
    all[3].substeps = 8;
    all[3].integrator = Integrator::verlet;
    CHECK(listed_settings(all) ==
          std::vector<std::string>{"xpbd in float: 1, 4 substeps x 1 iteration; 2 substeps x 16 iterations",
                                   "mass_spring in float, integrator verlet: 8 substeps"});
}
