// The other figures of a study: orders of convergence, ratios, what should be kept.
#include "support/catch.hpp"

#include "support/scenes.hpp"
#include "taut/plan/material.hpp"
#include "taut/report/cost_energy.hpp"
#include "taut/report/cost_ratio.hpp"
#include "taut/report/method_settings.hpp"

#include <algorithm>
#include <cmath>

using namespace taut;

namespace {

std::shared_ptr<Device> serial() { return Device::open("cpu:serial"); }

CostPoint made(const std::string& method, std::uint32_t substeps, std::uint32_t iterations, double error)
{
    CostPoint point;
    point.method = method;
    point.settings.type = option_named<MethodKind>(method);
    point.substeps = point.settings.substeps = substeps;
    point.iterations = point.settings.iterations = iterations;
    point.error = error;
    point.ms = point.sweeps = substeps * iterations;
    return point;
}

CostStudy table(std::vector<CostPoint> points, double own)
{
    CostStudy study;
    study.metric = "e_disp";
    study.reference.name = "R2";
    study.reference.error = own;
    study.points = std::move(points);
    rank(study);
    return study;
}

CostOptions one_setting(std::uint32_t substeps)
{
    CostOptions options;
    options.methods = {MethodKind::xpbd};
    options.substeps = {substeps};
    options.iterations = {1};
    options.precisions = {Precision::float64};
    options.timing_seconds = 0;
    return options;
}

Scene damped_chain()
{
    Scene scene = test::chain(6, 200, 0.05, 0.6);
    scene.damping = 6;
    return scene;
}

} // namespace

TEST_CASE("orders are of the last two slopes above the floor and below 50 %", "[figures]")
{
    std::vector<CostPoint> points{made("vbd", 1, 1, 0.9)};
    for (const std::uint32_t n : {2u, 4u, 8u, 16u})
        points.push_back(made("xpbd", n, 1, 0.4 / (n * n)));
    points.push_back(made("xpbd", 32, 1, 0.4 / (16 * 16))); // the floor stops it
    points.push_back(made("xpbd", 4, 4, 0.4 / 16 / 4));
    const CostStudy study = table(std::move(points), 1e-4);
    const std::vector<CostOrder> orders = convergence(study, CostSplit::substeps);
    REQUIRE(orders.size() == 1); // one error alone has no order
    CHECK(orders[0].fixed == 1);
    CHECK(orders[0].points.size() == 5);
    REQUIRE(orders[0].order.has_value());
    CHECK(*orders[0].order == Approx(2).margin(0.01)); // the last slope, 0, is where it stops
    CHECK(orders[0].at_floor);
    const std::vector<CostOrder> by_iterations = convergence(study, CostSplit::iterations);
    REQUIRE(by_iterations.size() == 1);
    CHECK(by_iterations[0].fixed == 4);
    CHECK(*by_iterations[0].order == Approx(1));
    CHECK_FALSE(by_iterations[0].at_floor);
    const std::string drawn = svg(convergence_plot(study, CostSplit::substeps));
    CHECK(drawn.find("Observed order") != std::string::npos);
    const std::vector<std::string> caption = convergence_plot(study, CostSplit::substeps).caption;
    CHECK(caption.back().find("xpbd 2.00, then at its floor") != std::string::npos);
    CHECK(drawn.find(">at its floor</text>") != std::string::npos);
    CHECK(drawn.find("Reference class R2") != std::string::npos);
}

TEST_CASE("an error that does not fall has no order but a floor", "[figures]")
{
    for (const double last : {0.199, 0.2, 0.31})
    {
        const CostStudy study = table({made("xpbd", 2, 1, 0.2), made("xpbd", 4, 1, last)}, 1e-6);
        const auto orders = convergence(study, CostSplit::substeps);
        REQUIRE(orders.size() == 1);
        CHECK_FALSE(orders[0].order.has_value());
        CHECK(orders[0].at_floor);
        const std::vector<std::string> caption = convergence_plot(study, CostSplit::substeps).caption;
        CHECK(caption.back().find("xpbd at its floor") != std::string::npos);
    }
}

TEST_CASE("errors below the reference's floor have no order", "[figures]")
{
    const CostStudy study = table({made("xpbd", 2, 1, 1e-3), made("xpbd", 4, 1, 2.5e-4)}, 1e-3);
    const auto orders = convergence(study, CostSplit::substeps);
    REQUIRE(orders.size() == 1);
    CHECK_FALSE(orders[0].order.has_value());
}

TEST_CASE("a ratio of masses is the last vertex's, one of stiffness that of the second half", "[figures]")
{
    const Scene scene = damped_chain();
    const auto before = vertex_masses(scene.bodies[0]);
    const auto heavy = vertex_masses(ratio_scene(scene, RatioKind::mass, 100).bodies[0]);
    CHECK(heavy.back() == Approx(100 * before.back()));
    CHECK(std::equal(before.begin(), before.end() - 1, heavy.begin()));
    const auto soft = stretch_elements(scene.bodies[0]);
    const auto mixed = stretch_elements(ratio_scene(scene, RatioKind::stiffness, 10).bodies[0]);
    REQUIRE(mixed.size() == soft.size());
    std::size_t stiffer = 0;
    for (std::size_t i = 0; i < soft.size(); ++i)
    {
        CHECK(mixed[i].rest_length == soft[i].rest_length);
        const bool second = soft[i].a >= 3 && soft[i].b >= 3;
        CHECK(mixed[i].compliance == Approx(soft[i].compliance / (second ? 10 : 1)));
        stiffer += second;
    }
    CHECK(stiffer == 3);
}

TEST_CASE("of a solid there is no ratio of stiffness", "[figures]")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {1, 1, 1};
    body.material = solid_material();
    scene.bodies = {body};
    CHECK_THROWS_AS(run_ratios(resolve(scene), serial(), one_setting(4), RatioKind::stiffness, {1}), Error);
}

TEST_CASE("a growing mass ratio is followed to where a method leaves 10 %", "[figures]")
{
    const RatioStudy study = run_ratios(damped_chain(), serial(), one_setting(10), RatioKind::mass, {1, 100});
    REQUIRE(study.studies.size() == 2);
    for (const CostStudy& one : study.studies)
        CHECK(one.reference.name == "R2");
    REQUIRE(study.studies[0].points[0].error.has_value());
    const std::string csv = ratio_csv(study);
    CHECK(csv.find("ratio,scene,") == 0);
    CHECK(csv.find("\n100,") != std::string::npos);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 3);
    const std::vector<std::string> sentences = ratio_sentences(study);
    REQUIRE(sentences.size() == 1);
    CHECK(sentences[0].find("xpbd, 10 substeps x 1 iteration in double: ") == 0);
    CHECK(svg(ratio_plot(study)).find("mass ratio") != std::string::npos);
    CHECK_THROWS_AS(run_ratios(damped_chain(), serial(), one_setting(10), RatioKind::mass, {0}), Error);
}

TEST_CASE("sentences about ratios say where 10 % ends and why", "[figures]")
{
    RatioStudy study{"made", RatioKind::stiffness, {1, 10, 100}, {}};
    for (const double error : {0.01, 0.09, 0.3})
        study.studies.push_back(table({made("xpbd", 4, 1, error), made("vbd", 4, 1, error / 100)}, 0));
    CostPoint& gap = study.studies[1].points[1];
    gap.error = std::nullopt;
    gap.refused = "unsupported";
    gap.reason = "not for this";
    const std::vector<std::string> sentences = ratio_sentences(study);
    REQUIRE(sentences.size() == 2);
    CHECK(sentences[0] ==
          "xpbd, 4 substeps x 1 iteration in float: within 10 % up to a stiffness ratio of 10; "
          "at 100 the error is 30 %.");
    CHECK(sentences[1] ==
          "vbd, 4 substeps x 1 iteration in float: within 10 % up to a stiffness ratio of 100; "
          "nothing at 10: it refuses (unsupported).");
    CHECK(ratio_plot(study).gaps.size() == 1);
}

TEST_CASE("a spring in free flight keeps momentum; XPBD loses energy, less with more substeps", "[figures]")
{
    Scene scene = test::chain(1, 100, 1, 1);
    scene.bodies[0].pins.clear();
    scene.bodies[0].start_positions = {{0, 0, 0}, {0, -1.3, 0}};
    scene.bodies[0].velocity = {0.2, 1, 0};
    scene.gravity = {0, 0, 0};
    scene.duration = 1;
    CostOptions options = one_setting(4);
    options.substeps = {4, 32};
    const EnergyStudy study = run_energy(scene, serial(), options);
    REQUIRE(study.runs.size() == 2);
    REQUIRE(study.runs[0].energy.size() == 61);
    CHECK(study.reference_energy > 1); // 1/2 (1 + 1) 1.04 and what the spring gives
    for (const EnergyRun& run : study.runs)
    {
        CHECK(run.reason.empty());
        REQUIRE(run.momentum.size() == 61);
        CHECK(*std::max_element(run.momentum.begin(), run.momentum.end()) < 1e-9);
        CHECK(run.energy.front() == 0);
        CHECK(run.energy.back() < 0);
    }
    CHECK(std::abs(study.runs[1].energy.back()) < 0.3 * std::abs(study.runs[0].energy.back()));
    CHECK(energy_sentences(study)[0].find("loses") != std::string::npos);
    CHECK(svg(energy_plot(study, Conserved::energy)).find("time, s") != std::string::npos);
    CHECK(energy_plot(study, Conserved::energy).x_linear);
    CHECK(energy_csv(study).find("setting,time,energy,momentum\n\"xpbd, 4 substeps") == 0);
}

TEST_CASE("where energy is not kept there is nothing to follow", "[figures]")
{
    CHECK_THROWS_AS(run_energy(damped_chain(), serial(), one_setting(4)), Error);
    Scene scene = test::chain(2, 100, 1, 1);
    Scene flows = scene;
    flows.bodies[0].material.plastic_yield = 0.1;
    CHECK_THROWS_AS(run_energy(flows, serial(), one_setting(4)), Error);
    scene.colliders.emplace_back();
    CHECK_THROWS_AS(run_energy(scene, serial(), one_setting(4)), Error);
}

TEST_CASE("a figure without a line says why", "[figures]")
{
    const CostStudy study = table({made("xpbd", 2, 1, 1e-3), made("xpbd", 4, 1, 2.5e-4)}, 1e-6);
    const Plot plot = convergence_plot(study, CostSplit::iterations);
    CHECK(plot.series.empty());
    CHECK(plot.caption.back() == "No method has two settings that differ in their iterations alone.");
}
