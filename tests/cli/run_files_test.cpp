// What taut run writes and says beside its report: digits of meshes, memory.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <sstream>
#include <vector>

using program::Folder;
using program::Result;

namespace {

TEST_CASE("meshes of a run in double have all digits of a double")
{
    const Folder folder;
    const std::string scene = folder.file("double.json", R"({"taut": 1, "gravity": [0, 0, 0],
        "method": {"type": "xpbd", "precision": "double"},
        "bodies": [{"grid": {"cells": [1, 1], "size": [0.25, 0.25]},
                    "transform": {"translate": [0.6234567890123456, 0, 0]}}]})");
    const Result result = folder.taut(
        {"run", scene, "--device", "cpu:serial", "--frames", "1", "--out", folder / "o", "--no-picture"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    std::istringstream mesh(program::read(folder / "o/mesh_00000.obj"));
    int vertices = 0;
    for (std::string line; std::getline(mesh, line);)
        if (line.starts_with("v "))
        {
            ++vertices;
            const double x = std::stod(line.substr(2)); // 0.125 from the centre, which rounds nothing
            CHECK((x == 0.6234567890123456 - 0.125 || x == 0.6234567890123456 + 0.125));
        }
    CHECK(vertices == 4);
}

TEST_CASE("run says what memory the scene takes, in its text and in its report")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const std::vector<std::string> words = {"run", scene,   "--device",   "cpu:serial",  "--frames",
                                            "1",   "--out", folder / "o", "--no-picture"};
    const Result text = folder.taut(words);
    REQUIRE(text.status == 0);
    const auto memory = program::parse(program::read(folder / "o/report.json"))["memory"];
    const double buffers = memory["buffers"].get<double>();
    CHECK(buffers > 81 * 16 * 4); // places, velocities, displacements and masses at least
    CHECK(memory["reserved"].get<double>() >= buffers);
    CHECK(memory["blocks"].get<int>() > 0);
    const std::size_t at = text.out.find("\nmemory  ");
    REQUIRE(at != std::string::npos);
    CHECK(1024 * std::stod(text.out.substr(at + 9)) == Approx(buffers).epsilon(0.01));
    CHECK(text.out.find(" KiB in buffers, ", at) != std::string::npos);
}

TEST_CASE("a run says what check says of meshes that cannot carry their material")
{
    const Folder folder;
    const std::string scene = folder.file("coarse.json", R"({"taut": 1, "bodies": [
        {"box": {"cells": [2, 1, 1], "size": [0.2, 0.1, 0.1]}, "material": {"youngs_modulus": 1e6}},
        {"grid": {"cells": [4, 4]}, "transform": {"translate": [0, 0, 2]},
         "material": {"fabric": {"warp": 2e9, "weft": 1e9, "shear": 1e8}}}]})");
    std::vector<std::string> warned;
    const auto check = program::parse(folder.taut({"check", scene, "--json"}).out);
    for (const auto& issue : check["issues"])
        warned.push_back(issue["field"].get<std::string>() + ": " + issue["text"].get<std::string>());
    REQUIRE(warned.size() == 2);
    const Result run =
        folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "1", "--no-picture", "--json"});
    INFO(run.err);
    CHECK(program::parse(run.out)["messages"].get<std::vector<std::string>>() == warned);
}

} // namespace
