// taut_bench [FILE.csv]: prints the table of docs/bench.md and, if asked, writes it as CSV.
// Exit status 1 and one sentence when a rival computes something else, or the file cannot be written.

#include "bench.hpp"
#include "conditions.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/shown.hpp"

#include <cstdio>
#include <exception>

namespace {

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

} // namespace

int main(int argc, char** argv)
try
{
    std::vector<bench::Row> rows = bench::distance_rows();
    for (const bench::Row& row : bench::recording_rows())
        rows.push_back(row);
    print(rows);
    if (argc > 1)
        taut::write_file(argv[1], csv(rows, bench::conditions("taut_bench", argc, argv)));
    return 0;
}
catch (const std::exception& error)
{
    std::fprintf(stderr, "taut_bench: %s\n", error.what());
    return 1;
}
