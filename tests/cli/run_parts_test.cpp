// taut run where no one world runs: on two devices, or with bodies that sleep.

#include "cli/program.hpp"
#include "cli/scenes.hpp"
#include "support/catch.hpp"

using program::Folder;
using program::Result;

namespace {

TEST_CASE("a hybrid run and one whose bodies sleep report what was counted")
{
    const Folder folder;
    const std::string scene = folder.file("two.json", scenes::two_bodies());
    const auto report_of = [&](std::vector<std::string> more, int status = 0) {
        std::vector<std::string> words = {"run",   scene,        "--frames", "5",     "--no-picture",
                                          "--out", folder / "o", "--json",   "--set", "method.substeps=2"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = folder.taut(words);
        INFO(result.err);
        REQUIRE(result.status == status);
        return program::parse(result.out);
    };
    const auto hybrid = report_of({"--device", "hybrid:cpu:serial", "--set", "method.type=implicit_euler",
                                   "--set", "method.iterations=1"});
    CHECK(hybrid["solver"]["solves"].get<int>() >= 5 * 2);
    CHECK(hybrid["solver"]["solves"].get<int>() <= 5 * 2 * 2);
    CHECK(hybrid["solver"]["last_status"] != "");
    CHECK(hybrid["primal_residual"].get<double>() >= 0);
    CHECK(hybrid["series"].size() == 6);
    const std::vector<std::string> slow = {"--device", "cpu:serial", "--set", "max_speed=0.01"};
    std::vector<std::string> asleep = slow;
    asleep.push_back("--sleep");
    const auto awake = report_of(slow, 1); // cut in every substep, which is unconverged
    CHECK(awake["status"] == "unconverged");
    REQUIRE(awake["warnings"].contains("speed_clamp"));
    CHECK(report_of(asleep, 1)["warnings"] == awake["warnings"]);
}

TEST_CASE("a hybrid run and one whose bodies sleep stop where a blow-up is seen, and say why")
{
    const Folder folder;
    const std::string scene = folder.file("two.json", scenes::two_bodies());
    const auto report_of = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"run",          scene,
                                          "--frames",     "80",
                                          "--no-picture", "--out",
                                          folder / "o",   "--json",
                                          "--set",        "method.type=mass_spring",
                                          "--set",        "method.stability=ignore",
                                          "--set",        "method.substeps=2"};
        words.insert(words.end(), more.begin(), more.end());
        const Result result = folder.taut(words);
        INFO(result.err);
        REQUIRE(result.status == 1);
        return program::parse(result.out);
    };
    const auto whole = report_of({"--device", "cpu:serial"});
    CHECK(whole["status"] == "diverged");
    CHECK(whole["frames"].get<int>() < 80);
    for (const std::vector<std::string>& how : std::vector<std::vector<std::string>>{
             {"--device", "cpu:serial", "--sleep"}, {"--device", "hybrid:cpu:serial+cpu:serial"}})
    {
        INFO(how.back());
        const auto report = report_of(how);
        CHECK(report["status"] == "diverged");
        CHECK(report["reason"] == whole["reason"]);
        CHECK(report["frames"] == whole["frames"]);
    }
}

} // namespace
