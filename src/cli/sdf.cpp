// taut sdf: a closed surface becomes a grid of signed distances to it, for colliders.

#include "taut/cli/closed_surface.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/judge/mesh_distance.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/version.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct SdfCommand
{
    std::string surface, out;
    std::uint32_t cells = 64;
    double cell = 0;   ///< 0: by `cells`
    double margin = 0; ///< with given_margin; else two cells
    bool given_margin = false, json = false;
};

constexpr double kMostPoints = 1 << 28; ///< a gigabyte of values

fs::path out_file(const SdfCommand& command)
{
    fs::path out = command.out;
    if (out.empty())
        out = fs::path(command.surface).stem().string() + ".sdf";
    std::error_code ignored;
    if (fs::is_directory(out, ignored))
        throw Error(ErrorCode::bad_input, "--out names the folder " + out.string() + "; name a file.");
    if (fs::equivalent(out, command.surface, ignored))
        throw Error(ErrorCode::bad_input, "--out names the surface itself, " + out.string() + ".");
    return out;
}

/// Edges of the box round the surface.
glm::dvec3 extent_of(const Mesh& surface)
{
    glm::dvec3 low = surface.positions.front(), high = low;
    for (const glm::dvec3& p : surface.positions)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    return high - low;
}

void check_points(const glm::dvec3& extent, double cell, double margin)
{
    double points = 1;
    for (int axis = 0; axis < 3; ++axis)
        points *= (extent[axis] + 2 * margin) / cell + 2;
    if (!(points <= kMostPoints))
        throw Error(ErrorCode::bad_input, "cells of " + shown(cell) + " with a margin of " + shown(margin) +
                                              " would be " + shown(points, 3) +
                                              " points; there may be 2^28. Take larger cells, or fewer.");
}

/// Share of the area whose triangles have nothing inside them in the grid, a quarter of a cell below their
/// middle: parts that are thinner than cells.
double lost_share(const Mesh& surface, const DistanceField& field)
{
    double lost = 0, all = 0;
    for (const auto& t : surface.triangles)
    {
        const glm::dvec3 &a = surface.positions[t[0]], &b = surface.positions[t[1]],
                         &c = surface.positions[t[2]];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        const double area = glm::length(normal);
        all += area;
        if (area > 0 && field.distance((a + b + c) / 3.0 - 0.25 * field.cell / area * normal) >= 0)
            lost += area;
    }
    return lost / all;
}

constexpr double kLost = 0.002; ///< what sharp edges may lose without a warning

void show(const SdfCommand& command, const fs::path& out, const DistanceField& field, double lost,
          std::vector<std::string> messages)
{
    if (lost > kLost)
    {
        messages.push_back(
            "the grid has lost what lies below " + shown(100 * lost, 2) +
            " % of the surface: parts thinner than its cells. Smaller cells (--cells, --cell) keep them.");
        warn(messages.back());
    }
    if (command.json)
    {
        std::cout << to_text({{"taut", TAUT_VERSION},
                              {"surface", command.surface},
                              {"file", out.string()},
                              {"points", field.points},
                              {"low", {field.low.x, field.low.y, field.low.z}},
                              {"cell", field.cell},
                              {"depth", field.depth()},
                              {"lost", lost},
                              {"messages", messages}});
        return;
    }
    std::cout << out.string() << ": " << field.points[0] << " x " << field.points[1] << " x "
              << field.points[2] << " points, " << number(field.cell) << " apart; the deepest lies "
              << number(field.depth()) << " within\n";
}

int make_sdf(const SdfCommand& command)
{
    const fs::path out = out_file(command);
    const ClosedSurface read = read_closed_surface(command.surface);
    const Mesh& surface = read.mesh;
    const glm::dvec3 extent = extent_of(surface);
    const double longest = std::max({extent.x, extent.y, extent.z});
    const double cell = command.cell > 0 ? command.cell : longest / command.cells;
    const double margin = command.given_margin ? command.margin : 2 * cell;
    check_points(extent, cell, margin);
    check_writable(out);
    const judging::MeshDistance distance(surface.triangles, surface.positions);
    const DistanceField field = judging::make_distance_field(distance, surface.positions, cell, margin);
    if (const std::string fault = fault_of(field); !fault.empty())
        throw Error(ErrorCode::bad_input,
                    command.surface + ": its grid " + fault +
                        ". Lengths are in the file's unit. Smaller cells (--cells, --cell) or a larger "
                        "--margin may help; a part that is wound inwards, and a surface that cuts itself, "
                        "have no inside.");
    write_distance_field(out, field);
    show(command, out, field, lost_share(surface, field), read.messages);
    return kDone;
}

} // namespace

void add_sdf(CLI::App& app, Command& chosen)
{
    CLI::App* command =
        app.add_subcommand("sdf", "Make a grid of signed distances to a closed surface, for a collider");
    const auto options = std::make_shared<SdfCommand>();
    constexpr double kNoEnd = std::numeric_limits<double>::infinity();
    command->add_option("surface", options->surface, "Surface (.obj, .ply, .off, .stl)")->required();
    command->add_option("--out", options->out, "File to write; default: the surface's name with .sdf, here");
    CLI::Option* cells =
        command->add_option("--cells", options->cells, "Cells along its longest side; default 64")
            ->check(CLI::Range(1, 4096));
    command->add_option("--cell", options->cell, "Edge of a cell, in the file's unit, instead of --cells")
        ->check(number_between(0, kNoEnd, Ends::open))
        ->excludes(cells);
    CLI::Option* margin =
        command
            ->add_option("--margin", options->margin,
                         "How far the grid goes beyond the surface, in the file's unit; default two cells")
            ->check(number_between(0, kNoEnd, Ends::open));
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options, margin] {
        options->given_margin = margin->count() > 0;
        chosen = [options] { return make_sdf(*options); };
    });
}

} // namespace taut::cli
