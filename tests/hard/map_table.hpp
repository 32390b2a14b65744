#pragma once
// The committed table of the robustness map: tests/hard/map.csv of the whole run, map_short.csv of the short
// one (TAUT_HARD_SHORT). One row a cell; the page docs/results/robustness.md shows map.csv.

#include "hard/map.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taut::hard {

struct Row
{
    std::string id, what, method, verdict;
    std::string criterion;                          ///< which the number is of; none of a refusal
    std::optional<double> number, limit;            ///< as measured, and the most that it may be
    std::optional<double> energy, inverted, volume; ///< MapCase::most_energy; where the run was looked at
    std::string effort;         ///< Effort::text()
    std::optional<double> cost; ///< Effort::cost(); none at the map's own settings
    std::string also = {};      ///< what the case asks and is missed besides: "criterion number; ..."

    bool same_cell(const Row& other) const
    {
        return id == other.id && what == other.what && method == other.method;
    }
};

/// A number may differ by this factor from the committed one.
inline constexpr double kFactor = 3;
/// Numbers below this part of their limit are roundings, which may differ by more.
inline constexpr double kFloor = 0.01;

Row row_of(const MapCase& hard_case, MethodKind method, const Outcome& outcome);

/// What keeps a row from being the committed one, in words; empty if nothing does.
std::string difference(const Row& committed, const Row& now);

std::filesystem::path table_file(bool short_form);
std::vector<Row> read_table(const std::filesystem::path& file);
void write_table(const std::filesystem::path& file, const std::vector<Row>& rows);

/// The table in Markdown, one row a case and one column a method, and how many cells have which verdict.
std::string page_of(const std::vector<Row>& rows);

/// The page's part between its marks; with `text`, that in its place.
std::string page_part();
void put_page_part(const std::string& text);

} // namespace taut::hard
