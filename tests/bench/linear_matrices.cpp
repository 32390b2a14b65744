#include "linear_matrices.hpp"

#include "support/plan_matrix.hpp"
#include "support/random.hpp"

#include <algorithm>
#include <cmath>

namespace bench {

using namespace taut::linear;
using taut::conformance::Random;

namespace {

// Multiples of three, for bcsr3, and far from powers of two: columns of ell that lie a power of two apart
// share the same lines of the cache.
constexpr std::uint32_t kSides[] = {150, 600, 2250};
constexpr std::uint32_t kSpreadRows = 6000;
constexpr double kMean = 16; ///< entries a row where their spread is asked
constexpr int kSteps = 10;   ///< of the simulator before its matrix is taken

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Off-diagonal entries at the pairs (i, j), i < j, each once; diagonals exceed the sum of their row by 1 %.
SparseMatrix symmetric(std::uint32_t rows, const Pairs& pairs)
{
    Random random(4);
    std::vector<double> sum(rows, 0);
    std::vector<Triplet> entries;
    for (const auto& [i, j] : pairs)
    {
        const double value = random.uniform(0.1, 1.1);
        sum[i] += value;
        sum[j] += value;
        entries.push_back({i, j, -value});
        entries.push_back({j, i, -value});
    }
    for (std::uint32_t i = 0; i < rows; ++i)
        entries.push_back({i, i, 1.01 * sum[i]});
    return from_triplets(rows, rows, entries);
}

/// The nearest `length` places of every row; an odd number.
SparseMatrix band(std::uint32_t rows, std::uint32_t length)
{
    Pairs pairs;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = i + 1; j < std::min(rows, i + (length + 1) / 2); ++j)
            pairs.emplace_back(i, j);
    return symmetric(rows, pairs);
}

/// About kMean entries in a row at random places; in row i in proportion to length(i, random) plus the
/// diagonal.
template <typename Length>
SparseMatrix scattered(Length&& length)
{
    Random random(5);
    std::vector<double> upto = {0};
    for (std::uint32_t row = 0; row < kSpreadRows; ++row)
        upto.push_back(upto.back() + length(row, random));
    const auto pick = [&] {
        const auto at = std::upper_bound(upto.begin() + 1, upto.end() - 1, random.uniform(0, upto.back()));
        return static_cast<std::uint32_t>(at - upto.begin() - 1);
    };
    Pairs pairs;
    for (std::uint32_t i = 0; i + 1 < kSpreadRows; ++i) // no row is empty
        pairs.emplace_back(i, i + 1);
    for (double drawn = 0; drawn < (kMean - 3) * kSpreadRows / 2; ++drawn)
        if (const std::uint32_t i = pick(), j = pick(); i != j)
            pairs.emplace_back(std::min(i, j), std::max(i, j));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return symmetric(kSpreadRows, pairs);
}

taut::Scene stepped(const char* method, taut::Body body, taut::Pin pin)
{
    taut::Scene scene;
    scene.timestep = 1.0 / 60;
    scene.method.type = taut::option_named<taut::MethodKind>(method);
    scene.method.substeps = 1;
    scene.method.precision = taut::Precision::float64;
    body.pins = {std::move(pin)};
    scene.bodies = {std::move(body)};
    return resolve(scene);
}

/// A square metre of cloth of n x n cells, held at two corners.
SparseMatrix cloth(const char* method, std::uint32_t n)
{
    taut::Body body;
    body.shape.cells = {n, n};
    taut::Pin pin;
    pin.corners = {"top_left", "top_right"};
    return taut::test::matrix_of(stepped(method, body, pin), kSteps);
}

/// A cube of a metre, n x n x n cells of tetrahedra, sagging on its bottom.
SparseMatrix solid(std::uint32_t n)
{
    taut::Body body;
    body.shape.kind = taut::ShapeKind::box;
    body.shape.box_cells = {n, n, n};
    body.material = taut::solid_material();
    taut::Pin pin;
    pin.faces = {"bottom"};
    return taut::test::matrix_of(stepped("implicit_euler", body, pin), kSteps);
}

void add_spreads(std::vector<NamedMatrix>& out)
{
    out.push_back({"scattered, alike", [] { return scattered([](std::uint32_t, Random&) { return 1.0; }); }});
    out.push_back(
        {"scattered, memoryless",
         [] { return scattered([](std::uint32_t, Random& r) { return -std::log(1 - r.uniform(0, 1)); }); }});
    out.push_back({"scattered, one row in 64 long", [] {
                       return scattered([](std::uint32_t row, Random&) { return row % 64 ? 0.76 : 16; });
                   }});
    out.push_back({"scattered, power law", [] { // exponent 2.5
                       return scattered(
                           [](std::uint32_t, Random& r) { return std::pow(1 - r.uniform(0, 1), -2.0 / 3); });
                   }});
}

} // namespace

std::vector<NamedMatrix> crossover_matrices()
{
    std::vector<NamedMatrix> out;
    for (const std::uint32_t rows : kSides)
        for (const std::uint32_t length : {3u, 9u, 33u, 129u, 257u, 513u, 2 * rows})
            if (length < rows || length == 2 * rows)
                out.push_back(
                    {"band of " + std::to_string(std::min(length, rows)) + " in " + std::to_string(rows),
                     [rows, length] { return band(rows, length); }});
    add_spreads(out);
    for (const std::uint32_t n : {8u, 24u, 64u})
        out.push_back(
            {"M + h²K cloth " + std::to_string(n) + "²", [n] { return cloth("implicit_euler", n); }});
    for (const std::uint32_t n : {4u, 8u, 12u})
        out.push_back({"M + h²K solid " + std::to_string(n) + "³", [n] { return solid(n); }});
    for (const std::uint32_t n : {8u, 24u, 64u})
        out.push_back({"J W Jᵀ + c/h² cloth " + std::to_string(n) + "²",
                       [n] { return cloth("implicit_constraints", n); }});
    return out;
}

} // namespace bench
