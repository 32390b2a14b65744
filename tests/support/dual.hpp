#pragma once
// Numbers that carry their derivatives (forward mode), so that a test gets the gradient of a formula from the
// formula alone. N is the number of variables.

#include <array>
#include <cmath>
#include <cstddef>

namespace taut::conformance {

template <std::size_t N>
struct Dual
{
    double value = 0;
    std::array<double, N> slope{};

    Dual() = default;
    Dual(double v) : value(v) {}

    static Dual variable(double v, std::size_t index)
    {
        Dual x(v);
        x.slope[index] = 1;
        return x;
    }
};

/// f(a, b) with partial derivatives fa and fb.
template <std::size_t N>
Dual<N> chain(double f, double fa, const Dual<N>& a, double fb, const Dual<N>& b)
{
    Dual<N> out(f);
    for (std::size_t i = 0; i < N; ++i)
        out.slope[i] = fa * a.slope[i] + fb * b.slope[i];
    return out;
}

template <std::size_t N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b)
{
    return chain(a.value + b.value, 1, a, 1, b);
}

template <std::size_t N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b)
{
    return chain(a.value - b.value, 1, a, -1, b);
}

template <std::size_t N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b)
{
    return chain(a.value * b.value, b.value, a, a.value, b);
}

template <std::size_t N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b)
{
    const double q = a.value / b.value;
    return chain(q, 1 / b.value, a, -q / b.value, b);
}

template <std::size_t N>
Dual<N> sqrt(const Dual<N>& a)
{
    const double root = std::sqrt(a.value);
    return chain(root, 0.5 / root, a, 0, a);
}

template <std::size_t N>
Dual<N> atan2(const Dual<N>& y, const Dual<N>& x)
{
    const double square = x.value * x.value + y.value * y.value;
    return chain(std::atan2(y.value, x.value), x.value / square, y, -y.value / square, x);
}

template <std::size_t N>
using Dual3 = std::array<Dual<N>, 3>;

template <std::size_t N>
Dual3<N> operator-(const Dual3<N>& a, const Dual3<N>& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <std::size_t N>
Dual<N> dot(const Dual3<N>& a, const Dual3<N>& b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <std::size_t N>
Dual3<N> cross(const Dual3<N>& a, const Dual3<N>& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <std::size_t N>
Dual3<N> unit(const Dual3<N>& a)
{
    const Dual<N> size = sqrt(dot(a, a));
    return {a[0] / size, a[1] / size, a[2] / size};
}

} // namespace taut::conformance
