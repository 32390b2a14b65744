// What the subcommands of taut_linear_bench share.

#include "linear_bench.hpp"
#include "taut/runtime/base/csv.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

namespace bench {

System manufactured(std::string name, taut::linear::SparseMatrix a)
{
    System system;
    system.name = std::move(name);
    std::mt19937 random(1);
    system.exact.resize(a.rows);
    for (double& entry : system.exact)
        entry = static_cast<double>(random()) / 2147483647.5 - 1; // the same numbers with every library
    system.b.resize(a.rows);
    taut::linear::multiply(a, system.exact, system.b);
    system.a = std::move(a);
    return system;
}

std::filesystem::path matrix_folder()
{
    const char* named = std::getenv("TAUT_DATA");
    const std::filesystem::path folder =
        (named ? std::filesystem::path(named) : std::filesystem::path(TAUT_SOURCE_DIR) / "../shared/data") /
        "matrices";
    if (std::filesystem::exists(folder))
        return folder;
    std::fprintf(stderr,
                 "no folder %s: real matrices are left out; set TAUT_DATA to the folder of the data\n",
                 folder.string().c_str());
    return {};
}

} // namespace bench
