// Studies over several methods: designs, ranking by method, refusals, references that favour nobody.
#include "support/catch.hpp"

#include "support/scenes.hpp"
#include "taut/report/cost.hpp"
#include "taut/report/cost_design.hpp"
#include "taut/report/method_settings.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <set>

using namespace taut;

namespace {

std::vector<MethodKind> all_methods() { return methods_listed({"all"}); }

Scene damped_chain()
{
    Scene scene = test::chain(6, 200, 0.05, 0.6);
    scene.damping = 6;
    return scene;
}

CostPoint made(const std::string& method, std::optional<double> error, double ms, double sweeps = 60)
{
    CostPoint point;
    point.method = method;
    point.settings.type = option_named<MethodKind>(method);
    point.error = error;
    point.ms = ms;
    point.sweeps = sweeps;
    return point;
}

CostPoint refusing(const std::string& method)
{
    CostPoint point = made(method, std::nullopt, 0);
    point.refused = "unstable_timestep";
    point.reason = "a substep of 4 ms is too long";
    return point;
}

CostStudy table(std::vector<CostPoint> points, CostBasis basis = CostBasis::wall)
{
    CostStudy study;
    study.metric = "e_disp";
    study.reference.name = "R2";
    study.basis = basis;
    study.points = std::move(points);
    rank(study);
    return study;
}

CostOptions two_methods()
{
    CostOptions options;
    options.methods = {MethodKind::pbd, MethodKind::xpbd};
    options.substeps = {5, 20};
    options.iterations = {1};
    options.precisions = {Precision::float64};
    options.timing_seconds = 0; // one repetition
    return options;
}

} // namespace

TEST_CASE("a design has at most 20 settings, all different, of at most 256 sweeps a frame", "[methods]")
{
    for (const MethodKind kind : all_methods())
    {
        INFO(to_string(kind));
        const std::vector<MethodSettings> design = method_design(kind, Precision::float32);
        CHECK(design.size() <= 20);
        std::set<std::string> blocks;
        std::set<std::uint32_t> substeps;
        for (const MethodSettings& settings : design)
        {
            CHECK(settings.type == kind);
            CHECK(settings.substeps * settings.iterations <= 256);
            CHECK(settings.substeps <= 128);
            CHECK(settings.iterations <= 64);
            CHECK(settings.stability == StabilityRule::refuse);
            blocks.insert(settings_block(settings));
            substeps.insert(settings.substeps);
        }
        CHECK(blocks.size() == design.size());
        CHECK(substeps.size() >= 6); // an order of convergence can be seen
    }
}

TEST_CASE("a block is what a scene takes as its method, and gives the same settings", "[methods]")
{
    for (const MethodKind kind : all_methods())
        for (const MethodSettings& settings : method_design(kind, Precision::float64))
        {
            const std::string block = settings_block(settings);
            INFO(block);
            const Scene scene =
                parse_scene(R"({"taut": 1, "bodies": [{"grid": {}}], "method": )" + block + "}");
            CHECK(settings_block(scene.method) == block);
            CHECK(check(scene).empty());
            CHECK(scene.method.substeps == settings.substeps);
            CHECK(scene.method.precision == Precision::float64);
            if (kind == MethodKind::mass_spring)
                CHECK(scene.method.integrator == settings.integrator);
            if (kind == MethodKind::acad)
                CHECK(scene.method.release_strain == settings.release_strain);
        }
}

TEST_CASE("details name what a method reads and is not as usual, and nothing else", "[methods]")
{
    MethodSettings settings;
    settings.type = MethodKind::vbd;
    settings.start = SweepStart::inertial;
    settings.integrator = Integrator::verlet; // not vbd's
    CHECK(settings_details(settings) == "start inertial");
    CHECK(settings_text(settings) ==
          "vbd, automatic substeps x automatic iterations in float, start inertial");
    settings.iterations = 1;
    settings.substeps = 1;
    CHECK(settings_text(settings) == "vbd, 1 substep x 1 iteration in float, start inertial");
    settings.substeps = 0;
    settings.type = MethodKind::mass_spring;
    CHECK(settings_text(settings) == "mass_spring, automatic substeps in float, integrator verlet");
    settings.compress = true; // not mass_spring's
    CHECK(settings_details(settings) == "integrator verlet");
    settings.type = MethodKind::acad;
    CHECK(settings_details(settings) == "integrator verlet, compress true");
    CHECK(parse_scene(R"({"taut": 1, "method": )" + settings_block(settings) + "}").method.compress);
}

TEST_CASE("methods are listed once, in one order; a wrong name says which there are", "[methods]")
{
    CHECK(methods_listed({"xpbd", "pbd", "xpbd"}) ==
          std::vector<MethodKind>{MethodKind::pbd, MethodKind::xpbd});
    CHECK(all_methods().size() == kWords<MethodKind>.size());
    try
    {
        methods_listed({"xpdb"});
        FAIL("a wrong name was taken");
    }
    catch (const Error& error)
    {
        const std::string text = error.what();
        CHECK(text.find("\"xpdb\"") != std::string::npos);
        CHECK(text.find("\"xpbd\"") != std::string::npos);
    }
}

TEST_CASE("a product has every substep once for a method without iterations", "[methods]")
{
    const CostOptions options = two_methods();
    CostOptions more = options;
    more.iterations = {1, 2, 5};
    CHECK(method_product(MethodKind::mass_spring, Precision::float32, more).size() == 2);
    CHECK(method_product(MethodKind::xpbd, Precision::float32, more).size() == 6);
}

TEST_CASE("the cheapest setting is found for each method and for all", "[methods]")
{
    const CostStudy study = table({made("pbd", 0.05, 1), made("xpbd", 0.05, 3), made("xpbd", 5e-3, 7),
                                   made("xpbd", 6e-3, 6), refusing("mass_spring")});
    REQUIRE(study.methods.size() == 3);
    CHECK(study.methods[0].targets[0].cheapest == 0u);
    CHECK_FALSE(study.methods[0].targets[1].cheapest.has_value());
    CHECK(study.methods[1].targets[1].cheapest == 3u);
    CHECK(study.methods[2].refused == "unstable_timestep: a substep of 4 ms is too long");
    CHECK(study.methods[0].refused.empty());
    CHECK(study.targets[1].cheapest == 3u);
    const auto rows = cost_table(study);
    REQUIRE(rows.size() == 4);
    CHECK(rows[1][1] == "1");
    CHECK(rows[1][4] == "-");
    CHECK(rows[2][4] == "6");
    CHECK(rows[3][1] == "R");
    CHECK(cost_sentences(study)[1] ==
          "1 %: xpbd, 1 substep x 1 iteration in float, 6 ms per simulated second (e_disp 0.6 %).");
}

TEST_CASE("a cheapest setting of another material is named as one, beside the cheapest that is not",
          "[methods]")
{
    std::vector<CostPoint> points{made("pbd", 5e-3, 1), made("xpbd", 6e-3, 3), made("vbd", 5e-3, 4)};
    points[0].other_material = "pbd does not have the material's stiffness";
    const CostStudy study = table(points);
    CHECK(study.targets[1].cheapest == 0u);
    CHECK(study.targets[1].own == 1u);
    CHECK(cost_sentences(study)[1] ==
          "1 %: pbd, 1 substep x 1 iteration in float, 1 ms per simulated second (e_disp 0.5 %); of another "
          "material: pbd does not have the material's stiffness; with the scene's own xpbd, 1 substep x 1 "
          "iteration in float, 3 ms per simulated second (e_disp 0.6 %).");
    points[1].error = points[2].error = 0.5;
    CHECK_THAT(cost_sentences(table(points))[1], Contains("with the scene's own it is not reached."));
    points.resize(1);
    CHECK_THAT(cost_sentences(table(points))[1], Contains("no method with the scene's own was tried."));
    const auto json = nlohmann::json::parse(cost_json(study));
    CHECK(json["cheapest"]["0.01"]["other_material"] == points[0].other_material);
    CHECK(json["cheapest"]["0.01"]["own_material"]["method"] == "xpbd");
    CHECK(json["cheapest"]["0.001"].is_null());
}

TEST_CASE("a study tells which method moves another material", "[methods]")
{
    CostOptions options = two_methods();
    const CostStudy study = run_cost(damped_chain(), Device::open("cpu:serial"), options);
    for (const CostPoint& point : study.points)
        CHECK(point.other_material.empty() == (point.method != "pbd"));
}

TEST_CASE("cheaper can mean time, process time or work", "[methods]")
{
    std::vector<CostPoint> points{made("pbd", 5e-3, 1, 900), made("xpbd", 5e-3, 2, 600),
                                  made("vbd", 5e-3, 3, 700)};
    points[0].cpu_ms = 5;
    points[1].cpu_ms = 4;
    points[2].cpu_ms = 3.5;
    CHECK(table(points, CostBasis::wall).targets[1].cheapest == 0u);
    CHECK(table(points, CostBasis::cpu).targets[1].cheapest == 2u);
    CHECK(table(points, CostBasis::sweeps).targets[1].cheapest == 1u);
}

TEST_CASE("one line a method, through its own front; gaps of one cause stand together", "[methods]")
{
    const CostStudy study = table({made("pbd", 0.05, 1), made("xpbd", 0.05, 3), made("xpbd", 0.08, 7),
                                   made("xpbd", 6e-3, 6), refusing("mass_spring"), refusing("mass_spring")});
    const Plot plot = cost_plot(study, CostAxis::time);
    REQUIRE(plot.series.size() == 2);
    CHECK(plot.series[1].name == "xpbd");
    CHECK(plot.series[1].own_front);
    CHECK(plot.series[0].style == method_style(MethodKind::pbd)); // whatever else is in the plot
    CHECK(plot.series[1].style == method_style(MethodKind::xpbd));
    CHECK(plot.series[1].points.size() == 3);
    REQUIRE(plot.gaps.size() == 1);
    CHECK(plot.gaps[0].find("mass_spring (R, unstable_timestep)") == 0);
    CHECK(plot.gaps[0].find("too long") != std::string::npos);
    const std::string drawn = svg(plot);
    CHECK(drawn.find("stroke-width=\"2.60\"") != std::string::npos);
    const std::size_t from = drawn.find("stroke-width=\"2.60\"");
    const std::size_t line = drawn.rfind("<polyline", from);
    const std::string points = drawn.substr(line, from - line);
    CHECK(std::count(points.begin(), points.end(), ',') == 2); // the dominated point is not on the line
}

TEST_CASE("a study of two methods measures both against the one reference", "[methods]")
{
    const CostStudy study = run_cost(damped_chain(), Device::open("cpu:serial"), two_methods());
    INFO(study.reference.text);
    CHECK(study.reference.name == "R2");
    REQUIRE(study.points.size() == 4);
    CHECK(study.points[0].method == "pbd");
    CHECK(study.points[3].method == "xpbd");
    REQUIRE(study.points[3].error.has_value());
    CHECK(*study.points[3].error < *study.points[2].error);
    const auto json = nlohmann::json::parse(cost_json(study));
    CHECK(json["methods"].contains("pbd"));
    CHECK(json["methods"]["xpbd"]["cheapest"].contains("0.01"));
    CHECK(json["points"][3]["settings"]["substeps"] == 20);
    CHECK(json["points"][3]["refused"].is_null());
    CHECK(cost_csv(study).find(",details,refused,") != std::string::npos);
}

TEST_CASE("every method of a study has points or says why not", "[methods]")
{
    CostOptions options = two_methods();
    options.methods = all_methods();
    options.substeps = {4};
    options.precisions = {Precision::float32};
    Scene rigid = damped_chain();
    rigid.damping = 0;
    rigid.duration = 0.1;
    rigid.bodies[0].velocity = {1, 0, 0};
    rigid.bodies[0].material.stretch_stiffness = std::numeric_limits<double>::infinity();
    const CostStudy study = run_cost(rigid, Device::open("cpu:serial"), options);
    CHECK(study.methods.size() == kWords<MethodKind>.size());
    for (const CostPoint& point : study.points)
    {
        INFO(point.method << ": " << point.reason);
        CHECK((point.error.has_value() || !point.reason.empty()));
        CHECK((point.refused.empty() || !point.error));
    }
    const auto mass_spring = std::find_if(study.methods.begin(), study.methods.end(),
                                          [](const CostMethod& m) { return m.name == "mass_spring"; });
    REQUIRE(mass_spring != study.methods.end());
    CHECK_FALSE(mass_spring->refused.empty()); // rigid springs are no springs
}

TEST_CASE("with several methods the fallback reference names its method and who confirms it", "[methods]")
{
    Scene rigid = damped_chain();
    rigid.damping = 0;
    rigid.duration = 0.1;
    rigid.bodies[0].velocity = {1, 0, 0};
    rigid.bodies[0].material.stretch_stiffness = std::numeric_limits<double>::infinity();
    const CostStudy study = run_cost(rigid, Device::open("cpu:serial"), two_methods());
    INFO(study.reference.text);
    REQUIRE(study.reference.name.find("R4 (self-convergence of ") == 0);
    const bool confirmed = study.reference.text.find("counts as its error") != std::string::npos;
    const bool warned = study.reference.text.find("no other method confirms it") != std::string::npos;
    CHECK(confirmed != warned);
}
