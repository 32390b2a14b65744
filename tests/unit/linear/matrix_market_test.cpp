// Matrix Market files: what they mean, and what is refused in words.

#include "../scene/temporary.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/error.hpp"

#include "support/catch.hpp"

#include <functional>
#include <limits>

using namespace taut;
using namespace taut::linear;

namespace {

const std::string kReal = "%%MatrixMarket matrix coordinate real general\n";
const std::string kSymmetric = "%%MatrixMarket matrix coordinate real symmetric\n";
const std::string kArray = "%%MatrixMarket matrix array real general\n";

SparseMatrix read(const std::string& text) { return parse_matrix_market(text, "a.mtx").matrix; }

/// The sentence of the refusal; "" where the text passes.
std::string refusal(const std::string& text)
{
    try
    {
        parse_matrix_market(text, "a.mtx");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_input);
        CHECK(std::string(error.what()).starts_with("a.mtx: line "));
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part)
{
    if (text.find(part) != std::string::npos)
        return true;
    WARN("message: \"" << text << "\", wanted: \"" << part << "\"");
    return false;
}

void require_dense(const SparseMatrix& a, std::uint32_t rows, std::uint32_t columns,
                   std::vector<double> values)
{
    REQUIRE(a.rows == rows);
    REQUIRE(a.columns == columns);
    std::vector<double> dense(values.size(), 0.0);
    for (const Triplet& t : to_triplets(a))
        dense[std::size_t(t.row) * columns + t.column] = t.value;
    CHECK(dense == values);
}

} // namespace

TEST_CASE("coordinate files: general, symmetric, skew-symmetric; real, integer, pattern", "[matrix_market]")
{
    require_dense(read(kReal + "2 3 3\n1 1 1.5\n2 3 -2e-3\n1 2 .25\n"), 2, 3, {1.5, .25, 0, 0, 0, -2e-3});
    const MatrixFile s = parse_matrix_market(kSymmetric + "3 3 3\n1 1 4\n3 1 -1\n3 3 5\n", "a.mtx");
    require_dense(s.matrix, 3, 3, {4, 0, -1, 0, 0, 0, -1, 0, 5});
    CHECK(s.stored_symmetric);
    CHECK_FALSE(parse_matrix_market(kReal + "1 1 1\n1 1 1\n", "a.mtx").stored_symmetric);
    require_dense(read("%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 7\n"), 2, 2,
                  {0, -7, 7, 0});
    require_dense(read("%%MatrixMarket matrix coordinate integer general\n1 2 2\n1 1 -3\n1 2 +4\n"), 1, 2,
                  {-3, 4});
    require_dense(read("%%MatrixMarket matrix coordinate pattern symmetric\n2 2 2\n1 1\n2 1\n"), 2, 2,
                  {1, 1, 1, 0});
    require_dense(read(kReal + "0 0 0\n"), 0, 0, {});
}

TEST_CASE("array files run down the columns", "[matrix_market]")
{
    require_dense(read(kArray + "2 3\n1\n2\n3\n4\n5\n6\n"), 2, 3, {1, 3, 5, 2, 4, 6});
    require_dense(read("%%MatrixMarket matrix array real symmetric\n3 3\n1\n2\n3\n4\n5\n6\n"), 3, 3,
                  {1, 2, 3, 2, 4, 5, 3, 5, 6});
    require_dense(read("%%MatrixMarket matrix array integer skew-symmetric\n3 3\n1\n2\n3\n"), 3, 3,
                  {0, -1, -2, 1, 0, -3, 2, 3, 0});
    CHECK(read(kArray + "2 1\n0\n5\n").nonzeros() == 1); // a stored zero of an array is no entry
    require_dense(read("%%MatrixMarket matrix array real skew-symmetric\n0 0\n"), 0, 0, {});
    require_dense(read("%%MatrixMarket matrix array real skew-symmetric\n1 1\n"), 1, 1, {0});
}

TEST_CASE("blanks, tabs, line ends, comments and cases that change nothing", "[matrix_market]")
{
    const SparseMatrix plain = read(kReal + "2 2 2\n1 1 1\n2 2 2\n");
    for (const std::string& text : {
             kReal + "%a comment\n\n  % another\n2 2 2\n% between\n1 1 1\n\n2 2 2\n% behind\n\n",
             kReal + "\t2  2\t2 \n  1\t1 1  \n2 2 2", // no line end at the end
             std::string("%%matrixmarket MATRIX Coordinate REAL General\r\n2 2 2\r\n1 1 1\r\n2 2 2\r\n"),
             kReal + "2 2 2\n2 2 2\n1 1 +1\n",
             kReal + "2 2 2\n1 1 1.\n2 2 20.0E-1\n",
         })
    {
        const SparseMatrix a = read(text);
        CHECK(a.row_start == plain.row_start);
        CHECK(a.column == plain.column);
        CHECK(a.value == plain.value);
    }
    const auto file = parse_matrix_market(kReal + "% two\n%words  here\r\n1 1 1\n1 1 1\n%end", "a.mtx");
    CHECK(file.comment == " two\nwords  here\nend");
}

TEST_CASE("duplicates are summed and explicit zeros stay, both counted", "[matrix_market]")
{
    const auto file = parse_matrix_market(kSymmetric + "2 2 4\n1 1 1\n2 1 5\n1 1 2\n2 2 0\n", "a.mtx");
    require_dense(file.matrix, 2, 2, {3, 5, 5, 0});
    CHECK(file.matrix.nonzeros() == 4);
    CHECK(file.notes.duplicates == 1);
    CHECK(file.notes.first_duplicate.row == 0);
    CHECK(file.notes.explicit_zeros == 1);
    CHECK(contains(refusal(kReal + "1 1 2\n1 1 1e308\n1 1 1e308\n"),
                   "row 1, column 1 (counted from 1) add up"));
}

TEST_CASE("banners that are not supported are refused in words", "[matrix_market]")
{
    const auto banner = [](const std::string& words) {
        return refusal("%%MatrixMarket " + words + "\n1 1 1\n1 1 1\n");
    };
    CHECK(banner("matrix coordinate real general").empty());
    CHECK(contains(banner("matrix coordinate complex general"), "complex matrices are not supported"));
    CHECK(contains(banner("matrix array complex hermitian"), "complex matrices are not supported"));
    CHECK(contains(banner("matrix coordinate real hermitian"), "hermitian matrices are not supported"));
    CHECK(contains(banner("vector coordinate real general"), "the object is \"vector\""));
    CHECK(contains(banner("matrix sparse real general"), "must be coordinate or array"));
    CHECK(contains(banner("matrix coordinate boolean general"), "must be real, integer or pattern"));
    CHECK(contains(banner("matrix coordinate real upper"), "must be general, symmetric or skew-symmetric"));
    CHECK(contains(banner("matrix coordinate real"), "the symmetry is nothing"));
    CHECK(contains(banner("matrix coordinate real general twice"), "\"twice\" stands behind the banner"));
    CHECK(contains(banner("matrix array pattern general"), "an array of pattern has no values"));
    CHECK(contains(banner("matrix coordinate pattern skew-symmetric"), "a pattern has no signs"));
    const std::string hint = "begins with \"%%MatrixMarket";
    for (const std::string& text :
         {std::string(), std::string("\n"), std::string("1 1 1\n1 1 1\n"),
          std::string("%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n"), "\xef\xbb\xbf" + kReal,
          std::string("\0\1\2\xff\xfe junk", 10)})
        CHECK(contains(refusal(text), hint));
}

TEST_CASE("counts that lie are refused before memory is asked for", "[matrix_market]")
{
    const std::string entries = "\n1 1 1\n2 2 2\n";
    CHECK(contains(refusal(kReal + "2 2 3" + entries), "only 13 bytes follow"));
    CHECK(contains(refusal(kReal + "2 2 3\n1 1 1.000000\n2 2 2\n"), "ends after 2 of the 3 entries"));
    CHECK(contains(refusal(kReal + "2 2 1" + entries),
                   "line 4: \"2\" stands behind the last of the 1 entry that"));
    CHECK(contains(refusal(kReal + "2 2 -2" + entries), "entries is \"-2\"; it must be a whole number"));
    CHECK(contains(refusal(kReal + "-2 2 2" + entries), "rows is \"-2\""));
    CHECK(contains(refusal(kReal + "2 2.0 2" + entries), "columns is \"2.0\""));
    CHECK(contains(refusal(kReal + "2 2 18446744073709551616" + entries), "at most 4294967294"));
    CHECK(contains(refusal(kReal + "2 2 18446744073709551615" + entries), "at most 4294967294"));
    CHECK(contains(refusal(kReal + "2 2 4294967294" + entries), "promises 4294967294 entries"));
    CHECK(contains(refusal(kReal + "4294967296 2 2" + entries), "at most 4294967294"));
    CHECK(contains(refusal(kReal + "4294967294 4294967294 2" + entries), "nearly all of it would be empty"));
    CHECK(contains(refusal(kReal + "2 2" + entries), "entries is nothing"));
    CHECK(contains(refusal(kReal + "2 2 2 2" + entries), "\"2\" stands behind the size line"));
    CHECK(contains(refusal(kReal), "ends before the size line, rows columns entries"));
    CHECK(contains(refusal(kReal + "% only\n% comments\n"), "ends before the size line"));
    CHECK(contains(refusal(kArray), "ends before the size line, rows columns"));
    CHECK(contains(refusal(kArray + "2 2 4\n1\n2\n3\n4\n"), "\"4\" stands behind the size line"));
    CHECK(contains(refusal(kArray + "4294967294 4294967294\n1\n"), "promises 18446744056529682436 entries"));
    CHECK(contains(refusal(kArray + "4294967294 0\n"), "nearly all of it would be empty"));
    CHECK(contains(refusal(kArray + "2 2\n1\n2\n"), "promises 4 entries"));
    CHECK(contains(refusal(kArray + "2 2\n1\n2.000\n3\n"), "ends after 3 of the 4 entries"));
    CHECK(contains(refusal(kArray + "2 1\n1\n2\n3\n"), "\"3\" stands behind the last of the 2"));
}

TEST_CASE("shapes and triangles that contradict the symmetry", "[matrix_market]")
{
    CHECK(contains(refusal(kSymmetric + "2 3 1\n1 1 1\n"), "is square, but this one is said to be 2 x 3"));
    const std::string above = refusal(kSymmetric + "3 3 2\n1 1 1\n2 3 5\n");
    CHECK(contains(above, "line 4: entry (2, 3) lies above the diagonal"));
    CHECK(contains(above, "row >= column"));
    const std::string skew = "%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n";
    CHECK(contains(refusal(skew + "2 2 0\n"), "lies on the diagonal"));
    CHECK(contains(refusal(skew + "1 2 1\n"), "lies above the diagonal"));
}

TEST_CASE("indices out of range", "[matrix_market]")
{
    const auto entry = [](const std::string& line) { return refusal(kReal + "3 4 1\n" + line + "\n"); };
    CHECK(entry("3 4 1").empty());
    CHECK(contains(entry("0 1 1"), "line 3: the row is \"0\"; it must be a whole number from 1 to 3"));
    CHECK(contains(entry("4 1 1"), "the row is \"4\""));
    CHECK(contains(entry("1 5 1"), "the column is \"5\"; it must be a whole number from 1 to 4"));
    CHECK(contains(entry("-1 1 1"), "the row is \"-1\""));
    CHECK(contains(entry("4294967297 1 1"), "the row is \"4294967297\"")); // 1 in 32 bits
    CHECK(contains(entry("99999999999999999999999 1 1"), "the row is"));
    CHECK(contains(entry("1.0 1 1"), "the row is \"1.0\""));
    CHECK(contains(entry("1, 1 1"), "the row is \"1,\""));
    CHECK(contains(entry("1 1e0 1"), "the column is \"1e0\""));
    CHECK(contains(refusal(kReal + "0 0 1\n1 1 1\n"), "from 1 to 0"));
}

TEST_CASE("values that are no finite decimal numbers", "[matrix_market]")
{
    const auto value = [](const std::string& word) { return refusal(kReal + "1 1 1\n1 1 " + word + "\n"); };
    for (const char* word : {"nan", "NaN", "inf", "-inf", "Infinity"})
        CHECK(contains(value(word), "it must be finite"));
    for (const char* word : {"1e400", "-1e400", "1e999999999999"})
        CHECK(contains(value(word), "within the range of double"));
    for (const char* word : {"0x1p3", "1d5", "1,5", "abc", "1e", "--1", "1+2i", "$", "++1"})
        CHECK(contains(value(word), "it must be a decimal number"));
    CHECK(contains(value("+-1"), "a number of one sign"));
    CHECK(contains(value(""), "the value is nothing"));
    CHECK(contains(value("1 2"), "\"2\" stands behind the entry"));
    CHECK(contains(refusal("%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1 7\n"),
                   "behind the entry"));
    CHECK(contains(refusal(kArray + "1 1\n1 2\n"), "behind the entry"));
    const std::string integer = "%%MatrixMarket matrix coordinate integer general\n1 1 1\n1 1 ";
    for (const char* word : {"1.5", "1e3", "99999999999999999999", "x"})
        CHECK(contains(refusal(integer + word + "\n"), "it must be a whole number"));
    CHECK(contains(refusal(kReal + "1 1 1\n1 1 \x01\xff\n"), "\"\?\?\""));
}

TEST_CASE("numbers at the ends of the range", "[matrix_market]")
{
    const auto value = [](const std::string& word) {
        return read(kReal + "1 1 1\n1 1 " + word + "\n").value.at(0);
    };
    CHECK(value("1.7976931348623157e308") == std::numeric_limits<double>::max());
    CHECK(value("4.9406564584124654e-324") == std::numeric_limits<double>::denorm_min());
    CHECK(value("1e-310") == 1e-310);
    CHECK(value("1e-400") == 0);
    CHECK(value("-1e-400") == 0);
    CHECK(value("0.1") == 0.1);
}

TEST_CASE("what is written reads back, whole", "[matrix_market]")
{
    const Temporary folder;
    const std::string path = (folder.path / "x.mtx").string();
    const std::vector<double> x = {1.0 / 3, -0.0, 5e-324, 1.7976931348623157e308, -12345.678, 0};
    write_vector(path, x, "solved\nby hand");
    CHECK(read_vector(path) == x);
    CHECK(read_matrix_market(path).comment == " solved\n by hand");
    const SparseMatrix a = poisson2d(5);
    write_matrix_market(path, a); // over the old file
    const SparseMatrix again = read_matrix_market(path).matrix;
    CHECK(again.row_start == a.row_start);
    CHECK(again.column == a.column);
    CHECK(again.value == a.value);
    write_vector(path, {});
    CHECK(read_vector(path).empty());
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path), {}) ==
          1); // nothing temporary is left
}

TEST_CASE("a vector is one column; what is not finite is not written", "[matrix_market]")
{
    const Temporary folder;
    const auto failure = [](const std::function<void()>& call, ErrorCode code) {
        try
        {
            call();
        }
        catch (const Error& error)
        {
            CHECK(error.code() == code);
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string row = folder.write("row.mtx", kArray + "1 2\n1\n2\n").string();
    CHECK(contains(failure([&] { read_vector(row); }, ErrorCode::bad_input), "is 1 x 2: transpose it"));
    const std::string sparse = folder.write("sparse.mtx", kReal + "3 1 1\n2 1 5\n").string();
    CHECK(read_vector(sparse) == std::vector<double>{0, 5, 0});
    const std::vector<double> bad = {1, std::numeric_limits<double>::quiet_NaN()};
    const std::string out = (folder.path / "out.mtx").string();
    CHECK(
        contains(failure([&] { write_vector(out, bad); }, ErrorCode::bad_input), "value 1 (counted from 0)"));
    CHECK_FALSE(std::filesystem::exists(out));
    const std::string nowhere = (folder.path / "no" / "x.mtx").string();
    CHECK_FALSE(failure([&] { write_vector(nowhere, {}); }, ErrorCode::io).empty());
    CHECK(contains(failure([&] { read_matrix_market(nowhere); }, ErrorCode::io), "there is no such file"));
    CHECK(contains(failure([&] { read_matrix_market(folder.path.string()); }, ErrorCode::io),
                   "not a regular file"));
}
