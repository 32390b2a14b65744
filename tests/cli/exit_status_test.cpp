// The tables of docs/statuses.md against what the program does.

#include "support/catch.hpp"

#include "taut/cli/exit_status.hpp"

#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace {

using namespace taut;

/// Word -> exit status, of the table in the section with that heading: first and last cell of each row.
std::map<std::string, int> table(const std::string& heading)
{
    std::ifstream file(TAUT_SOURCE_DIR "/docs/statuses.md");
    REQUIRE(file);
    std::map<std::string, int> rows;
    bool inside = false;
    for (std::string line; std::getline(file, line);)
    {
        if (line.starts_with("## "))
            inside = line.starts_with("## " + heading);
        if (!inside || !line.starts_with("| `"))
            continue;
        const std::size_t end = line.find('`', 3), last = line.rfind('|', line.rfind('|') - 1);
        rows[line.substr(3, end - 3)] = std::stoi(line.substr(last + 1));
    }
    return rows;
}

} // namespace

TEST_CASE("docs/statuses.md lists every error code with the exit status that the program gives it")
{
    const auto rows = table("Error codes");
    int codes = 0;
    for (; to_string(static_cast<ErrorCode>(codes)) != "unknown"; ++codes)
    {
        const auto code = static_cast<ErrorCode>(codes);
        INFO(to_string(code));
        REQUIRE(rows.count(std::string(to_string(code))) == 1);
        CHECK(rows.at(std::string(to_string(code))) == cli::exit_status(code));
    }
    CHECK(rows.size() == static_cast<std::size_t>(codes));
    CHECK(rows.size() == 11);
}

TEST_CASE("docs/statuses.md lists every status with the exit status that the program gives it")
{
    const std::map<std::string, Status> statuses = {
        {"completed", Status::completed},
        {"interrupted", Status::interrupted},
        {"diverged", Status::diverged},
        {"unconverged", Status::unconverged},
        {"non_finite", Status::non_finite},
        {"converged", Status::converged},
        {"iteration_limit", Status::iteration_limit},
        {"stagnated", Status::stagnated},
        {"indefinite_matrix", Status::indefinite_matrix},
        {"indefinite_preconditioner", Status::indefinite_preconditioner},
        {"zero_right_hand_side", Status::zero_right_hand_side},
    };
    const auto rows = table("Status");
    CHECK(rows.size() == statuses.size());
    for (const auto& [word, status] : statuses)
    {
        INFO(word);
        REQUIRE(rows.count(word) == 1);
        CHECK(rows.at(word) == cli::exit_status(status));
    }
}
