#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

#include <string>
#include <vector>

using program::Folder;
using program::Result;

TEST_CASE("a run that cuts a cloth ends where one device ends, and says what it cannot")
{
    const Folder folder;
    const std::string scene = folder.file("two.json", scenes::two_bodies());
    const auto run = [&](std::vector<std::string> more) {
        std::vector<std::string> all = {"run",          scene,   "--frames",   "5",
                                        "--no-picture", "--out", folder / "o", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        return folder.taut(all);
    };
    const auto alone = program::parse(run({"--device", "cpu:serial"}).out);
    for (const std::string device : {"hybrid:cpu:serial", "hybrid:cpu:serial+cpu:serial"})
    {
        const Result result = run({"--device", device, "--split", "vertices", "--share", "0.4"});
        INFO(result.err);
        REQUIRE(result.status == 0);
        const auto report = program::parse(result.out);
        REQUIRE(report["hybrid"].size() == 2);
        CHECK(report["hybrid"][0]["vertices"] == 5);
        CHECK(report["hybrid"][0]["bodies"] == 1);
        CHECK(report["hybrid"][1]["vertices"] == 8);
        CHECK(report["hybrid"][1]["bodies"] == 2);
        CHECK(report["hybrid"][1]["executor"] == "cpu:serial");
        CHECK(report["position_hash"] == alone["position_hash"]);
        CHECK(report["warnings"] == alone["warnings"]);
    }
    const auto refused = [&](std::vector<std::string> more, const std::string& words) {
        const Result result = run(more);
        CHECK(result.status == 2);
        CHECK_THAT(result.err, Contains(words));
    };
    refused({"--device", "cpu", "--split", "vertices"}, "--device hybrid");
    refused({"--device", "hybrid:cpu:serial", "--share", "0.4"}, "--split vertices");
    refused({"--device", "hybrid:cpu:serial", "--split", "vertices", "--share", "1.4"}, "--share");
    refused({"--device", "hybrid:cpu:serial", "--split", "edges"}, "vertices");
    refused({"--device", "hybrid:cpu:serial", "--split", "vertices", "--set", "method.type=vbd"}, "\"vbd\"");
    CHECK(run({"--device", "hybrid:cpu:serial+nowhere", "--split", "vertices"}).status == 3);
}
