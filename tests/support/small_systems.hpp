#pragma once
// Small systems of every kind, solved in batches.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/random.hpp"
#include "taut/linear/device_matrix.hpp"
#include "taut/linear/matrix_market.hpp"
#include "taut/linear/small.hpp"
#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>

namespace taut::linear::small_systems {

struct System
{
    SparseMatrix a;
    std::vector<double> b, inverse;
    std::vector<double> x0 = std::vector<double>(b.size(), 0.0);
};

inline double as_float(double v) { return static_cast<double>(static_cast<float>(v)); }

inline System with_jacobi(SparseMatrix a, std::vector<double> b)
{
    std::vector<double> inverse = jacobi_inverse(a);
    return {std::move(a), std::move(b), std::move(inverse)};
}

/// Banded, so that LDLT is quick; numbers that float holds, so that every precision solves the same system.
inline System random_system(conformance::Random& random, std::uint32_t n)
{
    std::vector<Triplet> entries;
    std::vector<double> diagonal(n, 0.05), b;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = i + 1; j < std::min(n, i + 7); ++j)
        {
            if (!random.chance(0.4))
                continue;
            const double v = as_float(random.uniform(-1, 1));
            entries.insert(entries.end(), {{i, j, v}, {j, i, v}});
            diagonal[i] += std::abs(v);
            diagonal[j] += std::abs(v);
        }
    for (std::uint32_t i = 0; i < n; ++i)
    {
        entries.push_back({i, i, as_float(diagonal[i] * random.uniform(1, 1.5))});
        b.push_back(as_float(random.uniform(-1, 1)));
    }
    return with_jacobi(from_triplets(n, n, entries), b);
}

/// 2 and -1; with free ends the first and the last diagonal are 1, and constants are mapped to zero.
inline SparseMatrix chain(std::uint32_t n, bool free_ends, double sign = 1)
{
    std::vector<Triplet> entries;
    for (std::uint32_t i = 0; i < n; ++i)
    {
        const bool end = i == 0 || i + 1 == n;
        entries.push_back({i, i, sign * (free_ends && end ? 1 : 2)});
        if (i + 1 < n)
            entries.insert(entries.end(), {{i, i + 1, -sign}, {i + 1, i, -sign}});
    }
    return from_triplets(n, n, entries);
}

/// A full matrix: the longest loops there are.
inline SparseMatrix covariance(std::uint32_t n)
{
    std::vector<double> values;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j)
            values.push_back(std::exp(-std::abs(double(i) - double(j)) / 20) + (i == j ? 0.01 : 0));
    return from_dense(n, n, values);
}

inline std::vector<double> solve_exactly(const System& s)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Triplet& t : to_triplets(s.a))
        entries.emplace_back(int(t.row), int(t.column), t.value);
    Eigen::SparseMatrix<double> a(s.a.rows, s.a.columns);
    a.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd x = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(a).solve(
        Eigen::Map<const Eigen::VectorXd>(s.b.data(), Eigen::Index(s.b.size())));
    return {x.begin(), x.end()};
}

struct Mode
{
    Precision precision = Precision::float64;
    bool pairs = false;
};
inline constexpr Mode kFloat{Precision::float32, false};
inline constexpr Mode kDouble{Precision::float64, false};
inline constexpr Mode kPairs{Precision::float32, true};

struct Answer
{
    CgOutcome outcome;
    std::vector<double> x, checked;
    std::vector<float> history;
};

struct Solved
{
    std::uint32_t dispatches = 0;
    std::vector<std::uint32_t> turns;
    std::vector<Answer> answers;
};

inline std::unique_ptr<SmallBatch> make_batch(const std::string& selector, const std::vector<System>& systems,
                                              Mode mode)
{
    std::vector<SparseMatrix> matrices;
    std::vector<std::vector<double>> inverses;
    for (const System& s : systems)
    {
        matrices.push_back(s.a);
        inverses.push_back(s.inverse);
    }
    const std::vector<int> exponents(systems.size(), 0);
    return std::make_unique<SmallBatch>(test_device(selector), matrices, exponents, inverses, mode.precision,
                                        mode.pairs);
}

inline Solved run(SmallBatch& batch, const std::vector<System>& systems, const CgSettings& settings)
{
    std::vector<double> b, x0;
    for (const System& s : systems)
    {
        b.insert(b.end(), s.b.begin(), s.b.end());
        x0.insert(x0.end(), s.x0.begin(), s.x0.end());
    }
    batch.set(settings);
    batch.start(b, x0);
    Solved out;
    out.dispatches = batch.run();
    for (std::size_t k = 0; k < systems.size(); ++k)
    {
        out.turns.push_back(batch.turns(k));
        out.answers.push_back({batch.outcome(k), batch.x(k), batch.checked_x(k), batch.history(k)});
    }
    return out;
}

inline Solved solve_all(const std::string& selector, const std::vector<System>& systems, Mode mode,
                        const CgSettings& settings)
{
    return run(*make_batch(selector, systems, mode), systems, settings);
}

inline CgSettings tolerance(double value)
{
    CgSettings settings;
    settings.tolerance = value;
    return settings;
}

inline bool can(const std::string& selector, Mode mode)
{
    return mode.precision == Precision::float32 || test_device(selector)->limits().float64;
}

/// Bit for bit, NaN too.
template <typename T>
bool same(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline bool same(const Answer& a, const Answer& b)
{
    return a.outcome.cause == b.outcome.cause && a.outcome.iterations == b.outcome.iterations &&
           a.outcome.replacements == b.outcome.replacements && same(a.x, b.x) && same(a.checked, b.checked) &&
           same(a.history, b.history);
}

inline double difference(const std::vector<double>& a, const std::vector<double>& b)
{
    std::vector<double> d = a;
    for (std::size_t i = 0; i < d.size(); ++i)
        d[i] -= b[i];
    return norm(d) / norm(b);
}

struct RandomSystems
{
    std::vector<System> systems;
    std::vector<std::vector<double>> exact;

    explicit RandomSystems(std::uint32_t count)
    {
        conformance::Random random(31);
        for (std::uint32_t k = 0; k < count; ++k)
        {
            const std::uint32_t edges[] = {1, 2, 127, 128, 129, 1023, 1024};
            systems.push_back(random_system(random, k < 7 ? edges[k] : 1 + random.below(1024)));
            exact.push_back(solve_exactly(systems.back()));
        }
    }
};

/// Systems of every end there is, which 60 iterations bring about.
struct Ends
{
    std::vector<System> systems;
    std::vector<Status> status; ///< what it must be

    void add(System s, Status end)
    {
        systems.push_back(std::move(s));
        status.push_back(end);
    }

    Ends()
    {
        conformance::Random random(32);
        const double nan = std::numeric_limits<double>::quiet_NaN();
        add(random_system(random, 30), Status::converged);
        add({chain(20, false), std::vector<double>(20, 0.0), std::vector<double>(20, 0.5)},
            Status::zero_right_hand_side);
        add(random_system(random, 200), Status::converged);
        add({chain(140, false, -1), std::vector<double>(140, 1.0), std::vector<double>(140, 0.5)},
            Status::indefinite_matrix);
        System poisoned = random_system(random, 129);
        poisoned.b[100] = nan;
        add(poisoned, Status::non_finite);
        add(with_jacobi(chain(500, false), std::vector<double>(500, 1.0)), Status::iteration_limit);
        add({chain(64, true), std::vector<double>(64, 1.0), std::vector<double>(64, 1.0)}, Status::stagnated);
        System turned = random_system(random, 40);
        for (double& m : turned.inverse)
            m = -m; // every row is held: nothing is left to solve
        add(turned, Status::zero_right_hand_side);
        add(random_system(random, 1), Status::converged);
        System spoilt = random_system(random, 33);
        spoilt.x0[7] = nan;
        add(spoilt, Status::non_finite);
        add(random_system(random, 1024), Status::converged);
    }
};

} // namespace taut::linear::small_systems
