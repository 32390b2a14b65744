// taut tetrahedralise: a closed surface becomes a solid, by a program that is installed.

#include "taut/cli/closed_surface.hpp"
#include "taut/cli/command.hpp"
#include "taut/cli/mesher.hpp"
#include "taut/cli/numbers.hpp"
#include "taut/cli/output.hpp"
#include "taut/cli/process.hpp"
#include "taut/plan/surface.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/write_solid.hpp"
#include "taut/version.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <utility>

namespace fs = std::filesystem;

namespace taut::cli {
namespace {

struct TetrahedraliseCommand
{
    std::string surface, out, program;
    double max_volume = 0;
    bool limited = false, json = false;
};

/// The share by which the result's volume may differ from that within the surface.
constexpr double kVolumeTolerance = 0.01;

/// What a program made is not sound: not the fault of the input, so not an Error of a code.
struct Unsound
{
    std::string sentence;
};

fs::path out_file(const TetrahedraliseCommand& command)
{
    fs::path out = command.out;
    if (out.empty())
        out = fs::path(command.surface).stem().string() + ".mesh";
    if (out.extension() != ".mesh")
        throw Error(ErrorCode::bad_input,
                    "--out names " + out.string() +
                        "; what is written is Medit text, so its name must end in .mesh.");
    std::error_code ignored;
    if (fs::is_directory(out, ignored))
        throw Error(ErrorCode::bad_input, "--out names the folder " + out.string() + "; name a file.");
    return out;
}

std::pair<Mesher, fs::path> choose_mesher(const std::string& wanted)
{
    std::string names;
    for (const Mesher& mesher : meshers())
    {
        if (!wanted.empty() && mesher.name != wanted)
            continue;
        if (const auto found = find_program(mesher.name))
            return {mesher, *found};
        names += (names.empty() ? "" : " or ") + mesher.name;
    }
    throw Error(ErrorCode::unsupported,
                "there is no program " + names +
                    " in the folders of PATH; install one (Debian, Ubuntu: apt install tetgen, or gmsh; "
                    "https://tetgen.org, https://gmsh.info) or give a scene a file of tetrahedra.");
}

void check_solid(const Mesh& solid, double volume, const std::string& name)
{
    if (const std::size_t open = unpaired_edges(solid.triangles).size(); open > 0)
        throw Unsound{"the result of " + name + " has a surface that is not closed at " +
                      counted(open, "edge", "edges") + "; another program may do better (--program)."};
    const double filled = enclosed_volume(solid.triangles, solid.positions);
    if (!(std::abs(filled - volume) <= kVolumeTolerance * volume))
        throw Unsound{"the result of " + name + " fills " + shown(filled, 4) + ", the surface encloses " +
                      shown(volume, 4) +
                      "; they may differ by 1 %. Does the surface cut itself, or hold another?"};
}

Mesh fill(const Mesh& surface, double volume, const std::pair<Mesher, fs::path>& mesher, double max_volume,
          MeshFindings& findings)
{
    const std::string& name = mesher.first.name;
    const TemporaryFolder folder;
    const auto arguments = mesher.first.prepare(folder.path(), surface, max_volume);
    const ProcessEnd end = run_process(mesher.second, arguments, folder.path());
    const std::string said = end.last_words.empty() ? "." : "; it said: " + end.last_words;
    if (end.interrupted)
        throw Unsound{"interrupted; nothing was written."};
    if (!end.failure.empty())
        throw Unsound{name + " ended with " + end.failure + said};
    const fs::path result = folder.path() / mesher.first.result;
    std::error_code ignored;
    if (!fs::exists(result, ignored))
        throw Unsound{name + " left no " + mesher.first.result + said};
    Mesh solid;
    try
    {
        solid = read_tetrahedra(result, &findings);
    }
    catch (const Error& error)
    {
        throw Unsound{"the result of " + name + " is not sound: " + error.what()};
    }
    check_solid(solid, volume, name);
    return solid;
}

double largest_volume(const Mesh& solid)
{
    double largest = 0;
    for (const auto& corners : solid.tetrahedra)
        largest = std::max(largest, six_volumes(solid.positions, corners) / 6);
    return largest;
}

struct Made
{
    fs::path program, file;
    double surface_volume;
    std::vector<std::string> messages; ///< what the surface was warned of for
};

void show(const TetrahedraliseCommand& command, Made made, const Mesh& solid, const MeshFindings& findings)
{
    const double filled = enclosed_volume(solid.triangles, solid.positions), largest = largest_volume(solid);
    if (command.limited && largest > command.max_volume)
    {
        made.messages.push_back("the largest tetrahedron has a volume of " + number(largest) +
                                ", above --max-volume " + number(command.max_volume) +
                                "; programs take it as an aim, so a smaller value helps.");
        warn(made.messages.back());
    }
    if (command.json)
        std::cout << to_text({{"taut", TAUT_VERSION},
                              {"surface", command.surface},
                              {"program", made.program.string()},
                              {"file", made.file.string()},
                              {"vertices", solid.positions.size()},
                              {"tetrahedra", solid.tetrahedra.size()},
                              {"surface_triangles", solid.triangles.size()},
                              {"turned_tetrahedra", findings.turned_tetrahedra},
                              {"volume", filled},
                              {"surface_volume", made.surface_volume},
                              {"largest_volume", largest},
                              {"messages", made.messages}});
    else
        std::cout << made.file.string() << ": " << solid.positions.size() << " vertices, "
                  << solid.tetrahedra.size() << " tetrahedra by " << made.program.filename().string()
                  << ", volume " << number(filled) << " of " << number(made.surface_volume) << "\n";
}

int tetrahedralise(const TetrahedraliseCommand& command)
{
    const fs::path out = out_file(command);
    const ClosedSurface surface = read_closed_surface(command.surface);
    const auto mesher = choose_mesher(command.program);
    check_writable(out);
    MeshFindings findings;
    const Mesh solid = fill(surface.mesh, surface.volume, mesher, command.max_volume, findings);
    write_medit(out, solid);
    show(command, {mesher.second, out, surface.volume, surface.messages}, solid, findings);
    return kDone;
}

} // namespace

void add_tetrahedralise(CLI::App& app, Command& chosen)
{
    CLI::App* command = app.add_subcommand(
        "tetrahedralise", "Fill a closed surface with tetrahedra, by TetGen or Gmsh if one is installed");
    const auto options = std::make_shared<TetrahedraliseCommand>();
    command->add_option("surface", options->surface, "Surface (.obj, .ply, .off, .stl)")->required();
    command->add_option("--out", options->out, "File to write (.mesh); default: the surface's name, here");
    CLI::Option* limit =
        command->add_option("--max-volume", options->max_volume,
                            "Largest volume of a tetrahedron, in the cube of the file's unit");
    limit->check(number_between(0, std::numeric_limits<double>::infinity(), Ends::open));
    command->add_option("--program", options->program, "tetgen or gmsh; default: the first that is installed")
        ->check(CLI::IsMember({"tetgen", "gmsh"}));
    command->add_flag("--json", options->json, "Print one JSON object");
    command->callback([&chosen, options, limit] {
        options->limited = limit->count() > 0;
        chosen = [options] {
            try
            {
                return tetrahedralise(*options);
            }
            catch (const Unsound& result)
            {
                std::cout.flush();
                std::cerr << "taut: " << result.sentence << "\n";
                return static_cast<int>(kNotSound);
            }
        };
    });
}

} // namespace taut::cli
