// Based on: Boisvert, Pozo, Remington. The Matrix Market Exchange Formats: Initial Design. NISTIR 5935, 1996.
// Departures: none in what is written.

#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/atomic_file.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/file_text.hpp"

#include <charconv>
#include <cmath>

namespace taut::linear {
namespace {

constexpr std::uintmax_t kMostBytes = std::uintmax_t(1) << 36; ///< of a file that is read

/// A number's 17 significant digits, which read back as the same double.
void append(std::string& text, double value)
{
    char digits[40];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 16).ptr;
    text.append(digits, end);
}

std::string head(const std::string& banner, std::string_view comment)
{
    std::string text = banner + "\n";
    while (!comment.empty())
    {
        const std::size_t end = comment.find('\n');
        text += "% " + std::string(comment.substr(0, end)) + "\n";
        comment = end == std::string_view::npos ? std::string_view() : comment.substr(end + 1);
    }
    return text;
}

void refuse_non_finite(std::span<const double> values, const std::string& path)
{
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k]))
            throw Error(ErrorCode::bad_input,
                        path + ": not written: value " + std::to_string(k) +
                            " (counted from 0) is not finite, which a Matrix Market file "
                            "cannot hold");
}

} // namespace

MatrixFile read_matrix_market(const std::string& path)
{
    return parse_matrix_market(scene_file::read_file(path, kMostBytes), path);
}

std::vector<double> read_vector(const std::string& path)
{
    const SparseMatrix a = read_matrix_market(path).matrix;
    if (a.columns != 1)
        throw Error(ErrorCode::bad_input, path + ": a vector is a matrix of one column, but this one is " +
                                              std::to_string(a.rows) + " x " + std::to_string(a.columns) +
                                              (a.rows == 1 ? ": transpose it" : ""));
    std::vector<double> values(a.rows, 0.0);
    for (std::uint32_t i = 0; i < a.rows; ++i)
        if (a.row_length(i) > 0)
            values[i] = a.value[a.row_start[i]];
    return values;
}

void write_vector(const std::string& path, std::span<const double> values, std::string_view comment)
{
    refuse_non_finite(values, path);
    std::string text = head("%%MatrixMarket matrix array real general", comment);
    text += std::to_string(values.size()) + " 1\n";
    for (const double v : values)
    {
        append(text, v);
        text += '\n';
    }
    write_file(path, text);
}

void write_matrix_market(const std::string& path, const SparseMatrix& a, std::string_view comment)
{
    refuse_non_finite(a.value, path);
    std::string text = head("%%MatrixMarket matrix coordinate real general", comment);
    text +=
        std::to_string(a.rows) + ' ' + std::to_string(a.columns) + ' ' + std::to_string(a.nonzeros()) + '\n';
    for (std::uint32_t i = 0; i < a.rows; ++i)
        for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
        {
            text += std::to_string(i + 1) + ' ' + std::to_string(a.column[k] + 1ull) + ' ';
            append(text, a.value[k]);
            text += '\n';
        }
    write_file(path, text);
}

} // namespace taut::linear
