// What the program refuses: one sentence on standard error, nothing else, and the right exit status.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <algorithm>

using program::Folder;
using program::Result;

namespace {

/// One line "taut: ..." and nothing on standard output.
void check_refused(const Result& result, int status, const std::string& part)
{
    INFO(result.err);
    CHECK(result.status == status);
    CHECK(result.out.empty());
    CHECK(result.err.rfind("taut: ", 0) == 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(result.err.find(part) != std::string::npos);
}

} // namespace

TEST_CASE("wrong arguments end with status 2 and a sentence")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    check_refused(folder.taut({}), 2, "--help");
    check_refused(folder.taut({"fold"}), 2, "fold");
    check_refused(folder.taut({"run"}), 2, "scene");
    check_refused(folder.taut({"run", scene, "--frames", "many"}), 2, "many");
    check_refused(folder.taut({"run", scene, "--frames", "-3"}), 2, "-3");
    check_refused(folder.taut({"run", scene, "--frames", "99999999999"}), 2, "99999999999");
    check_refused(folder.taut({"run", scene, "--speed", "2"}), 2, "--speed");
    check_refused(folder.taut({"run", scene, "another.json"}), 2, "another.json");
}

TEST_CASE("a number that is not right ends with status 2 and what would be, in every command")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
        {{"run", scene, "--frames", "-3"}, "--frames is \"-3\"; it must be a whole number, 0 or more"},
        {{"run", scene, "--frames", "abc"}, "--frames is \"abc\"; it must be a whole number, 0 or more"},
        {{"run", scene, "--frames", "99999999999"}, "0 or more, up to 4294967295"},
        {{"run", scene, "--every", "1.5"}, "--every is \"1.5\"; it must be a whole number, 0 or more"},
        {{"compare", scene, "--frames=-1"}, "--frames is \"-1\"; it must be a whole number, 0 or more"},
        {{"cost", scene, "--frames", "0"}, "--frames is \"0\"; it must be a whole number, 1 or more"},
        {{"cost", scene, "--substeps", "1,a"},
         "--substeps is \"a\"; it must be a whole number from 1 to 1000"},
        {{"cost", scene, "--iterations", "0,4"}, "--iterations is \"0\"; it must be a whole number from 1"},
        {{"cost", scene, "--ratio", "mass", "--ratios", "1,-2"},
         "--ratios is \"-2\"; it must be a number above 0"},
        {{"cost", scene, "--rest-seconds", "0.5"}, "it must be a number from 1 to 1e+06"},
        {{"cost", scene, "--timing-seconds", "nan"},
         "--timing-seconds is \"nan\"; it must be a number, 0 or more"},
        {{"tune", scene, "--error", "1%"},
         "--error is \"1%\"; it must be a number between 0 and 1; 0.01 is 1 %"},
        {{"tune", scene, "--reference-steps", "1e9x"}, "--reference-steps is \"1e9x\"; it must be a number"},
        {{"solve", "a.mtx", "--tolerance", "2"}, "--tolerance is \"2\"; it must be a number between 0 and 1"},
        {{"solve", "a.mtx", "--max-iterations", "0"},
         "--max-iterations is \"0\"; it must be a whole number, 1"},
        {{"solve", "a.mtx", "--chebyshev-degree", "17"}, "it must be a whole number from 1 to 16"},
        {{"tetrahedralise", "a.obj", "--max-volume", "-1"},
         "--max-volume is \"-1\"; it must be a number above 0"},
    };
    for (const auto& [arguments, sentence] : cases)
    {
        const Result result = folder.taut(arguments);
        check_refused(result, 2, sentence);
        CHECK(result.err.find("convert") == std::string::npos);
    }
}

TEST_CASE("a scene that cannot be read or makes no sense ends with status 2, in every command")
{
    const Folder folder;
    const std::string command = GENERATE("run", "plan", "cost");
    const auto refused = [&](const std::string& text, const std::string& part) {
        const std::string scene = folder.file("bad.json", text);
        check_refused(folder.taut({command, scene, "--json"}), 2, part);
    };
    check_refused(folder.taut({command, folder / "none.json"}), 2, "none.json");
    check_refused(folder.taut({command, folder.path()}), 2, folder.path().filename());
    refused("", "bad.json");
    refused("{\"taut\": 1, ", "bad.json");
    refused("[]", "bad.json");
    refused(R"({"taut": 1, "gravitty": [0, 0, 0]})", "gravity");
    refused(R"({"taut": 2})", "version");
    refused(scenes::cloth("NaN"), "bad.json");
    refused(scenes::cloth("-1"), "bad.json: timestep is -1");
    refused(scenes::cloth("0"), "bad.json: timestep is 0");
    refused(scenes::cloth("1e999"), "bad.json");
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("a device that is not there ends with status 3 and the list of those that are")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    check_refused(folder.taut({"run", scene, "--device", "no such device"}), 3, "cpu");
    check_refused(folder.taut({"run", scene, "--device", "vulkan:99", "--json"}), 3, "cpu");
    check_refused(folder.taut({"plan", scene, "--device", "no such device"}), 3, "cpu");
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("a folder that cannot be written ends with status 2 and leaves it as it was")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const std::string file = folder.file("in_the_way", "text");
    const Result result =
        folder.taut({"run", scene, "--device", "cpu:serial", "--frames", "1", "--out", file});
    check_refused(result, 2, "in_the_way");
    CHECK(program::read(file) == "text");
}

TEST_CASE("a refused scene does not touch what an earlier run wrote")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const std::vector<std::string> arguments = {"run", scene,   "--device",   "cpu:serial",  "--frames",
                                                "1",   "--out", folder / "o", "--no-picture"};
    REQUIRE(folder.taut(arguments).status == 0);
    const std::string before = program::read(folder / "o/report.json");
    folder.file("cloth.json", scenes::cloth("-1"));
    CHECK(folder.taut(arguments).status == 2);
    CHECK(program::read(folder / "o/report.json") == before);
}

TEST_CASE("bodies that no memory holds are refused before they are made, and nothing is written")
{
    const Folder folder;
    std::string bodies; // 2.6e9 vertices: about a terabyte
    for (int k = 0; k < 40; ++k)
        bodies += std::string(k == 0 ? "" : ", ") + R"({"grid": {"cells": [8000, 8000], "size": [1, 1]}})";
    const std::string scene = folder.file("huge.json", R"({"taut": 1, "bodies": [)" + bodies + "]}");
    const Result result = folder.taut({"run", scene, "--device", "cpu:serial", "--out", folder / "o"});
    check_refused(result, 1, "take fewer cells, of bodies[0] first");
    CHECK_THAT(result.err, Contains("huge.json"));
    CHECK(folder.list("o").empty());
}
