#include "taut/linear/grid.hpp"

#include <algorithm>
#include <string>

namespace taut::linear {

std::uint32_t group_count_for(std::uint32_t rows, const DeviceInfo& device)
{
    const std::uint32_t most = device.hardware_gpu ? 1024 : 256;
    const std::uint32_t wanted = rows / TAUT_LINEAR_GROUP + (rows % TAUT_LINEAR_GROUP != 0 ? 1 : 0);
    return std::clamp(wanted, 1u, most);
}

void check_row_count(std::uint64_t rows)
{
    if (rows > kMostRows)
        throw Error(ErrorCode::limit, "the system has " + std::to_string(rows) + " rows, and " +
                                          std::to_string(kMostRows) +
                                          " are the most that kernels can number: split the system");
}

void check_entry_count(std::uint64_t entries, std::string_view what)
{
    if (entries > kMostEntries)
        throw Error(ErrorCode::limit, std::string(what) + " would store " + std::to_string(entries) +
                                          " entries, and " + std::to_string(kMostEntries) +
                                          " are the most that kernels can number: take a format with less "
                                          "padding, or a matrix-free operator");
}

Grid make_grid(std::uint32_t count, std::uint32_t groups, std::uint32_t multiple)
{
    const std::uint64_t share = count / groups + (count % groups != 0 ? 1 : 0);
    const std::uint64_t chunk = (share + multiple - 1) / multiple * multiple;
    if (chunk * groups > 0xffffffffu)
        throw Error(ErrorCode::limit, std::to_string(count) + " units in shares of " +
                                          std::to_string(chunk) + " for " + std::to_string(groups) +
                                          " groups go beyond 32 bits (4294967295)");
    return {count, groups, static_cast<std::uint32_t>(chunk)};
}

} // namespace taut::linear
