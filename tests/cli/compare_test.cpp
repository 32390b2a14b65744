// taut compare: variants of one scene in one table.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <csignal>
#include <fstream>

using program::Folder;
using program::Result;

namespace {

/// Whether the process has a handler of its own for it.
bool catches(int process, int signal)
{
    std::ifstream file("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("SigCgt:"))
            return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
    return false;
}

} // namespace

TEST_CASE("variants of a scene are compared, and one that is refused is a row with its reason")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    const Result result = folder.taut(
        {"compare", scene, "--device", "cpu:serial", "--frames", "6", "--no-picture", "--out", folder / "o",
         "--variant", "coarse: method.substeps=2", "--variant", "fine: method.substeps=20; device=cpu",
         "--variant", "the same: method.substeps=2", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto json = program::parse(result.out);
    REQUIRE(json["variants"].size() == 3);
    CHECK(json["variants"][0]["difference"].is_null());
    CHECK(json["variants"][1]["difference"].get<double>() > 0);
    CHECK(json["variants"][1]["executor"] == "cpu");
    CHECK(json["variants"][2]["difference"] == 0.0);
    CHECK(json["variants"][1]["max_stretch"].get<double>() <
          json["variants"][0]["max_stretch"].get<double>());
    CHECK(program::read(folder / "o/compare.md").find("| coarse | xpbd | cpu:serial |") != std::string::npos);
    CHECK(program::read(folder / "o/compare.csv").rfind("variant,method,executor", 0) == 0);
    CHECK(program::read(folder / "o/compare_series.svg").find("Largest strain over time: cloth") !=
          std::string::npos);
}

TEST_CASE("wrong variants end with 2 and say what would be right")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    for (const std::string& variant :
         {std::string("no colon"), std::string("a: method.substep=2"), std::string("a: method.substeps"),
          std::string("a: method.substeps=0"), std::string(" : method.substeps=2")})
    {
        const Result result = folder.taut({"compare", scene, "--device", "cpu:serial", "--variant", variant});
        INFO(variant << ": " << result.err);
        CHECK(result.status == 2);
        CHECK_FALSE(result.err.empty());
    }
    CHECK(folder.taut({"compare", scene}).status == 2);
    const Result twice =
        folder.taut({"compare", scene, "--variant", "a: ", "--variant", "a: method.substeps=2"});
    CHECK(twice.status == 2);
    CHECK_THAT(twice.err, Contains("two --variant are called \"a\""));
    CHECK(folder.taut({"run", scene, "--set", "method.sub=2", "--no-picture"}).status == 2);
}

TEST_CASE("an interrupted comparison ends with the variants that were begun, and says which were not")
{
    const Folder folder;
    const std::string scene = folder.file("cloth.json", scenes::cloth());
    int looks = 0; // since the program catches the signal: the first variant runs by then, and has long to go
    const auto interrupt = [&](int process) {
        if (catches(process, SIGINT) && ++looks == 20)
            kill(process, SIGINT);
    };
    const Result result =
        folder.taut({"compare", scene, "--device", "cpu:serial", "--frames", "10000000", "--no-picture",
                     "--out", folder / "o", "--set", "accept.stretch=10", "--variant",
                     "one: method.substeps=20", "--variant", "two: method.substeps=30", "--json"},
                    interrupt);
    INFO(result.err);
    REQUIRE(looks >= 20);
    CHECK(result.status == 0);
    const auto variants = program::parse(result.out)["variants"];
    REQUIRE(variants.size() == 2);
    for (const auto& variant : variants)
    {
        CHECK(variant["interrupted"] == true);
        CHECK(variant["status"] == "interrupted");
    }
    CHECK(variants[0]["refusal"] == "");
    CHECK(variants[0]["series"].size() >= 2); // the start, and where it stopped
    CHECK(variants[1]["refusal"] == "interrupted: not run");
    CHECK(program::parse(program::read(folder / "o/compare.json"))["variants"] == variants);
}
