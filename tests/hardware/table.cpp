#include "hardware/table.hpp"

#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

namespace taut::hardware {
namespace {

constexpr const char* kHead = "family,kernel,precision,wave,vgprs,sgprs,spilled_vgprs,spilled_sgprs,"
                              "scratch_bytes,lds_bytes,waves_per_simd,code_bytes,latency,inverse_throughput";
constexpr const char* kWritten = ", written by tests/hardware/update.sh";
constexpr std::size_t kNames = 3;

/// What must not grow, and what it is called.
struct Bound
{
    Column column;
    const char* what;
};
constexpr Bound kBounds[] = {{kVgprs, "vector registers"},
                             {kSgprs, "scalar registers"},
                             {kCode, "bytes of code"},
                             {kInverseThroughput, "cycles of inverse throughput"}};
constexpr Bound kSpills[] = {{kSpilledVgprs, "vector registers"},
                             {kSpilledSgprs, "scalar registers"},
                             {kScratch, "bytes into scratch memory"}};

[[noreturn]] void refuse(const std::filesystem::path& file, std::size_t line, const std::string& what)
{
    throw Error(ErrorCode::bad_input, file.string() + ":" + std::to_string(line) + ": " + what +
                                          "; tests/hardware/update.sh writes the table anew");
}

std::vector<std::string> fields_of(const std::string& line)
{
    std::vector<std::string> out;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');)
        out.push_back(field);
    return out;
}

Row row_of(const std::string& line, const std::filesystem::path& file, std::size_t number)
{
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != kNames + kColumns)
        refuse(file, number,
               "a row has " + std::to_string(kNames + kColumns) + " fields, this one " +
                   std::to_string(fields.size()));
    Row row{fields[0], fields[1], fields[2], {}};
    for (std::size_t i = 0; i < kColumns; ++i)
    {
        const std::string& text = fields[kNames + i];
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), row.numbers[i]);
        if (error != std::errc() || end != text.data() + text.size() || row.numbers[i] < 0)
            refuse(file, number, "\"" + text + "\" is no whole number of 0 or more");
    }
    return row;
}

const Row* find(const std::vector<Row>& rows, const Row& wanted)
{
    const auto found =
        std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.same_kernel(wanted); });
    return found == rows.end() ? nullptr : &*found;
}

void add_growth(std::vector<std::string>& out, const Row& before, const Row& now)
{
    for (const auto& [column, what] : kBounds)
    {
        const std::int64_t was = before.numbers[column], is = now.numbers[column];
        if (static_cast<double>(is) > kGrowth * static_cast<double>(was))
            out.push_back(now.name() + ": " + std::to_string(is) + " " + what + ", the table has " +
                          std::to_string(was));
    }
}

} // namespace

std::filesystem::path table_file() { return TAUT_SOURCE_DIR "/tests/hardware/radv.csv"; }

Table read_table(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in)
        throw Error(ErrorCode::io, file.string() + " cannot be read; tests/hardware/update.sh writes it");
    Table table;
    std::string line;
    std::getline(in, line);
    const std::size_t end = line.find(',');
    if (!line.starts_with("# Mesa ") || end == std::string::npos)
        refuse(file, 1, "the first line is \"# Mesa VERSION, ...\"");
    table.mesa = line.substr(2, end - 2);
    std::getline(in, line);
    if (line != kHead)
        refuse(file, 2, "the second line is \"" + std::string(kHead) + "\"");
    for (std::size_t number = 3; std::getline(in, line); ++number)
        table.rows.push_back(row_of(line, file, number));
    return table;
}

void write_table(const std::filesystem::path& file, const Table& table)
{
    std::string text = "# " + table.mesa + kWritten + "\n" + kHead + "\n";
    for (const Row& row : table.rows)
    {
        text += row.family + "," + row.kernel + "," + row.precision;
        for (const std::int64_t number : row.numbers)
            text += "," + std::to_string(number);
        text += "\n";
    }
    write_file(file, text);
}

std::vector<std::string> faults(const Table& committed, const Table& now)
{
    std::vector<std::string> out;
    for (const Row& row : now.rows)
    {
        for (const auto& [column, what] : kSpills)
            if (row.numbers[column] != 0)
                out.push_back(row.name() + ": spills " + std::to_string(row.numbers[column]) + " " + what);
        const Row* before = find(committed.rows, row);
        if (before == nullptr)
            out.push_back(row.name() + ": the table has no row for it; tests/hardware/update.sh writes one");
        else if (committed.mesa == now.mesa)
            add_growth(out, *before, row);
    }
    for (const Row& row : committed.rows)
        if (find(now.rows, row) == nullptr)
            out.push_back(row.name() + ": the table has a row for it, but no such kernel was compiled");
    return out;
}

} // namespace taut::hardware
