// taut sdf

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

using program::Folder;
using program::Result;

namespace {

const char* const kCube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                          "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

} // namespace

TEST_CASE("sdf writes a grid that a scene runs with")
{
    const Folder folder;
    const std::string cube = folder.file("cube.obj", kCube);
    const Result made = folder.taut({"sdf", cube, "--cells", "8", "--margin", "0.25", "--json"});
    CHECK(made.status == 0);
    const auto said = nlohmann::json::parse(made.out);
    CHECK(said["points"] == nlohmann::json({13, 13, 13}));
    CHECK(said["cell"] == 0.125);
    CHECK(said["depth"] == 0.5);
    CHECK(std::filesystem::exists(folder / "cube.sdf"));
    folder.file("scene.json",
                R"({"taut": 1, "duration": 0.5, "bodies": [{"name": "s", "grid": {"cells": [8, 8]},
        "material": {"thickness": 0.01},
        "transform": {"translate": [0.5, 1.1, 0.5], "rotate": {"axis": [1, 0, 0], "degrees": -90}}}],
        "colliders": [{"distance_field": {"file": "cube.sdf"}}]})");
    const Result run = folder.taut({"run", "scene.json", "--device", "cpu", "--no-picture", "--out", "made"});
    CAPTURE(run.err);
    CHECK(run.status == 0);
    const std::string mesh =
        program::read(folder / "made/mesh_00015.obj"); // the sheet is as wide as the cube
    std::istringstream lines(mesh);
    double lowest = 1e300, x = 0, y = 0, z = 0;
    for (std::string word; lines >> word;)
        if (word == "v" && lines >> x >> y >> z)
            lowest = std::min(lowest, y);
    CHECK(lowest > 0.9);
    CHECK(lowest < 1.05);
}

TEST_CASE("sdf says what it does not take, and leaves nothing behind")
{
    const Folder folder;
    const std::string cube = folder.file("cube.obj", kCube);
    const std::string open = folder.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
        const Result result = folder.taut(words);
        CAPTURE(result.err, why);
        CHECK(result.status == 2);
        CHECK(result.err.find(why) != std::string::npos);
    };
    refused({"sdf", "none.obj"}, "none.obj");
    refused({"sdf", open}, "encloses no volume");
    refused({"sdf", cube, "--cells", "0"}, "--cells");
    refused({"sdf", cube, "--cell", "0"}, "--cell");
    refused({"sdf", cube, "--cell", "1e-6"}, "2^28");
    refused({"sdf", cube, "--cell", "0.1", "--cells", "3"}, "--cell");
    refused({"sdf", cube, "--margin", "-1"}, "--margin");
    refused({"sdf", cube, "--out", "cube.obj"}, "the surface itself");
    refused({"sdf", cube, "--out", "no/cube.sdf"}, "no/cube.sdf");
    refused({"sdf", cube, "--cell", "3"}, "nothing is inside");
    CHECK_FALSE(std::filesystem::exists(folder / "cube.sdf"));
}

TEST_CASE("sdf says that parts thinner than its cells are lost")
{
    const Folder folder;
    std::string plate = kCube; // beside the cube a plate of 2 cm
    for (const char* v : {"3 0 0", "4 0 0", "4 1 0", "3 1 0", "3 0 0.02", "4 0 0.02", "4 1 0.02", "3 1 0.02"})
        plate += std::string("v ") + v + "\n";
    plate += "f 9 12 11 10\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
    const std::string both = folder.file("both.obj", plate);
    CHECK(folder.taut({"sdf", both, "--cell", "0.1"}).err.find("lost") != std::string::npos);
    CHECK(folder.taut({"sdf", both, "--cell", "0.01"}).err.find("lost") == std::string::npos);
    CHECK(folder.taut({"sdf", folder.file("cube.obj", kCube), "--cells", "16"}).err.empty());
}

TEST_CASE("sdf warns of lines of an OBJ that it does not read, and of a surface that it refuses, too")
{
    const Folder folder;
    const std::string lines = "seam 1 2\nstitch 1 5\nstitch 2 6\n";
    const std::string cube = folder.file("cube.obj", kCube + lines);
    const std::vector<std::string> said = {cube + " has 1 line \"seam\", which is not read",
                                           cube + " has 2 lines \"stitch\", which are not read"};
    const Result made = folder.taut({"sdf", cube, "--cells", "16", "--json"});
    CHECK(made.status == 0);
    CHECK(program::parse(made.out)["messages"] == said);
    CHECK(made.err == "taut: warning: " + said[0] + "\ntaut: warning: " + said[1] + "\n");
    const std::string open = folder.file("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nseam 1 2\n");
    const Result refused = folder.taut({"sdf", open});
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err, Contains("has 1 line \"seam\"") && Contains("encloses no volume"));
    const Result clean = folder.taut({"sdf", folder.file("clean.obj", kCube), "--cells", "16", "--json"});
    CHECK(program::parse(clean.out)["messages"].empty());
}
