// Real Matrix Market files with Eigen's reader as a second opinion, and thousands of damaged ones.

#include "../scene/mutate.hpp"

#include "taut/linear/matrix_market.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/file_text.hpp"

#include "support/skip.hpp"
#include "support/data.hpp"
#include "support/sound_matrix.hpp"

#include <Eigen/SparseCore>
#include <unsupported/Eigen/SparseExtra>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

using namespace taut;
using namespace taut::linear;

namespace {

std::vector<std::filesystem::path> matrix_files()
{
    const std::filesystem::path root = data_folder();
    std::vector<std::filesystem::path> files;
    std::error_code missing;
    for (const auto& entry : std::filesystem::directory_iterator(root / "matrices", missing))
        if (entry.path().extension() == ".mtx")
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    if (files.empty())
        TAUT_LEFT_OUT("no matrices under " << root.string()
                                           << "; set TAUT_DATA to the folder of shared data");
    return files;
}

using EigenRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Eigen does not expand symmetric files.
EigenRows expanded(const EigenRows& triangle)
{
    std::vector<Eigen::Triplet<double>> list;
    for (int i = 0; i < triangle.outerSize(); ++i)
        for (EigenRows::InnerIterator entry(triangle, i); entry; ++entry)
        {
            list.emplace_back(entry.row(), entry.col(), entry.value());
            if (entry.row() != entry.col())
                list.emplace_back(entry.col(), entry.row(), entry.value());
        }
    EigenRows whole(triangle.rows(), triangle.cols());
    whole.setFromTriplets(list.begin(), list.end());
    return whole;
}

/// Files of every kind, small, to damage.
const std::vector<std::string>& seeds()
{
    static const std::vector<std::string> texts = {
        "%%MatrixMarket matrix coordinate real general\n% c\n3 4 4\n1 1 1.5\n3 4 -2e-3\n2 2 7\n1 3 .5\n",
        "%%MatrixMarket matrix coordinate real symmetric\r\n3 3 4\r\n1 1 4\r\n2 2 4\r\n3 1 -1\r\n3 3 "
        "1e300\r\n",
        "%%MatrixMarket matrix coordinate integer skew-symmetric\n4 4 2\n2 1 7\n4 3 -9\n",
        "%%MatrixMarket matrix coordinate pattern symmetric\n3 3 3\n1 1\n2 1\n3 3\n",
        "%%MatrixMarket matrix array real general\n2 3\n1\n2\n3e5\n4\n5\n6\n",
        "%%MatrixMarket matrix array real symmetric\n\n2 2\n1e-400\n2\n+3\n",
    };
    return texts;
}

/// True where the damaged text still is a file.
bool read_damaged(const std::string& text)
{
    try
    {
        require_sound(parse_matrix_market(text, "damaged").matrix);
        return true;
    }
    catch (const Error& error)
    {
        if (error.code() != ErrorCode::bad_input || !std::string(error.what()).starts_with("damaged: line "))
            throw std::logic_error(std::string("a refusal without file and line: ") + error.what());
        return false;
    }
}

} // namespace

TEST_CASE("real files read as Eigen reads them", "[matrix_market]")
{
    for (const auto& path : matrix_files())
    {
        CAPTURE(path.filename().string());
        const MatrixFile file = read_matrix_market(path.string());
        const SparseMatrix& a = file.matrix;
        EigenRows e;
        REQUIRE(Eigen::loadMarket(e, path.string()));
        if (file.stored_symmetric)
            e = expanded(e);
        CHECK(file.notes.duplicates == 0);
        REQUIRE(a.rows == e.rows());
        REQUIRE(a.columns == e.cols());
        REQUIRE(a.nonzeros() == std::uint64_t(e.nonZeros()));
        CHECK(std::equal(a.row_start.begin(), a.row_start.end(), e.outerIndexPtr(),
                         [](std::uint32_t mine, int its) { return mine == std::uint32_t(its); }));
        CHECK(std::equal(a.column.begin(), a.column.end(), e.innerIndexPtr(),
                         [](std::uint32_t mine, int its) { return mine == std::uint32_t(its); }));
        CHECK(std::equal(a.value.begin(), a.value.end(), e.valuePtr())); // bit for bit but for zeros' signs
    }
}

TEST_CASE("what the folder's page says of its matrices", "[matrix_market]")
{
    for (const auto& path : matrix_files())
    {
        const std::string name = path.filename().string();
        const auto check = [&](std::uint32_t n, std::uint64_t entries, std::uint64_t zeros) {
            const MatrixFile file = read_matrix_market(path.string());
            CHECK(file.matrix.rows == n);
            CHECK(file.matrix.nonzeros() == entries);
            CHECK(file.notes.explicit_zeros == zeros);
        };
        if (name == "bcsstk16.mtx")
            check(4884, 290378, 0);
        if (name == "msc01050.mtx")
            check(1050, 29156, 2958);
        if (name == "ani4.mtx")
            check(3081, 20971, 0);
    }
}

TEST_CASE("damaged files end in a sound matrix or in a sentence", "[matrix_market]")
{
    const std::size_t seed_count = seeds().size();
    std::size_t sound = 0;
    for (const std::string& text : seeds())
        REQUIRE(read_damaged(text));
    const std::size_t count = 30000;
    for (std::size_t k = 0; k < count; ++k)
    {
        const std::string text = mutate::damage(seeds()[k % seed_count], k + 1);
        CAPTURE(k, text);
        bool read = false;
        REQUIRE_NOTHROW(read = read_damaged(text));
        sound += read ? 1 : 0;
    }
    CHECK(sound > 500); // both ends are reached
    CHECK(sound < count / 2);
}

TEST_CASE("every prefix of a file ends in a sound matrix or in a sentence", "[matrix_market]")
{
    for (const std::string& text : seeds())
        for (std::size_t length = 0; length < text.size(); ++length)
        {
            const bool last_line = text.find_first_not_of("\r\n", length) == std::string::npos;
            bool read = false;
            REQUIRE_NOTHROW(read = read_damaged(text.substr(0, length)));
            CHECK((!last_line || read)); // only line ends are missing
            if (text.find('\n', length) < text.size() - 1)
                CHECK_FALSE(read); // lines are missing
        }
}
