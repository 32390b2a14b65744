// taut solve: files in, a word, numbers and files out.

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

using program::Folder;
using program::Result;

namespace {

const std::vector<std::string> kKeys = {"status",
                                        "iterations",
                                        "relative_residual",
                                        "recursive_residual",
                                        "forward_error",
                                        "seconds",
                                        "bytes",
                                        "ms_per_iteration",
                                        "spmv_gb_per_s",
                                        "format",
                                        "precision",
                                        "device",
                                        "preconditioner",
                                        "n",
                                        "nnz",
                                        "reason",
                                        "notes",
                                        "format_reason",
                                        "tolerance",
                                        "replacements",
                                        "setup_seconds",
                                        "null_part",
                                        "residual_of_given_b"};

/// The Laplacian of a path: ends held (definite) or free (constants in the null space), lower triangle.
std::string path_matrix(int n, bool free_ends = false)
{
    std::ostringstream text;
    text << "%%MatrixMarket matrix coordinate real symmetric\n" << n << ' ' << n << ' ' << 2 * n - 1 << '\n';
    for (int i = 1; i <= n; ++i)
    {
        text << i << ' ' << i << ' ' << (free_ends && (i == 1 || i == n) ? 1 : 2) << '\n';
        if (i < n)
            text << i + 1 << ' ' << i << " -1\n";
    }
    return text.str();
}

std::string vector(const std::vector<double>& values)
{
    std::ostringstream text;
    text << "%%MatrixMarket matrix array real general\n" << values.size() << " 1\n";
    for (const double v : values)
        text << v << '\n';
    return text.str();
}

/// The values of an array file; what comes before them is checked by the library's own tests.
std::vector<double> values_of(const std::string& file)
{
    std::istringstream text(program::read(file));
    std::string line;
    while (std::getline(text, line) && line[0] == '%')
    {}
    std::vector<double> values;
    for (double v = 0; text >> v;)
        values.push_back(v);
    REQUIRE(line == std::to_string(values.size()) + " 1");
    return values;
}

nlohmann::json solved(const Folder& folder, std::vector<std::string> arguments, int status = 0)
{
    arguments.insert(arguments.begin(), "solve");
    arguments.insert(arguments.end(), {"--json", "--device", "cpu"});
    const Result result = folder.taut(arguments);
    INFO(result.err);
    REQUIRE(result.status == status);
    CHECK(result.err.empty());
    return program::parse(result.out);
}

/// One line "taut: ..." and nothing on standard output.
void check_refused(const Result& result, int status, const std::string& part)
{
    INFO(result.err);
    CHECK(result.status == status);
    CHECK(result.out.empty());
    CHECK(result.err.rfind("taut: ", 0) == 0);
    CHECK(std::count(result.err.begin(), result.err.end(), '\n') == 1);
    CHECK(result.err.find(part) != std::string::npos);
}

} // namespace

TEST_CASE("solve makes a right-hand side from a known x and says how far off it is", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(200));
    const auto json = solved(folder, {matrix, "--tolerance", "1e-10", "--precision", "double"});
    std::set<std::string> keys, wanted(kKeys.begin(), kKeys.end());
    for (const auto& [key, value] : json.items())
        keys.insert(key);
    CHECK(keys == wanted);
    CHECK(json["status"] == "converged");
    CHECK(json["relative_residual"].get<double>() <= 1e-10);
    CHECK(json["forward_error"].get<double>() < 1e-6); // condition 1.6e4
    CHECK(json["forward_error"].get<double>() > 0);
    CHECK(json["iterations"].get<int>() > 90);
    CHECK(json["iterations"].get<int>() <= 400);
    CHECK(json["n"] == 200);
    CHECK(json["nnz"] == 598);
    CHECK(json["device"] == "cpu");
    CHECK(json["precision"] == "double");
    CHECK(json["preconditioner"] == "jacobi");
    CHECK(json["tolerance"] == 1e-10);
    CHECK(json["bytes"].get<int>() > 598 * 8);
    CHECK(json["reason"].get<std::string>().find("within the tolerance") != std::string::npos);
    CHECK(folder.list("").size() == 3); // the matrix and the two captured streams
}

TEST_CASE("solve takes the largest numbers for what they are", "[solve]")
{
    const Folder folder;
    const std::string a = folder.file("a.mtx", "%%MatrixMarket matrix array real general\n1 1\n1e5\n");
    const std::string b = folder.file("b.mtx", vector({1.7e308})); // its square is beyond double
    for (const char* format : {"dense", "coo", "csr", "ell", "sell"})
    {
        const auto json = solved(folder, {a, b, "--format", format, "--out", folder / "x.mtx"});
        CHECK((json["status"] == "converged" && json["format"] == format));
        for (const double x : values_of(folder / "x.mtx"))
            CHECK(x / 1e303 == Approx(1.7));
    }
}

TEST_CASE("solve takes b from a file and writes x and the history, whole", "[solve]")
{
    const Folder folder;
    const int n = 60;
    const std::string matrix = folder.file("a.mtx", path_matrix(n));
    const std::string b = folder.file("b.mtx", vector(std::vector<double>(n, 1.0)));
    const std::string x = folder / "below/x.mtx", history = folder / "history.csv";
    const auto json = solved(folder, {matrix, b, "--tolerance", "1e-9", "--precision", "double", "--out", x,
                                      "--history", history});
    CHECK(json["status"] == "converged");
    CHECK(json["forward_error"].is_null());
    const auto values = values_of(x);
    REQUIRE(values.size() == n);
    for (int i = 1; i <= n; ++i)
        CHECK(values[std::size_t(i - 1)] == Approx(0.5 * i * (n + 1 - i)).epsilon(1e-6));
    CHECK(folder.list("below").size() == 1);

    std::istringstream csv(program::read(history));
    std::string line;
    REQUIRE(std::getline(csv, line));
    CHECK(line == "iteration,relative_residual");
    int count = 0;
    double last = 0;
    for (; std::getline(csv, line); ++count)
    {
        CHECK(line.rfind(std::to_string(count) + ",", 0) == 0);
        last = std::stod(line.substr(line.find(',') + 1));
        if (count == 0)
            CHECK(last == Approx(1));
    }
    CHECK(count >= json["iterations"].get<int>());
    CHECK(last < 1e-8);
}

TEST_CASE("what is solved is written also where b is a file of the first run", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(30)), x = folder / "x.mtx";
    solved(folder, {matrix, "--out", x, "--tolerance", "1e-12", "--precision", "double"});
    const auto again = solved(folder, {matrix, x}); // x is a file of one column
    CHECK(again["status"] == "converged");
    // The documented formula: 2654435761 i modulo 2^32, as a share of 2^31, less 1.
    const auto values = values_of(x);
    for (std::uint32_t i = 0; i < 30; ++i)
        CHECK(std::abs(values[i] - (double(2654435761u * (i + 1)) / 2147483648.0 - 1)) < 1e-8);
}

TEST_CASE("a solve that does not reach the tolerance ends with status 1, its word and its best x", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(400)), x = folder / "x.mtx";
    const auto json = solved(folder, {matrix, "--max-iterations", "20", "--out", x}, 1);
    CHECK(json["status"] == "iteration_limit");
    CHECK(json["iterations"].get<int>() <= 20);
    CHECK(json["relative_residual"].get<double>() > 1e-8);
    CHECK(values_of(x).size() == 400);
    const std::string indefinite =
        folder.file("i.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 3\n2 2 1\n");
    CHECK(solved(folder, {indefinite}, 1)["status"] == "indefinite_matrix");
}

TEST_CASE("a zero right-hand side is solved by zero, with status 0", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(5)), x = folder / "x.mtx";
    const auto json =
        solved(folder, {matrix, folder.file("b.mtx", vector(std::vector<double>(5, 0.0))), "--out", x});
    CHECK(json["status"] == "zero_right_hand_side");
    CHECK(json["iterations"] == 0);
    CHECK(values_of(x) == std::vector<double>(5, 0.0));
    const std::string none =
        folder.file("none.mtx", "%%MatrixMarket matrix coordinate real general\n0 0 0\n");
    CHECK(solved(folder, {none})["status"] == "zero_right_hand_side");
}

TEST_CASE("a singular matrix: constants are taken out, or the system is refused", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(64, true));
    const std::string b = folder.file("b.mtx", vector(std::vector<double>(64, 1.0)));
    check_refused(folder.taut({"solve", matrix, b, "--device", "cpu"}), 2, "null_space: constants");
    std::vector<double> tilted(64, 1.0);
    tilted[3] = 5;
    const std::string c = folder.file("c.mtx", vector(tilted));
    const auto json = solved(folder, {matrix, c, "--null-space", "constants"});
    CHECK(json["status"] == "converged");
    CHECK(json["null_part"].get<double>() > 0.5);
    // Manufactured: the means, which nothing determines, are not compared.
    for (const char* option : {"none", "constants"})
    {
        const auto known = solved(folder, {matrix, "--null-space", option, "--precision", "double"});
        CHECK(known["status"] == "converged");
        CHECK(known["forward_error"].get<double>() < 1e-5);
    }
    check_refused(folder.taut({"solve", folder.file("d.mtx", path_matrix(9)), "--null-space", "constants"}),
                  2, "d.mtx");
}

TEST_CASE("every format, precision and preconditioner word is taken", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(90));
    for (const char* format : {"auto", "dense", "coo", "csr", "ell", "sell", "bcsr3"})
    {
        const auto json = solved(folder, {matrix, "--format", format});
        CHECK(json["status"] == "converged");
        CHECK((json["format"] == format || std::string(format) == "auto"));
        CHECK_FALSE(json["format_reason"].get<std::string>().empty());
    }
    for (const char* precision : {"auto", "double", "mixed"})
        CHECK(solved(folder, {matrix, "--precision", precision})["relative_residual"].get<double>() <= 1e-8);
    CHECK(solved(folder, {matrix, "--precision", "float", "--tolerance", "1e-4"})["precision"] == "float");
    for (const char* preconditioner : {"none", "jacobi", "block_jacobi", "chebyshev", "multigrid", "spai0"})
    {
        const auto json = solved(folder, {matrix, "--preconditioner", preconditioner});
        CHECK(json["status"] == "converged");
        CHECK(json["preconditioner"] == preconditioner);
    }
}

TEST_CASE("people read the word, the error beside the time, and what the file held", "[solve]")
{
    const Folder folder;
    const std::string matrix =
        folder.file("a.mtx", "%%MatrixMarket matrix coordinate real general\n2 2 5\n1 1 2\n"
                             "2 2 3\n1 1 2\n1 2 0\n2 1 0\n");
    const Result result = folder.taut({"solve", matrix, "--device", "cpu:serial"});
    INFO(result.out);
    CHECK(result.status == 0);
    CHECK(result.err.empty());
    for (const char* part :
         {"converged: ", "true residual", "forward error", " ms for ", "2 unknowns", "cpu:serial",
          "1 entry was added to an earlier one of the same place, first at row 1, column 1",
          "2 stored entries are zero"})
        CHECK(result.out.find(part) != std::string::npos);
}

TEST_CASE("solve refuses wrong arguments and wrong files with one sentence", "[solve]")
{
    const Folder folder;
    const std::string good = folder.file("a.mtx", path_matrix(4));
    const auto refused = [&](const std::vector<std::string>& arguments, int status, const std::string& part) {
        std::vector<std::string> all = {"solve"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        check_refused(folder.taut(all), status, part);
    };
    refused({}, 2, "matrix");
    refused({good, "--format", "diagonal"}, 2, "diagonal");
    refused({good, "--precision", "half"}, 2, "half");
    refused({good, "--preconditioner", "ilu"}, 2, "ilu");
    refused({good, "--null-space", "all"}, 2, "all");
    for (const std::string tolerance : {"0", "1", "-1e-8", "nan", "2", "small", "1e-8x", ""})
    {
        refused({good, "--tolerance", tolerance}, 2, "--tolerance is \"" + tolerance + "\"");
        refused({good, "--tolerance", tolerance}, 2, "a number between 0 and 1");
    }
    for (const std::string limit : {"-1", "0", "2.5", "many", "4294967296"})
    {
        refused({good, "--max-iterations", limit}, 2, "--max-iterations is \"" + limit + "\"");
        refused({good, "--max-iterations", limit}, 2, "a whole number, 1 or more");
    }
    for (const char* degree : {"0", "17", "-2", "four"})
        refused({good, "--chebyshev-degree", degree}, 2, "a whole number from 1 to 16");
    refused({good, "--bogus"}, 2, "(taut solve --help lists its options)");
    refused({good, "--device", "abacus"}, 3, "abacus");
    refused({folder / "none.mtx"}, 2, "none.mtx");
    refused({folder.path()}, 2, "not a regular file");
    refused({good, folder / "none.mtx"}, 2, "none.mtx");
    refused({good, good}, 2, "one column");
    refused({good, folder.file("short.mtx", vector({1, 2, 3}))}, 2, "b has 3 entries");
    refused({folder.file("junk.mtx", "hello\n")}, 2, "junk.mtx: line 1");
    refused({folder.file("cut.mtx", path_matrix(9).substr(0, 70))}, 2, "cut.mtx: line");
    const std::string head = "%%MatrixMarket matrix coordinate real general\n";
    refused({folder.file("wide.mtx", head + "1 2 1\n1 1 1\n")}, 2, "wide.mtx: the matrix is 1 x 2");
    refused({folder.file("skew.mtx", head + "2 2 3\n1 1 1\n2 2 1\n1 2 0.5\n")}, 2,
            "skew.mtx: the matrix is not symmetric");
    refused({folder.file("minus.mtx", head + "1 1 1\n1 1 -1\n")}, 2, "is negative");
    refused({folder.file("block.mtx", path_matrix(4)), "--preconditioner", "block_jacobi"}, 2,
            "multiple of 3");
    refused({good, "--out", good}, 2, "which is an input");
    refused({good, "--history", folder.path()}, 2, "name a file");
    CHECK(program::read(good) == path_matrix(4));
}

TEST_CASE("the degree of the polynomial changes the solve", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(900));
    const auto iterations = [&](const char* degree) {
        const auto json =
            solved(folder, {matrix, "--preconditioner", "chebyshev", "--chebyshev-degree", degree});
        CHECK(json["status"] == "converged");
        return json["iterations"].get<int>();
    };
    CHECK(iterations("16") < iterations("1"));
    const auto usual = solved(folder, {matrix, "--preconditioner", "chebyshev"});
    CHECK(usual["iterations"] == iterations("4"));
}

TEST_CASE("a small system is solved by the large solver on demand", "[solve]")
{
    const Folder folder;
    const std::string matrix = folder.file("a.mtx", path_matrix(100));
    const auto small = solved(folder, {matrix}), large = solved(folder, {matrix, "--no-one-group"});
    for (const auto& json : {small, large})
        CHECK(json["status"] == "converged");
    CHECK(small["format_reason"].get<std::string>().find("one work group") != std::string::npos);
    CHECK(large["format_reason"].get<std::string>().find("one work group") == std::string::npos);
    CHECK(small["spmv_gb_per_s"].is_null()); // docs/program.md
    CHECK(large["spmv_gb_per_s"].get<double>() > 0);
}

TEST_CASE("solve refuses to write one file over another before it solves", "[solve]")
{
    const Folder folder;
    const std::string text = path_matrix(4), matrix = folder.file("a.mtx", text);
    const std::string column = vector({1, 2, 3, 4}), b = folder.file("b.mtx", column);
    const std::string there = folder.file("there.csv", "old");
    const auto refused = [&](const std::vector<std::string>& more, const std::string& part) {
        std::vector<std::string> all = {"solve", matrix, b};
        all.insert(all.end(), more.begin(), more.end());
        check_refused(folder.taut(all), 2, part);
    };
    const std::string detour = folder / "below/../new.csv";
    for (const auto& [out, history] : {std::pair<std::string, std::string>{folder / "new.csv", detour},
                                       {there, there},
                                       {"new.csv", folder / "new.csv"}, // run in the folder
                                       {"./there.csv", there}})
        refused({"--out", out, "--history", history}, "--out and --history both name");
    for (const char* option : {"--out", "--history"})
    {
        refused({option, matrix}, std::string(option) + " names " + matrix + ", which is an input");
        refused({option, b}, "which is an input");
        refused({option, "./b.mtx"}, "which is an input");
    }
    CHECK(program::read(matrix) == text);
    CHECK(program::read(b) == column);
    CHECK(program::read(there) == "old");
    CHECK(folder.list("").size() == 5); // three files and the two captured streams
}

TEST_CASE("a folder that takes no file is refused before it is solved", "[solve]")
{
    const Folder folder;
    // Were it solved first, the negative diagonal would be what is found.
    const std::string wrong =
        folder.file("a.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 -1\n");
    for (const char* option : {"--out", "--history"})
        check_refused(folder.taut({"solve", wrong, option, "/proc/x.mtx"}), 2, "cannot write /proc/x.mtx");
    check_refused(folder.taut({"solve", wrong, "--history", wrong + "/x.csv"}), 2, "with --history");
    CHECK(folder.list("").size() == 3);
}

TEST_CASE("a file that cannot be written leaves none", "[solve]")
{
    const Folder folder;
    const std::string good = folder.file("a.mtx", path_matrix(4)), file = folder.file("file", "text");
    check_refused(folder.taut({"solve", good, "--out", file + "/x.mtx"}), 2, "file");
    CHECK(program::read(file) == "text");
}
