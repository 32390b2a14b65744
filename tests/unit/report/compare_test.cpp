#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/report/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace taut;

namespace {

/// 36 vertices that hang by two corners, one of them pulled to the side.
Scene hanging(const std::string& method)
{
    Scene scene = resolve(parse_scene(R"({"taut": 1, "duration": 1,
        "method": {"type": ")" + method + R"(", "substeps": 2, "precision": "double"},
        "bodies": [{"grid": {"cells": [5, 5]}, "material": {"stretch_stiffness": 200},
                    "pins": [{"corners": ["top_left"]},
                             {"corners": ["top_right"],
                              "motion": [{"time": 0}, {"time": 0.5, "translate": [0.02, 0, 0]}]}]}]})"));
    scene.method.stability = StabilityRule::substep;
    return scene;
}

/// `damping`: of the springs, s.
Residuals residual(const std::string& method, std::uint32_t iterations, double damping = 0)
{
    Scene scene = hanging(method);
    scene.bodies[0].material.stretch_damping = damping;
    scene.method.iterations = iterations;
    World world(scene, test_device("cpu:serial"));
    for (int step = 0; step < 5; ++step)
        world.step();
    return residuals_ahead(world);
}

std::size_t lines(const std::string& text)
{
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

} // namespace

TEST_CASE("what iterations leave unsolved falls to nothing, and other methods have no residual", "[compare]")
{
    for (const std::string method : {"vbd", "implicit_euler"})
    {
        CAPTURE(method);
        const double coarse = residual(method, 1).primal;
        const double fine = residual(method, method == "vbd" ? 1000 : 30).primal;
        CHECK(coarse > 1e-3);
        CHECK(fine < 1e-6 * coarse);
    }
    for (const std::string method : {"pbd", "mass_spring", "implicit_constraints", "acad"})
        CHECK(residuals_ahead(World(hanging(method), test_device("cpu:serial"))).primal == -1);
    // Of xpbd only the dual one does: its gradients are those of the places on the way (Macklin 2016, 4).
    const Residuals one = residual("xpbd", 1), many = residual("xpbd", 400);
    CHECK(one.primal >= 0);
    CHECK(one.dual > 1e-3);
    CHECK(many.dual < 1e-6 * one.dual);
    const Residuals damped = residual("xpbd", 400, 0.01);
    CHECK(damped.dual < 1e-6 * one.dual);
}

TEST_CASE("asking for residuals leaves the world as it is", "[compare]")
{
    World world(hanging("xpbd"), test_device("cpu:serial"));
    world.step();
    const auto before = world.positions();
    CHECK(residuals_ahead(world).dual >= 0);
    CHECK(world.positions() == before);
    CHECK(world.steps() == 1);
}

TEST_CASE("compare tabulates residuals and keeps a series over the frames", "[compare]")
{
    const auto device = test_device("cpu:serial");
    const auto rows = compare(
        {{"x", hanging("xpbd"), device}, {"a", hanging("acad"), device}, {"p", hanging("pbd"), device}}, 130);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].residuals.primal >= 0);
    CHECK(rows[0].residuals.dual >= 0);
    CHECK(rows[1].residuals.primal == -1);
    for (const CompareRow& row : rows)
        CHECK(row.series.size() == 66); // every second frame, and the start
    std::uint64_t sum = 0;
    for (const TimeSample& sample : rows[1].series)
        sum += sample.linear_iterations.value();
    CHECK(sum == rows[1].report.solver.iterations);
    CHECK(rows[1].series.back().active_share.value() == rows[1].report.active_share);
    CHECK_FALSE(rows[0].series.back().active_share.has_value());
    CHECK_FALSE(rows[0].series.back().linear_iterations.has_value());
    double worst = rows[1].series[0].max_stretch;
    for (const TimeSample& sample : rows[1].series)
        worst = std::max(worst, sample.max_stretch);
    CHECK(rows[1].worst_stretch == std::max(worst, 0.0));
    const std::string table = compare_csv(rows);
    CHECK(table.find(",residual,dual residual,") != std::string::npos);
    CHECK(table.find("\np,pbd,cpu:serial,") != std::string::npos);
    const std::string series = compare_series_csv(rows);
    CHECK(lines(series) == 1 + 3 * 66);
    CHECK(series.find("\nx,130,") != std::string::npos);
}

TEST_CASE("looks are at most 121 however long a run is, with start and end", "[compare]")
{
    for (const std::uint64_t frames : {0u, 1u, 59u, 60u, 119u, 120u, 1000u, 123457u})
    {
        TimeSeries samples(frames);
        std::uint64_t due = 0;
        for (std::uint64_t f = 0; f <= frames; ++f)
            due += samples.due(f);
        CHECK(samples.due(0));
        CHECK(samples.due(frames));
        CHECK(due <= 121);
        CHECK(due >= std::min<std::uint64_t>(frames + 1, 60));
    }
}

TEST_CASE("the largest stretch is that of the report", "[compare]")
{
    World world(hanging("mass_spring"), test_device("cpu:serial"));
    for (int step = 0; step < 7; ++step)
        world.step();
    CHECK(largest_stretch(scene_springs(world.scene()), world.positions()) == measure(world).max_stretch);
    CHECK(largest_stretch({}, {}) == 0);
}

TEST_CASE("compare knows the mean of a volume, and no strain where nothing is a spring", "[compare]")
{
    const Scene solid = resolve(parse_scene(R"({"taut": 1, "duration": 1, "method": {"type": "xpbd"},
        "bodies": [{"box": {"cells": [2, 2, 2]},
                    "material": {"model": "neo_hookean", "youngs_modulus": 1e4, "poissons_ratio": 0.3},
                    "pins": [{"faces": ["top"]}]}]})"));
    const auto rows = compare({{"n", solid, test_device("cpu:serial")}}, 30);
    REQUIRE(rows[0].refusal.empty());
    CHECK_FALSE(rows[0].springs);
    CHECK(rows[0].measured == rows[0].series.size());
    World world(solid, test_device("cpu:serial"));
    double sum = 1; // at the start
    for (int frame = 0; frame < 30; ++frame)
    {
        world.step();
        sum += measure(world).volume.ratio;
    }
    REQUIRE(rows[0].measured == 31);
    CHECK(rows[0].mean_volume == Approx(sum / 31).epsilon(1e-12));
    CHECK(rows[0].mean_volume > 1.0001); // it lengthens, and at this Poisson's ratio it grows
    const std::string table = compare_csv(rows);
    const std::string values = table.substr(table.find('\n') + 1);
    std::vector<std::string> cells(1);
    for (const char c : values)
        c == ',' ? cells.emplace_back() : cells.back() += c;
    CHECK_FALSE(cells[3].empty()); // the time
    CHECK((cells[4].empty() && cells[5].empty() && cells[6].empty()));
    CHECK_FALSE(cells[7].empty());
}

TEST_CASE("the curve of a comparison is the volume error where there are volumes, else the strain",
          "[compare]")
{
    const auto device = test_device("cpu:serial");
    const auto ball = [](const char* method) {
        return resolve(parse_scene(R"({"taut": 1, "duration": 1, "method": {"type": ")" +
                                   std::string(method) +
                                   R"("}, "bodies": [{"ball": {"cells": 4, "radius": 0.5},
                                       "material": {"model": "springs", "youngs_modulus": 1e4},
                                       "pins": [{"vertices": [0]}]}]})"));
    };
    auto rows = compare({{"x", ball("xpbd"), device}, {"p", ball("pbd"), device}}, 20);
    const Plot volumes = compare_series_plot("ball", rows);
    CHECK(volumes.title == "Volume error over time: ball");
    REQUIRE(volumes.series.size() == 2);
    CHECK(volumes.gaps.empty());
    double most = 0;
    for (std::size_t k = 0; k < rows[0].series.size(); ++k)
    {
        const double error = std::abs(1 - rows[0].series[k].volume.value());
        CHECK(volumes.series[0].points[k].y == std::max(error, 1e-5));
        CHECK(volumes.series[0].points[k].x == rows[0].series[k].time);
        most = std::max(most, error);
    }
    CHECK(most > 1e-5); // else nothing was drawn but the floor
    CHECK(1 - rows[0].smallest_volume <= most);
    const std::string csv = compare_series_csv(rows);
    CHECK(csv.find(",volume %\nx,0,0,") != std::string::npos);
    CHECK(compare_series_csv(compare({{"s", hanging("pbd"), device}}, 1)).find("volume") ==
          std::string::npos);

    // A run that went out of the numbers ends its curve, and says so.
    rows[0].series[5].volume = std::numeric_limits<double>::quiet_NaN();
    const Plot broken = compare_series_plot("ball", rows);
    CHECK(broken.series[0].points.size() == 5);
    REQUIRE(broken.gaps.size() == 1);
    CHECK(broken.gaps[0].find("x: no finite value from") == 0);

    // Neither refused variants nor such without springs have a curve of strain.
    Scene refused = hanging("pbd");
    refused.bodies[0].material.stretch_damping = 1;
    const Plot strains =
        compare_series_plot("cloth", compare({{"s", hanging("pbd"), device}, {"r", refused, device}}, 3));
    CHECK(strains.title == "Largest strain over time: cloth");
    REQUIRE(strains.series.size() == 1);
    REQUIRE(strains.gaps.size() == 1);
    CHECK(strains.gaps[0].find("r: unsupported") == 0);
}

TEST_CASE("a comparison that is stopped keeps what it has", "[compare]")
{
    const auto device = test_device("cpu:serial");
    const std::vector<Variant> variants = {{"first", hanging("xpbd"), device},
                                           {"second", hanging("pbd"), device},
                                           {"third", hanging("vbd"), device}};
    int asked = 0; // 11 times by the first
    const std::vector<CompareRow> rows = compare(variants, 10, [&] { return ++asked <= 16; });
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].report.time == Approx(10 * hanging("xpbd").timestep));
    CHECK(rows[1].report.status == Status::interrupted);
    CHECK(rows[1].report.time == Approx(4 * hanging("pbd").timestep));
    CHECK(rows[1].series.back().time == rows[1].report.time);
    CHECK_FALSE(rows[1].difference.has_value());
    CHECK(rows[2].refusal == "interrupted: not run");
    CHECK_THAT(compare_markdown(rows), Contains("not run") && !Contains("refused"));
}
