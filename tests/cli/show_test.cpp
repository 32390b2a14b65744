// The commands that only show: plan, check, devices, --version, --help.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstdlib>
#include <set>

using program::Folder;
using program::Result;

TEST_CASE("plan lists effects whose dispatches add up, and writes nothing")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut({"plan", scene, "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto plan = program::parse(result.out);
    std::uint64_t dispatches = 0, bytes = 0;
    for (const auto& effect : plan["effects"])
    {
        dispatches += effect["dispatches_per_step"].get<std::uint64_t>();
        bytes += effect["bytes_allocated"].get<std::uint64_t>();
        CHECK(effect["name"].is_string());
        CHECK(effect["kernels"].is_array());
        CHECK(effect["bytes_per_step"].is_number_unsigned());
    }
    CHECK(plan["dispatches_per_step"] == dispatches);
    CHECK(plan["bytes_allocated"] == bytes);
    CHECK(plan["barriers_per_step"].get<std::uint64_t>() < dispatches);
    CHECK(plan["colours"]["distance"].get<int>() >= 4);
    CHECK(plan["constraints"]["distance"] == 208);
    CHECK(folder.list("").size() == 3); // the scene and the two captured streams
}

TEST_CASE("a plan for a device measures the device and names it")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut({"plan", scene, "--device", "cpu:serial", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(program::parse(result.out)["device"].is_string());
    const Result readable = folder.taut({"plan", scene});
    CHECK(readable.status == 0);
    CHECK(readable.out.find("distance") != std::string::npos);
}

TEST_CASE("a plan for a device tells the memory that a run on it reports, and without one none")
{
    const Folder folder;
    const std::string before = std::getenv("TAUT_DEVICE_COSTS") ? std::getenv("TAUT_DEVICE_COSTS") : "";
    setenv("TAUT_DEVICE_COSTS", (folder / "costs.txt").c_str(), 1); // else each measures, and plans by that
    const std::string scene = folder.file("cloth.json", scenes::cloth_and_box());
    std::set<std::string> kinds;
    for (const auto& device : program::parse(folder.taut({"devices", "--json"}).out)["devices"])
    {
        const std::string selector = device["selector"].get<std::string>();
        if (!kinds.insert(selector.substr(0, selector.find(':'))).second)
            continue;
        INFO(selector);
        const auto plan = program::parse(folder.taut({"plan", scene, "--device", selector, "--json"}).out);
        const auto run = program::parse(
            folder.taut({"run", scene, "--device", selector, "--frames", "1", "--no-picture", "--json"}).out);
        CHECK(plan["memory"] == run["memory"]);
        CHECK(plan["memory"]["buffers"] >= plan["bytes_allocated"]); // OpenGL keeps parameters in one, too
        CHECK(plan["memory"]["reserved"] >= plan["memory"]["buffers"]);
    }
    CHECK(folder.taut({"plan", scene, "--device", "cpu:serial"}).out.find("\nmemory  ") != std::string::npos);
    setenv("TAUT_DEVICE_COSTS", before.c_str(), 1);
    CHECK_FALSE(program::parse(folder.taut({"plan", scene, "--json"}).out).contains("memory"));
    CHECK(folder.taut({"plan", scene}).out.find("\nmemory  ") == std::string::npos);
}

TEST_CASE("costs of a device are measured once and kept: the plan is the same in every run")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth()), kept = folder / "costs.txt";
    const std::string before = std::getenv("TAUT_DEVICE_COSTS") ? std::getenv("TAUT_DEVICE_COSTS") : "";
    setenv("TAUT_DEVICE_COSTS", kept.c_str(), 1);
    const auto plan = [&] {
        return program::parse(folder.taut({"plan", scene, "--device", "cpu:serial", "--json"}).out);
    };
    const auto first = plan(), second = plan();
    CHECK(first == second);
    std::string text = program::read(kept);
    CHECK(std::count(text.begin(), text.end(), '\n') == 2);
    folder.file("costs.txt", text.substr(0, text.find('\t')) + "\t1000000 1 0.5 0.25\n");
    const auto third = plan();
    CHECK(third["costs_ns"] ==
          nlohmann::json{{"dispatch", 1e6}, {"group_barrier", 1}, {"element", 0.5}, {"lane_element", 0.25}});
    const auto cheap = // what was measured may be dear, too, in a build that checks memory
        program::parse(folder.taut({"plan", scene, "--device-costs", "1,1000000,0.5,0.25", "--json"}).out);
    CHECK(third["dispatches_per_step"] < cheap["dispatches_per_step"]); // grouped more
    const auto fixed =
        program::parse(folder.taut({"plan", scene, "--device-costs", "1000000,1,0.5,0.25", "--json"}).out);
    CHECK(fixed["costs_ns"] == third["costs_ns"]);
    CHECK(fixed["dispatches_per_step"] == third["dispatches_per_step"]); // without a device, too
    const Result readable = folder.taut({"plan", scene, "--device", "cpu:serial"});
    CHECK(readable.out.find("(from " + kept + ")") != std::string::npos);
    setenv("TAUT_DEVICE_COSTS", before.c_str(), 1);
}

TEST_CASE("costs that an option fixes are no longer measured, nor kept")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result plan = folder.taut({"plan", scene, "--device", "cpu:serial", "--device-costs", "7,6,5,8"});
    CHECK(plan.status == 0);
    CHECK(
        plan.out.find("a dispatch 7 ns, a barrier in a group 6 ns, an element 5 ns, in one group alone 8 ns "
                      "(as given)") != std::string::npos);
    for (const char* bad : {"7,6,5", "7,6,5,0", "7,6,5,x", "7,6,5,4,3"})
    {
        INFO(bad);
        CHECK(folder.taut({"plan", scene, "--device-costs", bad}).status == 2);
    }
}

TEST_CASE("whether a scene has too many passes does not depend on the device's costs")
{
    const Folder folder;
    const auto scene = [&](const std::string& method, int cells, const std::string& most) {
        const std::string n = std::to_string(cells);
        return folder.file("cloth.json", R"({"taut": 1, "bodies": [{"grid": {"cells": [)" + n + ", " + n +
                                             R"(]}}], "method": {"type": ")" + method +
                                             R"(", "substeps": 1000, )" + R"("iterations": )" + most + "}}");
    };
    for (const char* method : {"xpbd", "pbd", "vbd"})
        for (const int cells : {4, 40})
        {
            const std::string file = scene(method, cells, "1000");
            INFO(method << " " << cells);
            const Result check = folder.taut({"check", file, "--json"});
            CHECK(check.status == 2);
            const auto issue = program::parse(check.out)["issues"].back();
            CHECK(issue["field"] == "method.substeps");
            for (const char* costs : {"1,1000000,1,1000000", "1000000,1,1,1"})
            {
                const Result plan = folder.taut({"plan", file, "--device-costs", costs});
                CHECK(plan.status == 2);
                CHECK(plan.err.find(file + ": method.substeps " + issue["text"].get<std::string>()) !=
                      std::string::npos);
            }
        }
    const std::string file = scene("xpbd", 4, "20"); // some 300,000 passes
    CHECK(folder.taut({"check", file}).status == 0);
    for (const char* costs : {"1,1000000,1,1000000", "1000000,1,1,1"})
        CHECK(folder.taut({"plan", file, "--device-costs", costs}).status == 0);
}

TEST_CASE("files that are not the program's own are refused in the places of what it keeps")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const std::string file = folder.file("precious.txt", "a letter\n");
    const std::string before = std::getenv("TAUT_DEVICE_COSTS") ? std::getenv("TAUT_DEVICE_COSTS") : "";
    for (const std::string& place :
         {file, folder.path().string(), (folder / "missing" / "costs.txt").string()})
    {
        setenv("TAUT_DEVICE_COSTS", place.c_str(), 1);
        const Result result = folder.taut({"plan", scene, "--device", "cpu:serial"});
        INFO(place);
        CHECK(result.status == 2);
        CHECK(result.err.find(place) != std::string::npos);
        CHECK(program::read(file) == "a letter\n");
    }
    setenv("TAUT_DEVICE_COSTS", before.c_str(), 1);
}

TEST_CASE("check says which field is wrong, and ends with 0 only when nothing is")
{
    const Folder folder;
    const Result good = folder.taut({"check", folder.file("good.json", scenes::cloth())});
    CHECK(good.status == 0);
    CHECK(good.err.empty());
    const std::string bad = folder.file("bad.json", R"({"taut": 1, "timestep": -1, "damping": -2,
        "bodies": [{"grid": {"cells": [0, 8]}, "material": {"density": 0}}]})");
    const Result result = folder.taut({"check", bad});
    CHECK(result.status == 2);
    for (const char* field : {"timestep", "damping", "bodies[0].grid.cells", "bodies[0].material.density"})
    {
        INFO(field << " in " << result.out);
        CHECK(result.out.find(field) != std::string::npos);
    }
    const Result json = folder.taut({"check", bad, "--json"});
    CHECK(json.status == 2);
    const auto issues = program::parse(json.out)["issues"];
    CHECK(issues.size() >= 4);
    CHECK(std::all_of(issues.begin(), issues.end(), [](const auto& i) { return i["text"].is_string(); }));
    CHECK(folder.taut({"check", folder / "none.json"}).status == 2);
}

TEST_CASE("check --json prints an object of a file that is missing or no JSON, too")
{
    const Folder folder;
    for (const std::string& file : {std::string(folder / "none.json"), std::string(folder.path()),
                                    std::string(folder.file("half.json", "{"))})
    {
        const Result result = folder.taut({"check", file, "--json"});
        INFO(file << ": " << result.out);
        CHECK(result.status == 2);
        CHECK(result.err.empty());
        const auto said = program::parse(result.out);
        CHECK(said["sound"] == false);
        REQUIRE(said["issues"].size() == 1);
        const std::string text = said["issues"][0]["text"];
        CHECK(text.find(std::filesystem::path(file).filename()) != std::string::npos);
    }
}

TEST_CASE("check and run name keys that the method does not read, and go on")
{
    const Folder folder;
    std::string text = scenes::cloth();
    text.insert(1, R"("method": {"type": "pbd", "release": "strain", "stretch": 0.5},)");
    const std::string scene = folder.file("keys.json", text);
    const Result check = folder.taut({"check", scene, "--json"});
    CHECK(check.status == 0);
    const auto issues = program::parse(check.out)["issues"];
    REQUIRE(issues.size() == 1);
    CHECK(issues[0]["error"] == false);
    CHECK(issues[0]["field"] == "method.release");
    CHECK(issues[0]["text"].get<std::string>().find("\"pbd\" does not read it") != std::string::npos);
    const Result run = folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "1", "--no-picture",
                                    "--json", "--set", "method.start=inertial"});
    REQUIRE(run.status == 0);
    const auto messages = program::parse(run.out)["messages"];
    REQUIRE(messages.size() == 2);
    CHECK(messages[0].get<std::string>().rfind("method.release: ", 0) == 0);
    CHECK(messages[1].get<std::string>().rfind("method.start: ", 0) == 0);
}

TEST_CASE("check lists every member that cannot be read, by field")
{
    const Folder folder;
    const std::string scene = folder.file("scene.json", R"({"taut": 1, "timestep": "short", "gravty": 1,
        "method": {"type": 3, "substeps": -1, "iterations": 2},
        "bodies": [{"grid": {"cells": [4]}, "pins": [{"corner": 7}, {"vertices": [0, "one"]}],
                    "material": {"density": [1], "stiffness": 1, "thickness": true}},
                   {"cloth": {}}, {"grid": {}, "springs": [{"a": 1}]}],
        "colliders": [{"sphere": {"radius": "wide"}}]})");
    const Result result = folder.taut({"check", scene, "--json"});
    CHECK(result.status == 2);
    std::set<std::string> fields;
    const auto issues = program::parse(result.out)["issues"];
    for (const auto& issue : issues)
        fields.insert(issue["field"].get<std::string>());
    CHECK(fields == std::set<std::string>{"gravty", "timestep", "method.type", "method.substeps",
                                          "bodies[0].grid.cells", "bodies[0].pins[0].corner",
                                          "bodies[0].pins[1].vertices[1]", "bodies[0].material.stiffness",
                                          "bodies[0].material.density", "bodies[0].material.thickness",
                                          "bodies[1]", "bodies[1].cloth", "bodies[2].springs[0].b",
                                          "bodies[2].springs[0].rest_length", "colliders[0].sphere.radius"});
}

TEST_CASE("check lists values out of range beside keys that cannot be read, each by its field")
{
    const Folder folder;
    const std::string scene = folder.file("scene.json", R"({"taut": 1, "damping": -1,
        "method": {"substeps": 2000, "stretch": -1, "bend": "soft"},
        "bodies": [{"grid": {}, "material": {"densty": 1, "thickness": -1}},
                   {"grid": {}, "material": {"thickness": -1}}, 5],
        "colliders": [{"sphere": {"radius": 0}}, {"sphere": {"radius": "wide"}, "friction": -1}]})");
    const Result result = folder.taut({"check", scene, "--json"});
    CHECK(result.status == 2);
    std::set<std::string> fields;
    const auto issues = program::parse(result.out)["issues"];
    for (const auto& issue : issues)
        fields.insert(issue["field"].get<std::string>());
    CHECK(fields == std::set<std::string>{"damping", "method.substeps", "method.stretch", "method.bend",
                                          "bodies[0].material.densty", "bodies[0].material.thickness",
                                          "bodies[1].material.thickness", "bodies[2]",
                                          "colliders[0].sphere.radius", "colliders[1].sphere.radius",
                                          "colliders[1].friction"});
}

TEST_CASE("schema prints a JSON Schema, and the tables of the pages")
{
    const Folder folder;
    const Result result = folder.taut({"schema"});
    CHECK(result.status == 0);
    CHECK(result.err.empty());
    const auto schema = program::parse(result.out);
    CHECK(schema["$schema"] == "https://json-schema.org/draft/2020-12/schema");
    CHECK(schema["properties"]["timestep"]["maximum"] == 1);
    const Result tables = folder.taut({"schema", "--markdown"});
    CHECK(tables.status == 0);
    CHECK(tables.out.rfind("<!-- scene -->\n", 0) == 0);
    CHECK(tables.out.find("| `timestep` | time between two frames | s | 1/60 |") != std::string::npos);
}

TEST_CASE("fabrics lists what a scene may name, and each name is a sound scene")
{
    const Folder folder;
    CHECK(folder.taut({"fabrics"}).out.find("\npenava_cotton") != std::string::npos);
    const auto list = program::parse(folder.taut({"fabrics", "--json"}).out)["fabrics"];
    REQUIRE(list.size() > 5);
    for (const auto& fabric : list)
    {
        const std::string name = fabric["name"].get<std::string>();
        const std::string scene =
            R"({"taut": 1, "bodies": [{"grid": {}, "material": {"fabric": {"preset": ")" + name + "\"}}}]}";
        CHECK(folder.taut({"check", folder.file("scene.json", scene)}).status == 0);
        CHECK(!fabric["source"].get<std::string>().empty());
    }
}

TEST_CASE("check names the box whose tetrahedra have no volume, and a timestep that is too short")
{
    const Folder folder;
    const auto field = [&](const std::string& text) {
        const Result result = folder.taut({"check", folder.file("scene.json", text), "--json"});
        CHECK(result.status == 2);
        return program::parse(result.out)["issues"].at(0)["field"].get<std::string>();
    };
    CHECK(field(R"({"taut": 1, "bodies": [{"box": {"size": [1e-200, 1e-200, 1]}}]})") == "bodies[0].box");
    CHECK(field(R"({"taut": 1, "timestep": 1e-12, "bodies": [{"grid": {}}]})") == "timestep");
    CHECK(field(R"({"taut": 1, "duration": 1e12, "bodies": [{"grid": {}}]})") == "duration");
}

TEST_CASE("check lists a mesh file that is not there beside other faults")
{
    const Folder folder;
    const std::string scene = folder.file("faults.json", R"({"taut": 1, "duration": -1, "foo": 1,
        "method": {"iterations": 1.5}, "bodies": [{"mesh": "missing.obj"}]})");
    const Result result = folder.taut({"check", scene, "--json"});
    CHECK(result.status == 2);
    std::string all;
    const auto issues = program::parse(result.out)["issues"];
    for (const auto& issue : issues)
        all += issue["field"].get<std::string>() + " " + issue["text"].get<std::string>() + "\n";
    INFO(all);
    CHECK(all.find("foo") != std::string::npos);
    CHECK(all.find("duration is -1 s") != std::string::npos);
    CHECK(all.find("method.iterations is 1.5; it must be a whole number from 1 to 1000") !=
          std::string::npos);
    CHECK(all.find("bodies[0].mesh names missing.obj; there is no such file") != std::string::npos);
}

TEST_CASE("check finds a mesh file that is not there")
{
    const Folder folder;
    const std::string scene = folder.file("scene.json", R"({"taut": 1, "bodies": [{"mesh": "none.obj"}]})");
    const Result result = folder.taut({"check", scene});
    CHECK(result.status == 2);
    CHECK((result.out + result.err).find("none.obj") != std::string::npos);
    const Result json = folder.taut({"check", scene, "--json"});
    CHECK(json.status == 2);
    const auto issues = program::parse(json.out)["issues"];
    REQUIRE(issues.size() == 1);
    CHECK(issues[0]["field"] == "bodies[0].mesh");
    CHECK(issues[0]["text"].get<std::string>().find("there is no such file") != std::string::npos);
}

TEST_CASE("devices lists the native CPU with its limits, each under a selector that opens it")
{
    const Folder folder;
    const auto list = program::parse(folder.taut({"devices", "--json"}).out)["devices"];
    std::set<std::string> selectors;
    for (const auto& device : list)
    {
        selectors.insert(device["selector"].get<std::string>());
        CHECK(device["limits"]["max_buffer_bytes"].get<std::uint64_t>() > 0);
        CHECK(device["name"].is_string());
        CHECK(device["driver"].is_string());
        CHECK(device["hardware_gpu"].is_boolean());
    }
    CHECK(selectors.count("cpu") == 1);
    CHECK(folder.taut({"devices"}).out.find("cpu") != std::string::npos);
}

TEST_CASE("version and help go to standard output with status 0")
{
    const Folder folder;
    const Result version = folder.taut({"--version"});
    CHECK(version.status == 0);
    CHECK(version.out.rfind("taut ", 0) == 0);
    const Result help = folder.taut({"--help"});
    CHECK(help.status == 0);
    for (const char* command : {"run", "plan", "cost", "solve", "check", "schema", "devices"})
        CHECK(help.out.find(command) != std::string::npos);
    const Result run_help = folder.taut({"run", "--help"});
    CHECK(run_help.status == 0);
    CHECK(run_help.out.find("--every") != std::string::npos);
}
