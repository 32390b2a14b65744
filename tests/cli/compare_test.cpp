// taut compare: variants of one scene in one table.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

using program::Folder;
using program::Result;

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
