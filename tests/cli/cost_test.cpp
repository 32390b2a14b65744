// taut cost: what it prints, what it writes, how it ends. The numbers are tested in unit/report.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

using program::Folder;
using program::Result;

namespace {

std::vector<std::string> cost(const std::string& scene, const std::vector<std::string>& more = {})
{
    std::vector<std::string> out{
        "cost",         scene, "--device",    "cpu:serial", "--frames",         "4", "--substeps", "5,20",
        "--iterations", "1",   "--precision", "double",     "--timing-seconds", "0"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

} // namespace

TEST_CASE("cost prints one JSON object with points, cheapest and reference")
{
    const Folder folder;
    const Result result = folder.taut(cost(folder.file("cloth.json", scenes::cloth()), {"--json"}));
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto study = program::parse(result.out);
    REQUIRE(study["points"].size() == 2);
    CHECK(study["points"][0]["error"].get<double>() > study["points"][1]["error"].get<double>());
    CHECK(study["points"][1]["reference"] == "R3");
    for (const char* tolerance : {"0.1", "0.01", "0.001"})
        CHECK(study["cheapest"].contains(tolerance));
    CHECK(study["frames"] == 4);
}

TEST_CASE("cost writes its files whole, and its three sentences for people")
{
    const Folder folder;
    const Result result = folder.taut(cost(folder.file("cloth.json", scenes::cloth()), {"--out", "study"}));
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(folder.list("study") ==
          std::vector<std::string>{"cost.csv", "cost.json", "cost.svg", "cost_gaps.md", "cost_work.svg"});
    CHECK(program::read(folder / "study/cost.svg").find("Reference class R3") != std::string::npos);
    for (const char* sentence : {"\n10 %", "\n1 %", "\n0.1 %"})
        CHECK(result.out.find(sentence) != std::string::npos);
}

TEST_CASE("cost ends with 1 when nothing is sound and with 2 when the input is wrong")
{
    const Folder folder;
    const std::string cloth = folder.file("cloth.json", scenes::cloth());
    const Result lost = folder.taut(cost(folder.file("lost.json", scenes::lost_cloth())));
    INFO(lost.out << lost.err);
    CHECK(lost.status == 1);
    CHECK(lost.out.find("diverged") != std::string::npos);
    CHECK(folder.taut(cost(folder / "none.json")).status == 2);
    CHECK(folder.taut({"cost", cloth, "--substeps", "0", "--device", "cpu"}).status == 2);
    CHECK(folder.taut({"cost", cloth, "--precision", "half"}).status == 2);
    CHECK(folder.taut({"cost", folder.file("empty.json", R"({"taut": 1})"), "--device", "cpu"}).status == 2);
}

TEST_CASE("cost compares methods by one table, and what a method refuses stands as R")
{
    const Folder folder;
    const Result result = folder.taut(cost(folder.file("cloth.json", scenes::cloth()),
                                           {"--methods", "pbd,xpbd", "--rank", "work", "--out", "study"}));
    INFO(result.err);
    REQUIRE(result.status == 0);
    CHECK(result.out.find("cheapest by method") != std::string::npos);
    CHECK(folder.list("study") == std::vector<std::string>{"cost.csv", "cost.json", "cost.svg",
                                                           "cost_gaps.md", "cost_iterations.svg",
                                                           "cost_substeps.svg", "cost_work.svg"});
    const auto study = program::parse(program::read(folder / "study/cost.json"));
    REQUIRE(study["points"].size() == 4);
    CHECK(study["methods"].contains("pbd"));
    CHECK(study["basis"] == "sweeps");
    CHECK(folder.taut(cost(folder / "cloth.json", {"--methods", "xpdb"})).status == 2);
}

TEST_CASE("tune prints a method block that a scene takes, or says that nothing keeps the bound")
{
    const Folder folder;
    const std::string cloth = folder.file("cloth.json", scenes::cloth());
    const std::vector<std::string> common{"tune",     cloth, "--device", "cpu:serial",   "--methods", "xpbd",
                                          "--frames", "4",   "--json",   "--prior-only", "--error"};
    const auto with_bound = [&](const char* bound) {
        std::vector<std::string> all = common;
        all.push_back(bound);
        return folder.taut(all);
    };
    const Result found = with_bound("0.3");
    INFO(found.err);
    REQUIRE(found.status == 0);
    const auto result = program::parse(found.out);
    for (const char* key :
         {"method", "predicted_error", "confirmed_error", "ms_per_simulated_second", "rejected"})
        CHECK(result.contains(key));
    CHECK(result["method"]["type"] == "xpbd");
    CHECK(result["confirmed_error"].get<double>() <= 0.3);
    const Result none = with_bound("1e-12");
    CHECK(none.status == 1);
    CHECK(program::parse(none.out)["method"].is_null());
    CHECK(program::parse(none.out)["answer"] == "poor_reference");
    CHECK(with_bound("2").status == 2);
    std::vector<std::string> no_time = common;
    no_time.insert(no_time.end(), {"0.3", "--seconds", "0"});
    const Result late = folder.taut(no_time);
    CHECK(late.status == 1);
    CHECK(program::parse(late.out)["tried"].empty());
    CHECK_FALSE(program::parse(late.out)["not_tried"].empty());
    no_time.erase(std::find(no_time.begin(), no_time.end(), "--json"));
    CHECK(folder.taut(no_time).out.find("No setting was tried: the time was up.\n") != std::string::npos);
}

TEST_CASE("tune has a setting that keeps 1 % of the project's own hanging cloth", "[tune]")
{
    const Folder folder;
    const Result result =
        folder.taut({"tune", TAUT_SOURCE_DIR "/examples/scenes/hanging.json", "--error", "0.01", "--frames",
                     "12", "--prior-only", "--device", "cpu:serial", "--json"});
    INFO(result.err);
    REQUIRE(result.status == 0);
    const auto answer = program::parse(result.out);
    CHECK(answer["answer"] == "found");
    CHECK(answer["frames"] == 12);
    CHECK(answer["confirmed_error"].get<double>() <= 0.01);
    CHECK(answer["starts"] == 3); // each perturbed one, held against a bound of its own
}

TEST_CASE("tune by volume bounds e_V of a scene of cloth and a solid, and asks for a body that has a volume")
{
    const Folder folder;
    const std::string mixed = folder.file("mixed.json", scenes::cloth_and_box());
    const std::vector<std::string> more{"--by",     "volume",       "--methods", "xpbd,pbd,vbd",
                                        "--frames", "12",           "--device",  "cpu:serial",
                                        "--json",   "--prior-only", "--error",   "0.05"};
    const auto with = [&](const std::string& scene) {
        std::vector<std::string> all{"tune", scene};
        all.insert(all.end(), more.begin(), more.end());
        return folder.taut(all);
    };
    const Result found = with(mixed);
    INFO(found.err);
    REQUIRE(found.status == 0);
    const auto result = program::parse(found.out);
    CHECK(result["error_metric"] == "e_V");
    CHECK(result["frames"] == 12);
    CHECK(result["confirmed_error"].get<double>() <= 0.04);
    const Result none = with(folder.file("cloth.json", scenes::cloth()));
    CHECK(none.status == 2);
    CHECK(none.err.find("volume") != std::string::npos);
}

TEST_CASE("cost by ablation has a row for each effect that a scene calls for")
{
    const Folder folder;
    const Result result = folder.taut({"cost", folder.file("cloth.json", scenes::cloth()), "--ablation",
                                       "--frames", "3", "--device", "cpu:serial", "--out", folder / "study"});
    CHECK(result.status == 0);
    CHECK(result.out.find("| (the whole scene) |") != std::string::npos);
    CHECK(result.out.find("| distance |") != std::string::npos);
    CHECK(result.out.find("| motion |") == std::string::npos);
    CHECK(program::read(folder / "study/ablation.csv").rfind("without,ms a step", 0) == 0);
}
