// The recovery table (methods, Appendix B): neo-Hookean cubes that start far from rest, under xpbd and
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
    scene.method.type = setting.method;
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

TEST_CASE("the recovery table: cubes find their shape, or what is said says that they do not [hard]",
          "[solid]")
{
    const bool only_some = short_run();
    on_every_device([&](const auto& device) {
        const bool whole = device->info().executor == "cpu:serial";
        std::string page = "| start |";
        for (const Setting& s : kSettings)
            page += " " + std::string(s.method) + " " + std::to_string(s.substeps) + " x " +
                    std::to_string(s.iterations) + " |";
        page += "\n|---|---|---|---|---|\n";
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
                    const int steps = whole && !(only_some && ratio > 0.4) ? 600 : 5;
                    const Outcome out = settle(under(setting, started(start, ratio)), device, steps);
                    CHECK(out.reads);
                    const std::string end = ending(out, ratio);
                    if (steps == 600 && !lost(start))
                        CHECK(end == "R");
                    cell += (cell.empty() ? "" : " / ") + end;
                    const std::string what = std::string(setting.method) + " " +
                                             std::to_string(setting.substeps) + " x " +
                                             std::to_string(setting.iterations) + " nu " +
                                             std::to_string(ratio).substr(0, 4) + ": highest energy / start";
                    note(start.name, *device, what.c_str(), out.highest);
                }
                page += " " + cell + " |";
            }
            page += "\n";
        }
        if (const char* file = std::getenv("TAUT_RECOVERY"); file && whole)
            write_file(file, page);
    });
}
