// The recovery table (docs/hard-cases.md): neo-Hookean cubes that start far from rest, under xpbd and
// implicit_euler (vbd: vbd_solid_test.cpp). TAUT_RECOVERY=file writes the table of docs/hard-cases.md.

#include "hard/solid_starts.hpp"

#include "taut/runtime/base/atomic_file.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

struct Setting
{
    const char* method;
    std::uint32_t substeps, iterations;
};

constexpr Setting kSettings[] = {
    {"xpbd", 1, 20}, {"xpbd", 20, 1}, {"implicit_euler", 1, 8}, {"implicit_euler", 4, 2}};

Scene under(const Setting& setting, Scene scene)
{
    scene.method = {};
    scene.method.type = option_named<MethodKind>(setting.method);
    scene.method.substeps = setting.substeps;
    scene.method.iterations = setting.iterations;
    scene.method.line_search = 8; // implicit_euler alone reads it
    return scene;
}

/// "R", what is left of it, or how it ended.
std::string ending(const Outcome& out, double ratio)
{
    const StepReport& r = out.report;
    char text[80];
    if (!out.reads)
        return "not finite";
    if (r.status != Status::completed)
        return std::string(to_string(r.status));
    if (r.volume.inverted == 0 && strain_of(r) < (ratio < 0.4 ? 1e-3 : 5e-3))
        return "R";
    if (r.volume.inverted == 0)
        std::snprintf(text, sizeof text, strain_of(r) < 0.05 ? "R, swings %.1g" : "strain %.2g",
                      strain_of(r));
    else
        std::snprintf(text, sizeof text, "%s: %d", r.warnings.count("degenerate") ? "degenerate" : "inverted",
                      int(r.volume.inverted));
    return text;
}

bool lost(const Start& start)
{
    return named(start, "B11 line") || named(start, "B12 point") || named(start, "B12 point + 1e-6");
}

std::vector<Start> all_starts()
{
    std::vector<Start> out(std::begin(kStarts), std::end(kStarts));
    out.insert(out.end(), std::begin(kExactStarts), std::end(kExactStarts));
    return out;
}

} // namespace

namespace {

/// A short run follows to the end what shows most; elsewhere than on cpu:serial a few steps are sound.
int steps_of(const Device& device, const Start& start, const Setting& setting, double ratio)
{
    const bool telling = ratio < 0.4 && setting.substeps == 1 && named(start, "B09 mirrored");
    return device.info().executor == "cpu:serial" && (!short_run() || telling) ? 600 : 2;
}

void check_end(const Start& start, const Setting& setting, double ratio, const Outcome& out)
{
    // Ten times too large it comes back slowly under xpbd with one sweep a substep. What sweeps leave
    // strained on the way is up to 45 times the start, chaotically; motion has less than a hundredth of it.
    const bool slow =
        named(start, "B14 x10") && std::string(setting.method) == "xpbd" && setting.iterations == 1;
    // Sweeps and solves that have not converged from the inertial guess let the energy rise a little where
    // the body opens from a hundredth of its size (vbd_solid_test.cpp too): 4.5e-5 was measured.
    if (slow)
        CHECK(out.kinetic <= 0.01);
    else
        CHECK(out.highest <= (named(start, "B14 x0.01") ? 1 + 1e-4 : 1 + 1e-5));
    if (lost(start))
    {
        CHECK(to_string(out.report.status) == "unconverged");
        CHECK(out.report.warnings.count("degenerate") == 1); // it says that nothing leads out
        return;
    }
    CHECK(out.report.volume.inverted == 0);
    if (!slow)
        CHECK((out.report.status == Status::completed) == (out.report.volume.inverted == 0));
    // With nu of 0.45 there are further shapes without a tangle (methods B13).
    if (ratio < 0.4 && !slow)
        CHECK(ending(out, ratio).substr(0, 1) == "R");
}

std::string heading()
{
    std::string out = "| start |", line = "\n|---|";
    for (const Setting& s : kSettings)
    {
        out += " " + std::string(s.method) + " " + std::to_string(s.substeps) + " x " +
               std::to_string(s.iterations) + " |";
        line += "---|";
    }
    return out + line + "\n";
}

} // namespace

TEST_CASE("the recovery table: cubes find their shape, or what is said says that they do not [hard]",
          "[solid]")
{
    on_every_device([&](const auto& device) {
        std::string page = heading();
        for (const Start& start : all_starts())
        {
            page += "| " + std::string(start.name) + " |";
            for (const Setting& setting : kSettings)
            {
                std::string cell;
                for (const double ratio : {0.3, 0.45})
                {
                    INFO(setting.method << " " << setting.substeps << " x " << setting.iterations << ", "
                                        << start.name << ", nu " << ratio);
                    const int steps = steps_of(*device, start, setting, ratio);
                    const Outcome out = settle(under(setting, started(start, ratio)), device, steps);
                    CHECK(out.reads);
                    CHECK(rank(out.report.status) < rank(Status::diverged));
                    if (steps == 600)
                        check_end(start, setting, ratio, out);
                    cell += (cell.empty() ? "" : " / ") + ending(out, ratio);
                }
                page += " " + cell + " |";
            }
            page += "\n";
        }
        if (const char* file = std::getenv("TAUT_RECOVERY"); file && device->info().executor == "cpu:serial")
            write_file(file, page);
    });
}

TEST_CASE("from twenty times its size single sweeps of xpbd are diverged; twenty at once take it back [hard]",
          "[solid]")
{
    const Start huge{"x20", [](const glm::dvec3& x, conformance::Random&) { return 20.0 * x; }};
    const auto device = test_device("cpu:serial");
    for (const double ratio : {0.3, 0.45})
    {
        CAPTURE(ratio);
        const Scene single = under({"xpbd", 20, 1}, started(huge, ratio));
        CHECK(judged_run(single, 60, device).status == Status::diverged);
        const Outcome out = settle(under({"xpbd", 1, 20}, started(huge, ratio)), device, 300);
        CHECK(out.highest <= 1 + 1e-5);
        CHECK(out.report.status == Status::completed);
        CHECK(out.report.volume.inverted == 0);
    }
}
