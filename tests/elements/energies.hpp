#pragma once
// The elements of tests/elements as everybody else would write them: an energy in fp64, and nothing of
// their kernels; and their records.

#include "support/element_terms.hpp"

#include "taut/elements/element.hpp"

#include <array>
#include <cmath>
#include <span>

namespace taut::elements_test {

/// values: rest length m, compliance m^4/J.
struct CubicSpringEnergy
{
    static constexpr std::uint32_t corners = 2;
    static constexpr bool quadratic = false;
    template <typename T>
    T operator()(const std::array<Point<T>, 2>& x, std::span<const double> values) const
    {
        const T stretch = length_of(minus(x[1], x[0])) - T(values[0]);
        return stretch * stretch * stretch * stretch / T(2 * values[1]);
    }
};

/// values: rest area m^2, compliance m^4/J.
struct HeldAreaEnergy
{
    static constexpr std::uint32_t corners = 3;
    static constexpr bool quadratic = false;
    template <typename T>
    T operator()(const std::array<Point<T>, 3>& x, std::span<const double> values) const
    {
        const Point<T> a = minus(x[1], x[0]), b = minus(x[2], x[0]);
        const Point<T> c = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        const T grown = T(0.5) * length_of(c) - T(values[0]);
        return grown * grown / T(2 * values[1]);
    }
};

/// values: stiffness N/m.
struct ThinRodEnergy
{
    static constexpr std::uint32_t corners = 3;
    static constexpr bool quadratic = true;
    template <typename T>
    T operator()(const std::array<Point<T>, 3>& x, std::span<const double> values) const
    {
        T squares = T(0);
        for (std::size_t k = 0; k < 3; ++k)
        {
            const T bow = x[2][k] - x[1][k] - (x[1][k] - x[0][k]);
            squares = squares + bow * bow;
        }
        return squares * T(0.5 * values[0]);
    }
};

template <typename Real>
struct CubicSpring
{
    using Energy = CubicSpringEnergy;
    std::uint32_t a, b;
    Real rest, compliance;
    static CubicSpring random(Random& r)
    {
        return {0, 0, r.uniform<Real>(0.2, 2), static_cast<Real>(std::pow(10, r.uniform(-4, 0)))};
    }
    std::array<double, 2> values() const { return {double(rest), double(compliance)}; }
};

template <typename Real>
struct HeldArea
{
    using Energy = HeldAreaEnergy;
    std::uint32_t a, b, c;
    Real rest, compliance;
    static HeldArea random(Random& r)
    {
        return {0, 0, 0, r.uniform<Real>(0.2, 2), static_cast<Real>(std::pow(10, r.uniform(-4, 0)))};
    }
    std::array<double, 2> values() const { return {double(rest), double(compliance)}; }
};

template <typename Real>
struct ThinRod
{
    using Energy = ThinRodEnergy;
    std::uint32_t a, b, c;
    Real stiffness;
    static ThinRod random(Random& r) { return {0, 0, 0, static_cast<Real>(std::pow(10, r.uniform(0, 4)))}; }
    std::array<double, 1> values() const { return {double(stiffness)}; }
};

/// As ElementKind::energy wants it.
template <typename Energy>
double energy_of(std::span<const glm::dvec3> x, std::span<const double> values)
{
    std::array<Point<double>, Energy::corners> corner{};
    for (std::size_t k = 0; k < Energy::corners; ++k)
        corner[k] = {x[k].x, x[k].y, x[k].z};
    return Energy()(corner, values);
}

/// All are added once a process.
void add_elements();

} // namespace taut::elements_test
