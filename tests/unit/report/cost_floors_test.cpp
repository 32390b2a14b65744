// Repetitions in turns, and the floors below which an error says nothing of the method.
#include "support/catch.hpp"

#include "cost_samples.hpp"
#include "taut/runtime/base/error.hpp"

using namespace taut;
using namespace samples;

TEST_CASE("settings are timed in turns: a study stopped on the way has repeated all alike", "[cost]")
{
    CostOptions options = only({5, 10, 20}, {1}, {Precision::float32});
    options.timing_seconds = 1000; // no limit here
    options.repeats = 10;
    const CostStudy whole = study_of(free_chain(), options);
    for (const CostPoint& point : whole.points)
    {
        CHECK(point.repetitions == 10);
        CHECK(point.ms_least <= point.ms_low);
        CHECK(point.ms_low <= point.ms);
        CHECK(point.ms <= point.ms_high);
        CHECK(point.cpu_low <= point.cpu_high);
    }
    std::size_t asked = 0; // once before each setting, then before each repetition
    options.progress = [&](std::size_t, std::size_t) { return ++asked <= 3 + 7; };
    const CostStudy stopped = study_of(free_chain(), options);
    CHECK(stopped.points[0].repetitions == 3);
    CHECK(stopped.points[1].repetitions == 2);
    CHECK(stopped.points[2].repetitions == 2);
    CHECK(
        cost_csv(whole).find("ms_quartile_1,ms_quartile_3,cpu_ms_quartile_1,cpu_ms_quartile_3,repetitions") !=
        std::string::npos);
}

TEST_CASE("the rest test is a floor of static errors: a stricter one shows what is below", "[cost]")
{
    CostOptions options = only({40}, {20}, {Precision::float64});
    options.methods = {MethodKind::vbd};
    const CostStudy usual = study_of(damped_chain(), options);
    options.rest_tolerance = 1e-12;
    options.rest_seconds = 60;
    const CostStudy strict = study_of(damped_chain(), options);
    INFO(usual.points[0].reason << strict.points[0].reason);
    REQUIRE((usual.points[0].error && strict.points[0].error));
    INFO(*usual.points[0].error << " " << *strict.points[0].error);
    CHECK(*usual.points[0].error < 1e-5);
    CHECK(usual.points[0].floor.find("rest") != std::string::npos);
    CHECK(*strict.points[0].error < 0.01 * *usual.points[0].error);
    CHECK(strict.points[0].simulated_seconds > usual.points[0].simulated_seconds);
    options.rest_tolerance = 1;
    CHECK_THROWS_AS(study_of(damped_chain(), options), Error);
}

TEST_CASE("floors are named, drawn, and told apart", "[cost]")
{
    CostStudy study = table({made(1, 0.05, 1), made(2, 5e-6, 2)}, 1e-8);
    study.kind = CostKind::at_rest;
    study.points[1].method = "implicit_euler";
    study.points[1].settings.type = MethodKind::implicit_euler;
    study.points[1].settings.linear_tolerance = 1e-4;
    rank(study);
    CHECK(study.points[0].floor.empty());
    CHECK(study.points[1].floor == "rest linear_tolerance");
    std::vector<std::string> words;
    for (const CostFloor& floor : cost_floors(study))
        words.push_back(floor.word);
    CHECK(words == std::vector<std::string>{"reference", "rest", "linear_tolerance", "float"});
    const Plot plot = cost_plot(study, CostAxis::time);
    REQUIRE(plot.floors.size() == 4);
    CHECK(plot.floors[1].y == 1e-5);
    CHECK(plot.floors[1].of_all);
    CHECK_FALSE(plot.floors[2].of_all); // other methods have no linear solve: no shade behind their points
    CHECK(plot.floors[1].words == "rest test, 1e-05");
    CHECK(svg(plot).find("rest test") != std::string::npos);
    CHECK(svg(plot).find("one rounding of double") == std::string::npos);
}

TEST_CASE("a study of both precisions draws both roundings, however far below its points", "[cost]")
{
    CostStudy study = table({made(1, 1e-6, 1), made(2, 1e-12, 2)}, 1e-16);
    study.points[1].precision = Precision::float64;
    const std::string both = svg(cost_plot(study, CostAxis::time));
    CHECK(both.find("one rounding of float") != std::string::npos);
    CHECK(both.find("one rounding of double") != std::string::npos); // four decades below all
    study.points.pop_back();
    CHECK(svg(cost_plot(study, CostAxis::time)).find("one rounding of double") == std::string::npos);
}
