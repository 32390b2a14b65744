// Studies of accuracy against cost: real ones on small scenes, and ranking on tables made by hand.
#include "support/catch.hpp"

#include "cost_samples.hpp"
#include "taut/plan/plan.hpp"
#include "taut/report/cost.hpp"
#include "taut/report/cost_reference.hpp"
#include "taut/runtime/base/error.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace taut;
using namespace samples;

namespace {

/// A flat pyramid of four springs under a mass, pushed hard enough to snap through to its mirror image.
Scene snapping_pyramid()
{
    Body body;
    body.mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 0, 1}, {0, 0.3, 0}};
    for (std::uint32_t corner = 0; corner < 4; ++corner)
        body.springs.push_back({corner, 4, std::sqrt(1.09), 1e-3});
    body.vertex_masses.assign(5, 0.1);
    body.pins.emplace_back().vertices = {0, 1, 2, 3};
    body.velocity = {0, -10, 0};
    Scene scene;
    scene.damping = 3;
    scene.bodies.push_back(std::move(body));
    return scene;
}

const CostPoint& cheapest(const CostStudy& study, std::size_t target)
{
    REQUIRE(study.targets[target].cheapest.has_value());
    return study.points[*study.targets[target].cheapest];
}

} // namespace

TEST_CASE("a hanging chain's error at rest falls with the square of the substeps", "[cost]")
{
    const CostStudy study = study_of(damped_chain(), only({5, 10, 20, 40}, {1}, {Precision::float64}));
    INFO(study.reference.text);
    CHECK(study.kind == CostKind::at_rest);
    CHECK(study.metric == "e_disp");
    REQUIRE(study.reference.name == "R2");
    REQUIRE(study.reference.error.has_value());
    CHECK(*study.reference.error < 1e-9);
    for (std::size_t i = 0; i + 1 < study.points.size(); ++i)
    {
        INFO(study.points[i].reason << study.points[i + 1].reason);
        REQUIRE((study.points[i].error && study.points[i + 1].error));
        const double order = std::log2(*study.points[i].error / *study.points[i + 1].error);
        INFO(*study.points[i].error << " then " << *study.points[i + 1].error);
        CHECK(std::abs(order - 2) < 0.3);
    }
}

TEST_CASE("float says of a chain at rest what double says, down to a floor that it does not hide", "[cost]")
{
    const CostStudy study =
        study_of(damped_chain(), only({10, 100}, {1}, {Precision::float32, Precision::float64}));
    REQUIRE(study.points.size() == 4);
    for (const CostPoint& point : study.points)
    {
        INFO(point.reason);
        REQUIRE(point.error.has_value());
    }
    CHECK(std::abs(*study.points[0].error / *study.points[2].error - 1) < 0.05);
    CHECK(*study.points[1].error > 0.9 * *study.points[3].error); // never better than double by rounding
    CHECK(*study.points[1].error < *study.points[0].error);
}

TEST_CASE("of two equilibria the reference is the one in which the method comes to rest", "[cost]")
{
    const CostStudy study = study_of(snapping_pyramid(), only({20, 100}, {1}, {Precision::float64}));
    INFO(study.reference.text);
    REQUIRE(study.reference.name == "R2");
    CHECK(study.reference.text.find("several equilibria") != std::string::npos);
    CHECK(study.reference.frames.back()[4].y < -0.2);
    REQUIRE(study.points[1].error.has_value());
    CHECK(*study.points[1].error < 0.01);
}

TEST_CASE("a swinging chain is compared with small steps whose own error is printed", "[cost]")
{
    const CostStudy study = study_of(free_chain(), only({4, 32, 128}, {1}, {Precision::float64}));
    INFO(study.reference.text);
    CHECK(study.kind == CostKind::moving);
    CHECK(study.metric == "e_traj");
    REQUIRE(study.reference.name == "R3");
    CHECK(study.frames == 12);
    REQUIRE(study.reference.error.has_value());
    CHECK(study.reference.text.find("own error") != std::string::npos);
    REQUIRE(study.points[2].error.has_value());
    CHECK(*study.points[2].error > 10 * *study.reference.error);
    CHECK(*study.points[1].error < 0.5 * *study.points[0].error);
    CHECK(*study.points[2].error < 0.5 * *study.points[1].error);
    CHECK(study.points[0].error_smoothed.has_value());
    CHECK(*study.points[2].error_l < *study.points[0].error_l);
}

TEST_CASE("sweeps are counted, not measured: as many as the plan dispatches", "[cost]")
{
    const Scene scene = free_chain();
    const CostStudy study = study_of(scene, only({1, 5}, {1, 3}, {Precision::float32}));
    const auto dispatches = [&](const CostPoint& point) {
        Scene at = scene;
        at.method.substeps = point.substeps;
        at.method.iterations = point.iterations;
        PlanOptions options;
        options.small_bodies = PlanOptions::SmallBodies::never;
        const Plan plan = make_plan(at, {}, options);
        const auto distance = std::find_if(plan.effects.begin(), plan.effects.end(),
                                           [](const EffectCost& e) { return e.name == "distance"; });
        REQUIRE(distance != plan.effects.end());
        return static_cast<double>(distance->dispatches_per_step);
    };
    CHECK(study.points[0].sweeps == Approx(60));
    for (const CostPoint& point : study.points)
        CHECK(point.sweeps / study.points[0].sweeps ==
              Approx(dispatches(point) / dispatches(study.points[0])));
}

TEST_CASE("rigid links have no independent reference; the fallback says that it is the same method", "[cost]")
{
    Scene scene = free_chain();
    scene.bodies[0].material.stretch_stiffness = std::numeric_limits<double>::infinity();
    scene.bodies[0].velocity = {1, 0, 0};
    const CostStudy study = study_of(scene, only({5, 20}, {5}, {Precision::float64}));
    INFO(study.reference.text);
    CHECK(study.reference.name == "R4 (self-convergence, same method)");
    REQUIRE_FALSE(study.reference.passed.empty());
    CHECK(study.reference.passed[0].find("rigid") != std::string::npos);
    REQUIRE(study.points[1].error.has_value());
    CHECK(*study.points[1].error < *study.points[0].error);
}

TEST_CASE("a setting that diverges is a gap with its reason", "[cost]")
{
    Scene scene = free_chain();
    scene.bodies[0].velocity = {0, 0, 1e14};
    scene.bodies[0].pins.clear();
    const CostStudy study = study_of(scene, only({1}, {1}, {Precision::float32}));
    const CostPoint& point = study.points.at(0);
    CHECK_FALSE(point.error.has_value());
    CHECK(point.status == Status::diverged);
    CHECK(point.reason.find("diverged") != std::string::npos);
    CHECK_FALSE(study.sound());
    const auto json = nlohmann::json::parse(cost_json(study));
    CHECK(json["points"][0]["error"].is_null());
    CHECK(json["points"][0]["ms_per_simulated_second"].is_null());
    CHECK(json["cheapest"]["0.1"].is_null());
    const Plot plot = cost_plot(study, CostAxis::time);
    REQUIRE(plot.series.size() == 1);
    CHECK_FALSE(std::isfinite(plot.series[0].points[0].y));
    CHECK(gap_table(plot).find("diverged") != std::string::npos);
    CHECK(svg(plot).find("diverged") == std::string::npos);
}

TEST_CASE("a setting that does not come to rest is a gap", "[cost]")
{
    CostOptions options = only({5}, {1}, {Precision::float64});
    options.kind = CostKind::at_rest;
    options.rest_seconds = 1;
    Scene scene = damped_chain();
    scene.damping = 0.1;
    const CostStudy study = study_of(scene, options);
    CHECK_FALSE(study.points[0].error.has_value());
    CHECK(study.points[0].reason.find("not at rest") != std::string::npos);
}

TEST_CASE("pins that hold, no colliders and damping make a scene static", "[cost]")
{
    Scene scene = damped_chain();
    CHECK(cost_kind(scene) == CostKind::at_rest);
    scene.damping = 0;
    CHECK(cost_kind(scene) == CostKind::moving);
    scene = damped_chain();
    scene.bodies[0].pins[0].motion = {{0, {0, 0, 0}}, {1, {0, 1, 0}}};
    CHECK(cost_kind(scene) == CostKind::moving);
    scene = damped_chain();
    scene.colliders.emplace_back();
    CHECK(cost_kind(scene) == CostKind::moving);
    scene = damped_chain();
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].pins.clear();
    CHECK(cost_kind(scene) == CostKind::moving);
}

TEST_CASE("the front holds what nothing beats in both error and time", "[cost]")
{
    const CostStudy study = table({made(1, 0.5, 1), made(2, 0.2, 2), made(5, 0.3, 3), made(10, 0.01, 8),
                                   made(20, 0.01, 9), made(50, std::nullopt, 0)});
    const bool expected[] = {true, true, false, true, false, false};
    for (std::size_t i = 0; i < study.points.size(); ++i)
        CHECK(study.points[i].pareto == expected[i]);
    for (const CostPoint& a : study.points)
        for (const CostPoint& b : study.points)
            if (a.pareto && b.pareto && a.ms < b.ms)
                CHECK(*a.error > *b.error);
}

TEST_CASE("errors below the reference's floor are not told apart", "[cost]")
{
    const CostStudy study = table({made(1, 0.2, 1), made(10, 5e-3, 5), made(20, 2e-3, 9)}, 1e-3);
    CHECK_FALSE(study.points[0].at_floor);
    CHECK(study.points[1].at_floor);
    CHECK(study.points[2].at_floor);
    CHECK(study.points[1].pareto);
    CHECK_FALSE(study.points[2].pareto);                                      // smaller in number only
    CHECK(pareto_front(cost_plot(study, CostAxis::time).series).size() == 2); // the diagram agrees
}

TEST_CASE("the cheapest setting is the fastest that is accurate enough, whatever the order", "[cost]")
{
    const CostStudy study = table({made(50, 5e-4, 40), made(10, 9e-3, 12), made(20, 4e-3, 10),
                                   made(1, 0.4, 1), made(5, 0.09, 3), made(2, std::nullopt, 0.1)});
    CHECK(cheapest(study, 0).substeps == 5);
    CHECK(cheapest(study, 1).substeps == 20);
    CHECK(cheapest(study, 2).substeps == 50);
    const std::vector<std::string> sentences = cost_sentences(study);
    REQUIRE(sentences.size() == 3);
    CHECK(sentences[1] ==
          "1 %: 20 substeps x 1 iteration in float, 10 ms per simulated second (e_disp 0.4 %).");
}

TEST_CASE("an accuracy that only the reference's own error would grant is not reached", "[cost]")
{
    const CostStudy study = table({made(10, 9.5e-3, 4)}, 1e-3);
    CHECK_FALSE(study.targets[1].cheapest.has_value());
    const std::vector<std::string> sentences = cost_sentences(study);
    CHECK(sentences[0].find("10 substeps") != std::string::npos);
    CHECK(sentences[1].find("1 % is not reached; the best is 10 substeps x 1 iteration in float") == 0);
}

TEST_CASE("three refinements of known order give that order and the finest one's error", "[cost]")
{
    ErrorWeights weights{{1}, 1};
    Frames level[3];
    for (int l = 0; l < 3; ++l)
        for (int f = 0; f < 5; ++f)
            level[l].push_back({glm::dvec3(f * (1 + 0.016 * std::pow(0.25, l)), 0, 0)});
    const cost::Refinement good = cost::refine(weights, level[0], level[1], level[2]);
    CHECK(good.frames == 4);
    CHECK(good.order == Approx(2).margin(1e-9));
    CHECK(good.error == Approx(0.001).epsilon(0.01));
    level[0][3][0].x = level[1][3][0].x; // no convergence from frame 3 on
    level[1][3][0].x += 0.2;
    CHECK(cost::refine(weights, level[0], level[1], level[2]).frames == 2);
}

TEST_CASE("JSON and CSV carry every setting under the promised keys", "[cost]")
{
    CostStudy study = study_of(damped_chain(), only({5, 10}, {1}, {Precision::float32}));
    study.scene = "a \"scene\", named";
    const auto json = nlohmann::json::parse(cost_json(study));
    for (const char* key : {"points", "cheapest", "reference", "device", "scene", "sentences"})
        CHECK(json.contains(key));
    for (const char* key : {"0.1", "0.01", "0.001"})
        CHECK(json["cheapest"].contains(key));
    for (const char* key : {"class", "text", "verified", "error"})
        CHECK(json["reference"].contains(key));
    REQUIRE(json["points"].size() == 2);
    for (const auto& point : json["points"])
        for (const char* key :
             {"method", "substeps", "iterations", "precision", "error", "error_metric", "reference",
              "ms_per_simulated_second", "sweeps", "pareto", "status", "error_l"})
            CHECK(point.contains(key));
    CHECK(json["points"][0]["reference"] == "R2");
    CHECK(json["points"][0]["ms_per_simulated_second"].get<double>() > 0);
    const std::string csv = cost_csv(study);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
    CHECK(csv.find("\"a \"\"scene\"\", named\",cpu:serial,xpbd,5,1,float,") != std::string::npos);
}

TEST_CASE("a diagram names its units, its reference class and the floor", "[cost]")
{
    CostStudy study = table({made(1, 0.2, 1), made(10, 5e-3, 5)}, 1e-3);
    study.points[0].sweeps = 60;
    study.points[1].sweeps = 600;
    const std::string time = svg(cost_plot(study, CostAxis::time)),
                      work = svg(cost_plot(study, CostAxis::sweeps));
    CHECK(time.find("ms per simulated second") != std::string::npos);
    CHECK(work.find("sweeps over all constraints per simulated second") != std::string::npos);
    CHECK(time.find("Reference class R2") != std::string::npos);
    CHECK(time.find("Errors below 0.01") != std::string::npos);
    CHECK(cost_plot(study, CostAxis::sweeps).series[0].points[1].x == 600);
}

TEST_CASE("a stopped study keeps what is done and calls the rest gaps", "[cost]")
{
    CostOptions options = only({5, 10, 20}, {1}, {Precision::float32});
    options.progress = [](std::size_t done, std::size_t) { return done < 1; };
    const CostStudy study = study_of(free_chain(), options);
    CHECK(study.interrupted);
    CHECK(study.points[0].error.has_value());
    CHECK(study.points[1].status == Status::interrupted);
    CHECK_FALSE(study.points[2].error.has_value());
}

TEST_CASE("what cannot be studied is refused: no or impossible settings, no bodies, no time", "[cost]")
{
    for (const CostOptions& bad : {only({}, {1}, {Precision::float32}), only({0}, {1}, {Precision::float32}),
                                   only({1}, {1001}, {Precision::float32}), only({1}, {1}, {})})
        CHECK_THROWS_AS(study_of(free_chain(), bad), Error);
    Scene nothing = free_chain();
    nothing.bodies.clear();
    CHECK_THROWS_AS(study_of(nothing, only({1}, {1}, {Precision::float32})), Error);
    Scene instant = free_chain();
    instant.duration = 0;
    CHECK_THROWS_AS(study_of(instant, only({1}, {1}, {Precision::float32})), Error);
}
