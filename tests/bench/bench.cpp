// taut_bench [FILE.csv]: prints the table of docs/bench.md and, if asked, writes it as CSV.

#include "bench.hpp"

#include "taut/version.hpp"

#include <cstdio>
#include <fstream>

int main(int argc, char** argv)
{
    std::vector<bench::Row> rows = bench::distance_rows();
    for (const bench::Row& row : bench::recording_rows())
        rows.push_back(row);
    std::printf("| what | median ms | best ms | error | ratio | to | target |\n|---|---|---|---|---|---|---|\n");
    for (const bench::Row& r : rows)
        std::printf("| %s | %.3f | %.3f | %.2g | %.2f | %s | %s |\n", r.what.c_str(), r.milliseconds, r.best, r.error,
                    r.ratio, r.against.c_str(), r.target > 0 ? std::to_string(r.target).substr(0, 4).c_str() : "");
    if (argc < 2)
        return 0;
    const std::string temporary = std::string(argv[1]) + ".tmp";
    {
        std::ofstream file(temporary);
        file << "# taut " << TAUT_VERSION << "; command: taut_bench FILE.csv\n"
             << "what,median_ms,best_ms,error,ratio,to,target\n";
        for (const bench::Row& r : rows)
            file << '"' << r.what << "\"," << r.milliseconds << ',' << r.best << ',' << r.error << ',' << r.ratio << ",\""
                 << r.against << "\"," << r.target << '\n';
    }
    return std::rename(temporary.c_str(), argv[1]) == 0 ? 0 : 1;
}
