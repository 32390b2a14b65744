// taut run: what it writes, what it prints, how it ends.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

using program::Folder;
using program::Result;

namespace {

const std::vector<std::string> kRunKeys = {"device",
                                           "executor",
                                           "precision",
                                           "frames",
                                           "simulated_seconds",
                                           "vertices",
                                           "constraints",
                                           "colours",
                                           "status",
                                           "step_ms",
                                           "passes",
                                           "max_stretch",
                                           "rms_stretch",
                                           "penetration",
                                           "kinetic_energy",
                                           "potential_energy",
                                           "momentum_error",
                                           "primal_residual",
                                           "dual_residual",
                                           "position_hash",
                                           "warnings",
                                           "taut",
                                           "scene"};

void check_keys(const nlohmann::json& report)
{
    for (const std::string& key : kRunKeys)
    {
        INFO(key);
        CHECK(report.contains(key));
    }
    CHECK(report["step_ms"]["median"].is_number());
    CHECK(report["step_ms"]["p95"].is_number());
    CHECK(report["position_hash"].get<std::string>().size() == 16);
}

std::size_t count_lines(const std::string& text, const std::string& start)
{
    std::istringstream lines(text);
    std::string line;
    std::size_t count = 0;
    while (std::getline(lines, line))
        if (line.rfind(start, 0) == 0)
            ++count;
    return count;
}

} // namespace

TEST_CASE("run writes meshes and a report, and prints the same report as one JSON object")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "4", "--every",
                                       "1", "--out", folder / "o", "--json", "--no-picture"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(result.err.empty());
    const auto report = program::parse(result.out);
    check_keys(report);
    CHECK(report == program::parse(program::read(folder / "o/report.json")));
    CHECK(report["frames"] == 4);
    CHECK(report["executor"] == "cpu:serial");
    CHECK(report["precision"] == "float");
    CHECK(report["status"] == "completed");
    CHECK(report["vertices"] == 81);
    CHECK(report["constraints"]["distance"] == 208);
    CHECK(report["simulated_seconds"].get<double>() == Approx(4.0 / 60));
    CHECK(report["primal_residual"].get<double>() >= 0);
    CHECK(report["dual_residual"].get<double>() >= 0);
    const std::vector<std::string> files = {"mesh_00000.obj", "mesh_00001.obj", "mesh_00002.obj",
                                            "mesh_00003.obj", "mesh_00004.obj", "report.json"};
    CHECK(folder.list("o") == files);
}

TEST_CASE("meshes after a tear have its new vertices and all of their triangles")
{
    const Folder folder;
    const std::string scene = folder.file("tear.json", scenes::tearing_cloth());
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "40", "--every",
                                       "40", "--out", folder / "o", "--json", "--no-picture"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto report = program::parse(result.out);
    const auto torn = report["torn"].get<std::size_t>();
    CHECK(torn > 3);
    CHECK(report["vertices"] == 25 + torn);
    const std::string first = program::read(folder / "o/mesh_00000.obj"),
                      last = program::read(folder / "o/mesh_00001.obj");
    CHECK(count_lines(first, "v ") == 25);
    CHECK(count_lines(last, "v ") == 25 + torn);
    CHECK(count_lines(first, "f ") == 32);
    CHECK(count_lines(last, "f ") == 32);
}

TEST_CASE("passes are named by effect, with their dispatches")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const auto plan = program::parse(folder.taut({"plan", scene, "--json"}).out);
    const Result result =
        folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "2", "--json", "--no-picture"});
    REQUIRE(result.status == 0);
    const auto report = program::parse(result.out);
    std::set<std::string> planned, timed;
    for (const auto& effect : plan["effects"])
        if (effect["dispatches_per_step"] != 0)
            planned.insert(effect["name"].get<std::string>());
    for (const auto& pass : report["passes"])
    {
        timed.insert(pass["name"].get<std::string>());
        CHECK(pass["ms"].get<double>() >= 0);
        CHECK(pass["dispatches"].get<int>() > 0);
    }
    CHECK(timed == planned);
}

TEST_CASE("a mesh file holds every body under its own name")
{
    const Folder folder;
    const std::string scene = folder.file("two.json", scenes::two_bodies());
    REQUIRE(folder
                .taut({"run", scene, "--device", "cpu:serial", "--frames", "1", "--out", folder / "o",
                       "--no-picture"})
                .status == 0);
    const std::string mesh = program::read(folder / "o/mesh_00000.obj");
    CHECK(count_lines(mesh, "v ") == 9 + 4);
    CHECK(count_lines(mesh, "f ") == 8);
    CHECK(count_lines(mesh, "l ") == 3);
    CHECK(mesh.find("o upper_cloth\n") != std::string::npos);
    CHECK(mesh.find("o body_1\n") != std::string::npos);
    CHECK(mesh.find("l 10 11\n") != std::string::npos);
}

TEST_CASE("the same run again gives the same positions, and a shorter one leaves no older meshes")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const auto run = [&](const char* frames) {
        const Result result = folder.taut({"run", scene, "--device", "cpu", "--frames", frames, "--every",
                                           "1", "--out", folder / "o", "--json", "--no-picture"});
        REQUIRE(result.status == 0);
        return program::parse(result.out);
    };
    const auto first = run("5"), second = run("5");
    CHECK(first["position_hash"] == second["position_hash"]);
    CHECK(folder.list("o").size() == 7);
    run("2");
    const std::vector<std::string> files = {"mesh_00000.obj", "mesh_00001.obj", "mesh_00002.obj",
                                            "report.json"};
    CHECK(folder.list("o") == files);
}

TEST_CASE("without --out, files go to out/<scene> of the working folder")
{
    const Folder folder;
    folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut(
        {"run", "cloth.json", "--device", "cpu:serial", "--frames", "1", "--every", "0", "--no-picture"});
    REQUIRE(result.status == 0);
    CHECK(folder.list("out/cloth") == std::vector<std::string>{"report.json"});
    CHECK(result.out.find("out/cloth/report.json") != std::string::npos);
}

TEST_CASE("no frames at all is a run too")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut(
        {"run", scene, "--device", "cpu:serial", "--frames", "0", "--out", folder / "o", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto report = program::parse(result.out);
    CHECK(report["frames"] == 0);
    CHECK(report["simulated_seconds"] == 0);
    CHECK(report["load_residual"].is_null()); // nothing was solved, so nothing was left unsolved
    const Result further = folder.taut(
        {"run", scene, "--device", "cpu:serial", "--frames", "1", "--out", folder / "o", "--json"});
    CHECK(program::parse(further.out)["load_residual"].is_number());
}

TEST_CASE("a run whose result is not sound ends with status 1 and reports all the same")
{
    const Folder folder;
    const std::string scene = folder.file("lost.json", scenes::lost_cloth());
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "2", "--json"});
    INFO(result.err);
    CHECK(result.status == 1);
    const auto report = program::parse(result.out);
    check_keys(report);
    CHECK(report["status"] == "diverged");
    CHECK(report == program::parse(program::read(folder / "out/lost/report.json")));
}

TEST_CASE("pictures are PNG files, or a message says why there are none")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut(
        {"run", scene, "--device", "cpu:serial", "--frames", "3", "--out", folder / "o", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto report = program::parse(result.out);
    if (report["pictures"].empty())
    {
        const char* const required = std::getenv("TAUT_REQUIRE_DEVICE");
        CHECK_FALSE((required && std::string(required) == "1")); // then there is a device that draws
        const auto messages = report["messages"].get<std::vector<std::string>>();
        CHECK(std::any_of(messages.begin(), messages.end(),
                          [](const std::string& m) { return m.rfind("no pictures: ", 0) == 0; }));
        return;
    }
    CHECK(report["pictures"] == nlohmann::json({"picture.png", "contact_sheet.png"}));
    for (const char* name : {"o/picture.png", "o/contact_sheet.png"})
        CHECK(program::read(folder / name).rfind("\x89PNG", 0) == 0);
}

TEST_CASE("an interrupted run ends with what is done: a whole report that says so")
{
    const int signal = GENERATE(SIGINT, SIGTERM);
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    bool sent = false;
    // The third mesh is there: the loop over frames runs, and a hundred thousand frames are left.
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "1000000",
                                       "--every", "50", "--out", folder / "o", "--json"},
                                      [&](int process) {
                                          if (!sent && std::filesystem::exists(folder / "o/mesh_00002.obj"))
                                              sent = kill(process, signal) == 0;
                                      });
    INFO(result.err);
    REQUIRE(sent);
    CHECK(result.status == 0);
    const auto report = program::parse(program::read(folder / "o/report.json"));
    check_keys(report);
    CHECK(report["status"] == "interrupted");
    CHECK(report["frames"].get<int>() >= 100);
    CHECK(report["frames"].get<int>() < 1000000);
    CHECK(report["simulated_seconds"].get<double>() == Approx(report["frames"].get<double>() / 60));
    CHECK(report["meshes"].get<std::size_t>() >= 3);
    for (const std::string& name : folder.list("o"))
        CHECK(name.find(".tmp") == std::string::npos);
}

TEST_CASE("a hybrid run says which device did what, and ends where one device ends")
{
    const Folder folder;
    const std::string scene = folder.file("two.json", scenes::two_bodies());
    const auto report_of = [&](const std::string& device) {
        const Result result = folder.taut({"run", scene, "--device", device, "--frames", "5", "--no-picture",
                                           "--out", folder / "o", "--json"});
        INFO(result.err);
        REQUIRE(result.status == 0);
        return program::parse(result.out);
    };
    const auto hybrid = report_of("hybrid:cpu:serial"), alone = report_of("cpu:serial");
    check_keys(hybrid);
    CHECK(hybrid["executor"] == "hybrid");
    REQUIRE(hybrid["hybrid"].size() == 2);
    CHECK(hybrid["hybrid"][0]["bodies"].get<int>() + hybrid["hybrid"][1]["bodies"].get<int>() == 2);
    CHECK(hybrid["hybrid"][1]["executor"] == "cpu:serial");
    CHECK(hybrid["position_hash"] == alone["position_hash"]);
    CHECK_FALSE(alone.contains("hybrid"));
    CHECK(folder.taut({"run", scene, "--device", "hybrid:nowhere", "--json"}).status == 3);
}

TEST_CASE("a run of a method that solves linear systems has a series over its frames")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const auto report_of = [&](const std::string& device, const std::string& method, const char* frames) {
        const Result result = folder.taut({"run", scene, "--device", device, "--frames", frames,
                                           "--no-picture", "--out", folder / "o", "--json", "--set",
                                           "method.type=" + method, "--set", "method.stability=substep"});
        INFO(result.err);
        REQUIRE(result.status == 0);
        return program::parse(result.out);
    };
    CHECK(report_of("cpu:serial", "xpbd", "3")["series"].is_null());
    const auto acad = report_of("cpu:serial", "acad", "150");
    REQUIRE(acad["series"].size() == 76); // every second frame, and the start
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < acad["series"].size(); ++k)
    {
        const auto& look = acad["series"][k];
        CHECK(look["frame"] == 2 * k);
        CHECK(look["time"].get<double>() == Approx(static_cast<double>(2 * k) / 60).margin(1e-9));
        CHECK(look["active_share"].get<double>() >= 0);
        CHECK(look["active_share"].get<double>() <= 1);
        sum += look["linear_iterations"].get<std::uint64_t>();
    }
    CHECK(sum == acad["solver"]["iterations"]);
    CHECK(acad["series"].back()["active_share"] == acad["active_share"]);
    CHECK(acad["series"].back()["max_stretch"] == acad["max_stretch"]);
    const auto implicit = report_of("cpu:serial", "implicit_euler", "5");
    REQUIRE(implicit["series"].size() == 6);
    CHECK(implicit["series"][5]["active_share"].is_null());
    CHECK(implicit["series"][5]["linear_iterations"].get<int>() > 0);
}

TEST_CASE("meshes and pictures of a solid show the surface that it carries")
{
    const Folder folder;
    folder.file("fine.obj", "v 0.1 0 0\nv 0 0.1 0\nv -0.1 0 0\nv 0 0 0.2\n"
                            "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    const std::string scene = folder.file("solid.json", R"({"taut": 1, "gravity": [0, -2, 0], "bodies": [
        {"grid": {"cells": [1, 1]}},
        {"name": "solid", "box": {"cells": [2, 2, 2]}, "embedded": "fine.obj"}]})");
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "60", "--every",
                                       "60", "--out", folder / "o", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(program::parse(result.out)["vertices"] == 4 + 27);
    for (const std::string name : {"o/mesh_00000.obj", "o/mesh_00001.obj"})
    {
        const std::string text = program::read(folder / name);
        CHECK(count_lines(text, "v ") == 4 + 4);
        CHECK(count_lines(text, "f ") == 2 + 4);
        CHECK(count_lines(text, "f 5 7 6") == 1); // numbered behind the cloth's
    }
    // It falls with the box: a second of 2 m/s^2.
    std::istringstream lines(program::read(folder / "o/mesh_00001.obj"));
    std::string line;
    std::vector<double> heights;
    while (std::getline(lines, line))
        if (line.rfind("v ", 0) == 0)
        {
            std::istringstream numbers(line.substr(2));
            double x = 0, y = 0;
            numbers >> x >> y;
            heights.push_back(y);
        }
    REQUIRE(heights.size() == 8);
    CHECK(heights[4] == Approx(-1).epsilon(0.02));
    CHECK(heights[5] == Approx(-0.9).epsilon(0.02));
}

TEST_CASE("meshes of a float run far from the origin show what the world keeps")
{
    const Folder folder;
    const std::string scene = folder.file("far.json", R"({"taut": 1, "duration": 0.1, "gravity": [0, 0, 0],
        "bodies": [{"grid": {"cells": [3, 3], "size": [0.301234, 0.3]},
                    "transform": {"translate": [1e6, 0, 0]}}]})");
    const Result result =
        folder.taut({"run", scene, "--device", "cpu:serial", "--out", folder / "o", "--no-picture"});
    REQUIRE(result.status == 0);
    std::istringstream mesh(program::read(folder / "o/mesh_00000.obj"));
    double least = 1e9, most = 0;
    for (std::string line; std::getline(mesh, line);)
        if (line.starts_with("v "))
        {
            const double x = std::stod(line.substr(2));
            least = std::min(least, x);
            most = std::max(most, x);
        }
    CHECK(most - least == Approx(0.301234).margin(1e-6));
}
