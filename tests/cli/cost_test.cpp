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
        "cost",         scene, "--device",    "cpu:serial", "--frames",         "4", "--substeps", "2,10",
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
          std::vector<std::string>{"cost.csv", "cost.json", "cost.svg", "cost_work.svg"});
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
