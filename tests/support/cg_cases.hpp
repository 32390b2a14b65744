#pragma once
// What the tests of kernels/linear/cg_*.comp share: a state in the middle of a solve, preconditioners with
// held rows, and their product with a residual in fp64.

#include "support/linear_groups.hpp"

namespace taut::conformance {

template <typename Real>
using CgState = layout::CgState<Real>;

/// Twelve iterations in; nothing is wrong.
template <typename Real>
CgState<Real> middle_of_solve()
{
    CgState<Real> s{};
    s.tolerance_squared = Real(0x1p-40);
    s.replacement_squared = Real(0x1p-14);
    s.growth_squared = Real(0x1p40);
    s.epsilon = Real(sizeof(Real) == 8 ? 0x1p-53 : 0x1p-24);
    s.bb = Real(4);
    s.rz = Real(2);
    s.rr = Real(1);
    s.step = Real(0.375);
    s.pmp = Real(3);
    s.steepest = Real(2);
    s.peak = Real(8);
    s.lowest = Real(0.5);
    s.best = Real(8);
    s.iteration = 12;
    s.iteration_limit = 100;
    s.patience = 50;
    s.waited = 3;
    s.begun = 1;
    s.direction = TAUT_DIRECTION_CONJUGATE;
    s.replacements = 2;
    return s;
}

/// `count` units with a preconditioner: a value a row, or six a block of three rows. Some rows are held.
template <typename Real>
struct Preconditioned
{
    std::string variant;
    std::uint32_t rows = 0;
    std::vector<Real> inverse; ///< empty: none

    Preconditioned(std::string name, std::uint32_t units, Random& random)
        : variant(std::move(name)),
          rows(variant == "block" ? 3 * units : units)
    {
        if (variant == "diagonal" || variant == "stored_held")
            inverse = random_reals<Real>(random, rows, 0.1, 2);
        else if (variant == "block")
            for (std::uint32_t i = 0; i < units; ++i)
                for (const double low : {0.9, -0.2, -0.2, 0.9, -0.2, 0.9})
                    inverse.push_back(random.uniform<Real>(low, low + 0.4));
        for (std::uint32_t row = 0; row < rows; ++row)
            if (!inverse.empty() && random.chance(0.1))
                hold(row);
    }

    bool held(std::uint32_t row) const
    {
        if (inverse.empty())
            return false;
        static constexpr std::uint32_t kDiagonal[] = {0, 3, 5};
        return inverse[variant == "block" ? 6 * (row / 3) + kDiagonal[row % 3] : row] == 0;
    }

    /// (M^-1 r) of a row, and the size of its terms.
    void apply(const std::vector<double>& r, std::uint32_t row, double& z, double& size) const
    {
        z = r[row];
        size = std::abs(z);
        if (variant == "diagonal")
        {
            z *= static_cast<double>(inverse[row]);
            size = std::abs(z);
        }
        if (variant != "block")
            return;
        static constexpr std::uint32_t kPlace[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
        z = size = 0;
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            const double term =
                static_cast<double>(inverse[6 * (row / 3) + kPlace[row % 3][k]]) * r[3 * (row / 3) + k];
            z += term;
            size += std::abs(term);
        }
    }

private:
    void hold(std::uint32_t row)
    {
        static constexpr std::uint32_t kTouched[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
        if (variant != "block")
            inverse[row] = 0;
        else
            for (const std::uint32_t k : kTouched[row % 3])
                inverse[6 * (row / 3) + k] = 0;
    }
};

template <typename Real>
std::vector<double> to_doubles(const std::vector<Real>& values)
{
    return {values.begin(), values.end()};
}

template <typename Real>
CgState<Real> state_after(const Buffers& out)
{
    return values_of<CgState<Real>>(out.at("after"))[0];
}

/// Near enough for a number that some hundred roundings made.
template <typename Real>
Approx near(double value)
{
    return Approx(value).epsilon(sizeof(Real) == 8 ? 1e-13 : 1e-5);
}

} // namespace taut::conformance
