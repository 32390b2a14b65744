// Based on: Boisvert, Pozo, Remington. The Matrix Market Exchange Formats: Initial Design. NISTIR 5935, 1996.
// Departures: comments and blank lines may stand anywhere, each entry has a line of its own, and the banner's
//             words may be written in any case. A symmetric file with entries above its diagonal is refused.

#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/shown.hpp"
#include "taut/scene/words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace taut::linear {
namespace {

using scene_file::quoted;
using scene_file::Words;

enum class Field : std::uint8_t
{
    real,
    integer,
    pattern
};
enum class Symmetry : std::uint8_t
{
    general,
    symmetric,
    skew
};

struct Banner
{
    bool array = false;
    Field field = Field::real;
    Symmetry symmetry = Symmetry::general;
};

struct Sizes
{
    std::uint32_t rows = 0, columns = 0;
    std::uint64_t entries = 0; ///< lines that follow
};

constexpr std::uint64_t kMostFileRows = std::numeric_limits<std::uint32_t>::max() - 1ull;
/// A matrix with more rows or columns than this must have an entry for one in kRowsPerEntry of them: a short
/// text asks for little memory.
constexpr std::uint64_t kFreeRows = 1 << 22;
constexpr std::uint64_t kRowsPerEntry = 16;

std::string lower(std::string_view word)
{
    std::string text(word);
    for (char& c : text)
        c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return text;
}

class Parser
{
public:
    Parser(std::string_view text, const std::string& name) : text_(text), words_(text, name)
    {
        words_.set_comment('\0'); // '%' only begins one where it begins a line
    }

    MatrixFile parse()
    {
        read_banner();
        read_sizes();
        if (banner_.array)
            read_array();
        else
            read_coordinates();
        if (next_line())
            words_.fail(quoted(words_.word()) + " stands behind the last of the " + promised());
        out_.stored_symmetric = banner_.symmetry != Symmetry::general;
        out_.matrix = from_triplets(sizes_.rows, sizes_.columns, triplets_, &out_.notes);
        refuse_overflow();
        return std::move(out_);
    }

private:
    /// Finite entries of one place may add up to what is not.
    void refuse_overflow() const
    {
        const SparseMatrix& a = out_.matrix;
        for (std::uint32_t i = 0; i < a.rows && out_.notes.duplicates > 0; ++i)
            for (std::uint32_t k = a.row_start[i]; k < a.row_start[i + 1]; ++k)
                if (!std::isfinite(a.value[k]))
                    words_.fail("the entries at row " + std::to_string(i + 1) + ", column " +
                                std::to_string(a.column[k] + 1ull) + " (counted from 1) add up to " +
                                "what double does not hold");
    }

    /// To the next line that is neither blank nor a comment; comments are kept.
    bool next_line()
    {
        while (words_.next_line())
        {
            if (text_[words_.offset()] != '%')
                return true;
            std::string_view line = text_.substr(words_.offset() + 1);
            line = line.substr(0, line.find('\n')); // to the end where there is none
            if (line.ends_with('\r'))
                line.remove_suffix(1);
            (out_.comment += out_.comment.empty() ? "" : "\n") += line;
        }
        return false;
    }

    void end_line(const char* what)
    {
        if (const std::string_view more = words_.word(); !more.empty())
            words_.fail(quoted(more) + " stands behind " + what);
    }

    void read_banner()
    {
        words_.next_line();
        if (lower(words_.word()) != "%%matrixmarket")
            words_.fail("a Matrix Market file begins with \"%%MatrixMarket matrix coordinate real general\" "
                        "or the like");
        if (const auto word = words_.word(); lower(word) != "matrix")
            words_.fail("the object is " + quoted(word) + "; it must be matrix");
        const auto format = words_.word();
        if (lower(format) != "coordinate" && lower(format) != "array")
            words_.fail("the format is " + quoted(format) + "; it must be coordinate or array");
        banner_.array = lower(format) == "array";
        banner_.field = read_field();
        banner_.symmetry = read_symmetry();
        end_line("the banner");
        if (banner_.field == Field::pattern && banner_.array)
            words_.fail("an array of pattern has no values; write coordinate, or real");
        if (banner_.field == Field::pattern && banner_.symmetry == Symmetry::skew)
            words_.fail("a pattern has no signs, so it cannot be skew-symmetric");
    }

    Field read_field()
    {
        const auto word = words_.word();
        const std::string field = lower(word);
        if (field == "complex")
            words_.fail("complex matrices are not supported; the field must be real, integer or pattern");
        if (field == "pattern")
            return Field::pattern;
        if (field == "integer")
            return Field::integer;
        if (field != "real" && field != "double") // an older word for it
            words_.fail("the field is " + quoted(word) + "; it must be real, integer or pattern");
        return Field::real;
    }

    Symmetry read_symmetry()
    {
        const auto word = words_.word();
        const std::string symmetry = lower(word);
        if (symmetry == "hermitian")
            words_.fail("hermitian matrices are not supported; a real one is called symmetric");
        if (symmetry == "symmetric")
            return Symmetry::symmetric;
        if (symmetry == "skew-symmetric")
            return Symmetry::skew;
        if (symmetry != "general")
            words_.fail("the symmetry is " + quoted(word) +
                        "; it must be general, symmetric or skew-symmetric");
        return Symmetry::general;
    }

    std::uint64_t read_count(const char* what, std::uint64_t most)
    {
        const auto word = words_.word();
        std::uint64_t value = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || end != word.data() + word.size() ||
            (code != std::errc() && code != std::errc::result_out_of_range))
            words_.fail(std::string(what) + " is " + quoted(word) + "; it must be a whole number from 0");
        if (code != std::errc() || value > most)
            words_.fail(std::string(what) + " is " + quoted(word) + "; at most " + std::to_string(most) +
                        " can be held");
        return value;
    }

    /// Lines of an array: all entries, or the lower triangle with or without its diagonal.
    std::uint64_t array_entries() const
    {
        const std::uint64_t n = sizes_.rows; // below 2^32, so that nothing wraps
        if (banner_.symmetry == Symmetry::general)
            return n * sizes_.columns;
        return banner_.symmetry == Symmetry::symmetric ? n * (n + 1) / 2 : (n > 0 ? n * (n - 1) / 2 : 0);
    }

    void read_sizes()
    {
        if (!next_line())
            words_.fail("the file ends before the size line, rows columns" +
                        std::string(banner_.array ? "" : " entries"));
        sizes_.rows = std::uint32_t(read_count("the number of rows", kMostFileRows));
        sizes_.columns = std::uint32_t(read_count("the number of columns", kMostFileRows));
        sizes_.entries = banner_.array ? array_entries() : read_count("the number of entries", kMostFileRows);
        end_line("the size line");
        if (banner_.symmetry != Symmetry::general && sizes_.rows != sizes_.columns)
            words_.fail("a symmetric or skew-symmetric matrix is square, but this one is said to be " +
                        std::to_string(sizes_.rows) + " x " + std::to_string(sizes_.columns));
        refuse_lies();
    }

    /// Before any memory is asked for.
    void refuse_lies()
    {
        const std::uint64_t shortest = banner_.array                     ? 2
                                       : banner_.field == Field::pattern ? 4
                                                                         : 6; // "1 1 1\n"
        if (sizes_.entries > (words_.left() + 1) / shortest) // the last line end may be missing
            words_.fail("the size line promises " + counted(sizes_.entries, "entry", "entries") +
                        ", of at least " + std::to_string(shortest) + " bytes each, but only " +
                        counted(words_.left(), "byte follows", "bytes follow"));
        const std::uint64_t size = std::max(sizes_.rows, sizes_.columns);
        if (size > kFreeRows && size / kRowsPerEntry > sizes_.entries)
            words_.fail("the size line promises a matrix of " + std::to_string(sizes_.rows) + " x " +
                        std::to_string(sizes_.columns) + " with only " +
                        counted(sizes_.entries, "entry", "entries") +
                        ": nearly all of it would be empty; renumber what is not");
        // A mirrored entry is two, but no more than a byte of text each.
        triplets_.reserve(sizes_.entries * (banner_.symmetry == Symmetry::general ? 1 : 2));
    }

    std::string promised() const
    {
        return counted(sizes_.entries, "entry", "entries") + " that the size line promises";
    }

    void entry_line(std::uint64_t done)
    {
        if (!next_line())
            words_.fail("the file ends after " + std::to_string(done) + " of the " + promised());
    }

    std::uint32_t read_index(const char* what, std::uint32_t most)
    {
        const auto word = words_.word();
        std::uint32_t value = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (end != word.data() + word.size() || code != std::errc() || value < 1 || value > most)
            words_.fail(std::string(what) + " is " + quoted(word) + "; it must be a whole number from 1 to " +
                        std::to_string(most));
        return value - 1;
    }

    double read_value()
    {
        const auto word = words_.word();
        const std::string_view digits = word.substr(word.starts_with('+') ? 1 : 0);
        const char* const last = digits.data() + digits.size();
        if (word.starts_with("+-"))
            words_.fail("the value is " + quoted(word) + "; it must be a number of one sign");
        if (banner_.field == Field::integer)
        {
            std::int64_t value = 0;
            const auto [end, code] = std::from_chars(digits.data(), last, value);
            if (code != std::errc() || end != last)
                words_.fail("the value is " + quoted(word) +
                            "; in a file of integers it must be a whole number "
                            "of at most 18 digits");
            return double(value);
        }
        double value = 0;
        const auto [end, code] = std::from_chars(digits.data(), last, value);
        if (code == std::errc::result_out_of_range && end == last)
            return read_extreme(digits, word);
        if (code != std::errc() || end != last)
            words_.fail("the value is " + quoted(word) + "; it must be a decimal number");
        if (!std::isfinite(value))
            words_.fail("the value is " + quoted(word) + "; it must be finite");
        return value;
    }

    /// A number that double does not hold: what rounds to zero (or to a number below the smallest) is that.
    double read_extreme(std::string_view digits, std::string_view word) const
    {
        long double wide = 0;
        const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), wide);
        if (code != std::errc() || std::abs(wide) > 1)
            words_.fail("the value is " + quoted(word) + "; it must lie within the range of double, 1.8e308");
        return double(wide);
    }

    void put(std::uint32_t row, std::uint32_t column, double value)
    {
        triplets_.push_back({row, column, value});
        if (banner_.symmetry != Symmetry::general && row != column)
            triplets_.push_back({column, row, banner_.symmetry == Symmetry::skew ? -value : value});
    }

    void read_coordinates()
    {
        for (std::uint64_t k = 0; k < sizes_.entries; ++k)
        {
            entry_line(k);
            const std::uint32_t row = read_index("the row", sizes_.rows);
            const std::uint32_t column = read_index("the column", sizes_.columns);
            if (banner_.symmetry != Symmetry::general && column > row)
                words_.fail(
                    "entry (" + std::to_string(row + 1) + ", " + std::to_string(column + 1) +
                    ") lies above the diagonal; a symmetric file stores the lower triangle, row >= column");
            if (banner_.symmetry == Symmetry::skew && column == row)
                words_.fail(
                    "entry (" + std::to_string(row + 1) + ", " + std::to_string(row + 1) +
                    ") lies on the diagonal, which is zero in a skew-symmetric matrix and not stored");
            const double value = banner_.field == Field::pattern ? 1.0 : read_value();
            end_line("the entry");
            put(row, column, value);
        }
    }

    void read_array()
    {
        std::uint64_t done = 0;
        for (std::uint32_t column = 0; column < sizes_.columns; ++column)
        {
            const std::uint32_t first = banner_.symmetry == Symmetry::general     ? 0
                                        : banner_.symmetry == Symmetry::symmetric ? column
                                                                                  : column + 1;
            for (std::uint32_t row = first; row < sizes_.rows; ++row)
            {
                entry_line(done++);
                const double value = read_value();
                end_line("the entry");
                if (value != 0) // a dense matrix stores its zeros because it must
                    put(row, column, value);
            }
        }
    }

    std::string_view text_;
    Words words_;
    Banner banner_;
    Sizes sizes_;
    std::vector<Triplet> triplets_;
    MatrixFile out_;
};

} // namespace

MatrixFile parse_matrix_market(std::string_view text, const std::string& name)
{
    return Parser(text, name).parse();
}

} // namespace taut::linear
