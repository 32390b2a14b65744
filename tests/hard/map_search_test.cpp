// Finds the cheapest settings at which cells of the robustness map pass that do not at the map's own; for
// map_effort.cpp. Hidden: tests/hard/update_map.sh search [CASE].

#include "hard/map_table.hpp"

#include <algorithm>
#include <iostream>
#include <tuple>

namespace taut::hard {
namespace {

constexpr std::uint32_t kMostCost = 64;

/// Multiples that a method may take, cheapest first; of what costs the same, single precision and substeps.
std::vector<Effort> candidates(MethodKind method)
{
    const bool explicit_steps = method == MethodKind::mass_spring;
    std::vector<Effort> out;
    for (std::uint32_t s = 1; s <= kMostCost; s *= 2)
        for (std::uint32_t i = 1; s * i <= kMostCost && (i == 1 || !explicit_steps); i *= 2)
            for (const bool in_double : {false, true})
                out.push_back({s, i, in_double});
    std::sort(out.begin(), out.end(), [](const Effort& a, const Effort& b) {
        const auto key = [](const Effort& e) {
            return std::tuple(e.cost() * (e.in_double ? 2 : 1), e.in_double, e.iterations);
        };
        return key(a) < key(b);
    });
    return out;
}

void search(MapCase hard_case, MethodKind method, const std::shared_ptr<Device>& device)
{
    std::string best;
    for (const Effort& effort : candidates(method))
    {
        hard_case.effort[method] = effort;
        const Outcome outcome = judged(hard_case, method, device);
        const Measured shown = outcome.shown();
        const std::string now = effort.text() + ": " + outcome.verdict + " " + shown.what + " " +
                                std::to_string(shown.value) + " of " + std::to_string(shown.limit);
        if (best.empty() || outcome.verdict == "pass")
            best = now;
        if (outcome.verdict == "pass" || outcome.refused())
            break;
    }
    std::cout << hard_case.id << " | " << hard_case.what << " | "
              << kWords<MethodKind>[static_cast<std::size_t>(method)] << " | " << best << std::endl;
}

} // namespace

TEST_CASE("search for settings at which cells of the map pass", "[.search]")
{
    const std::vector<Row> table = read_table(table_file(short_run()));
    const char* only_id = std::getenv("TAUT_MAP_ONLY");
    std::vector<std::pair<MapCase, MethodKind>> wanted;
    for (const MapCase& c : map_cases())
        for (std::size_t m = 0; m < kWords<MethodKind>.size(); ++m)
            for (const Row& row : table)
                if (row.id == c.id && row.what == c.what && row.method == kWords<MethodKind>[m] &&
                    (!only_id || c.id == only_id) &&
                    (row.verdict == "reports" || row.verdict == "FAIL" || row.verdict.starts_with("stops")))
                    wanted.emplace_back(c, static_cast<MethodKind>(m));
    const std::shared_ptr<Device> device = Device::open("cpu:serial", {});
    for (const auto& [hard_case, method] : wanted)
        search(hard_case, method, device);
    CHECK(!table.empty());
}

TEST_CASE("count the cells that run whole on Vulkan", "[.whole]")
{
    const std::shared_ptr<Device> device = open_test_device("vulkan");
    std::size_t runs = 0, whole = 0;
    for (const MapCase& c : map_cases())
        for (std::size_t m = 0; m < kWords<MethodKind>.size(); ++m)
            try
            {
                const int steps =
                    steps_within(kDispatchesElsewhere, c, static_cast<MethodKind>(m), device, c.steps);
                ++runs;
                whole += steps == c.steps;
            }
            catch (const Error&)
            {}
    std::cout << whole << " of " << runs << " cells\n";
    CHECK(runs > 0);
}

} // namespace taut::hard
