#pragma once
// The committed table of what a GPU's compiler makes of the kernels (tests/hardware/radv.csv), and how a new
// one is judged by it.

#include "taut/runtime/base/kernel_info.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut::hardware {

/// The columns of numbers, as the CSV's head names them.
enum Column : std::size_t
{
    kWave,         ///< invocations of a wave
    kVgprs,        ///< vector registers of a wave
    kSgprs,        ///< scalar registers of a wave
    kSpilledVgprs, ///< registers that did not fit
    kSpilledSgprs,
    kScratch,           ///< bytes of scratch memory, a wave
    kShared,            ///< bytes of work-group memory (LDS)
    kOccupancy,         ///< waves that one SIMD holds at once
    kCode,              ///< bytes
    kLatency,           ///< cycles of one wave alone, as the compiler estimates them
    kInverseThroughput, ///< cycles of one SIMD for 64 invocations when it is full, estimated likewise
    kColumns
};

struct Row
{
    std::string family, kernel, precision; ///< kernel: "distance" or "distance:lambda"
    std::array<std::int64_t, kColumns> numbers = {};

    bool same_kernel(const Row& other) const
    {
        return family == other.family && kernel == other.kernel && precision == other.precision;
    }
    /// "navi21 distance:lambda double"
    std::string name() const { return family + " " + kernel + " " + precision; }
};

struct Table
{
    std::string mesa; ///< "Mesa 22.3.6"
    std::vector<Row> rows;
};

std::filesystem::path table_file();

/// Throws Error{io} where the file cannot be read, Error{bad_input} naming file and line where it is no
/// table.
Table read_table(const std::filesystem::path& file);
void write_table(const std::filesystem::path& file, const Table& table);

/// What is wrong with what was compiled, a sentence each. Of every kernel: registers that spill, or
/// scratch memory; no row of its own in the committed table, or a row of it without a kernel. With the
/// table's Mesa also registers, code or inverse throughput that grew beyond kGrowth; another compiler is not
/// compared with this one.
std::vector<std::string> faults(const Table& committed, const Table& now);

/// A number may be this much larger than the committed one.
inline constexpr double kGrowth = 1.1;

} // namespace taut::hardware
