// taut_bench [--json] [distance] [recording] [cloth] [opencloth] [solid] [FILE.csv]: prints the tables of
// docs/bench.md that are named, or all, and, if asked, writes them as CSV. With --json it prints one line, an
// object, in place of the tables: `taut_bench --json >> MACHINE.jsonl` keeps the history of a machine. Exit
// status 1 and one sentence when a rival computes something else, or the file cannot be written.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <string>

namespace {

constexpr struct
{
    const char* name;
    std::vector<bench::Row> (*make)();
} kTables[] = {{"distance", bench::distance_rows},
               {"recording", bench::recording_rows},
               {"cloth", bench::cloth_rows},
               {"opencloth", bench::opencloth_rows},
               {"solid", bench::solid_rows},
               {"solid", bench::solid_static_rows}};

void print(const std::vector<bench::Row>& rows)
{
    std::printf(
        "| what | median ms | best ms | error m | ratio | to | target |\n|---|---|---|---|---|---|---|\n");
    for (const bench::Row& r : rows)
        std::printf("| %s | %.3f | %.3f | %.2g | %.2f | %s | %s |\n", r.what.c_str(), r.milliseconds, r.best,
                    r.error, r.ratio, r.against.c_str(),
                    r.target > 0 ? taut::shown(r.target, 3).c_str() : "");
}

std::string csv(const std::vector<bench::Row>& rows, const std::string& conditions)
{
    std::string text = "# " + conditions + "\nwhat,median_ms,best_ms,error_m,ratio,to,target\n";
    for (const bench::Row& r : rows)
    {
        text += '"' + r.what + '"';
        for (const double value : {r.milliseconds, r.best, r.error, r.ratio})
            text += ',' + taut::shown(value, 6);
        text += ",\"" + r.against + "\"," + taut::shown(r.target) + '\n';
    }
    return text;
}

/// Units as in Row; `ratio`, `to` and `target` of rows that are compared with none are left out.
std::string json(const std::vector<bench::Row>& rows, const std::string& conditions)
{
    char now[32];
    const std::time_t seconds = std::time(nullptr);
    std::strftime(now, sizeof now, "%FT%TZ", std::gmtime(&seconds));
    nlohmann::ordered_json out = {
        {"time", now}, {"conditions", conditions}, {"rows", nlohmann::ordered_json::array()}};
    for (const bench::Row& r : rows)
    {
        nlohmann::ordered_json row = {
            {"what", r.what}, {"median_ms", r.milliseconds}, {"best_ms", r.best}, {"error_m", r.error}};
        if (!r.against.empty())
            row.update({{"ratio", r.ratio}, {"to", r.against}});
        if (r.target > 0)
            row["target"] = r.target;
        out["rows"].push_back(row);
    }
    return out.dump();
}

} // namespace

int main(int argc, char** argv)
try
{
    std::vector<std::string> words(argv + 1, argv + argc);
    std::string file;
    const bool as_json = std::erase(words, "--json") > 0;
    if (!words.empty() && words.back().find('.') != std::string::npos)
    {
        file = words.back();
        words.pop_back();
    }
    std::vector<bench::Row> rows;
    for (const std::string& word : words)
        if (std::none_of(std::begin(kTables), std::end(kTables),
                         [&](const auto& t) { return word == t.name; }))
        {
            std::string text = "\"" + word + "\" is no table; they are";
            for (const auto& table : kTables)
                text += std::string(" ") + table.name;
            throw std::runtime_error(text);
        }
    for (const auto& [name, make] : kTables)
        if (words.empty() || std::find(words.begin(), words.end(), name) != words.end())
            for (const bench::Row& row : make())
                rows.push_back(row);
    if (as_json)
        std::printf("%s\n", json(rows, bench::conditions("taut_bench", argc, argv)).c_str());
    else
        print(rows);
    if (!file.empty())
        taut::write_file(file, csv(rows, bench::conditions("taut_bench", argc, argv)));
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_bench: %s\n", error.what());
    return 1;
}
