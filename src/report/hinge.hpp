#pragma once
// The dihedral angle of a hinge with its gradient, over any scalar: double and long double for forces,
// dual numbers for the Hessian.
// Based on: Bridson, Marino, Fedkiw 2003; Grinspun et al., Discrete Shells, 2003.
// Departures: none.

#include <array>
#include <cmath>
#include <cstddef>

namespace taut::reference {

template <typename T>
struct Vec
{
    T x{}, y{}, z{};
};

template <typename T> Vec<T> operator+(const Vec<T>& a, const Vec<T>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <typename T> Vec<T> operator-(const Vec<T>& a, const Vec<T>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <typename T> Vec<T> operator*(const T& s, const Vec<T>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <typename T> T dot(const Vec<T>& a, const Vec<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <typename T> Vec<T> cross(const Vec<T>& a, const Vec<T>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A number with its N partial derivatives.
template <std::size_t N, typename T = double>
struct Dual
{
    T v = 0;
    std::array<T, N> d{};

    static Dual chain(T value, T slope_a, const Dual& a, T slope_b, const Dual& b)
    {
        Dual out;
        out.v = value;
        for (std::size_t i = 0; i < N; ++i)
            out.d[i] = slope_a * a.d[i] + slope_b * b.d[i];
        return out;
    }
    friend Dual operator+(const Dual& a, const Dual& b) { return chain(a.v + b.v, 1, a, 1, b); }
    friend Dual operator-(const Dual& a, const Dual& b) { return chain(a.v - b.v, 1, a, -1, b); }
    friend Dual operator*(const Dual& a, const Dual& b) { return chain(a.v * b.v, b.v, a, a.v, b); }
    friend Dual operator/(const Dual& a, const Dual& b)
    {
        return chain(a.v / b.v, 1 / b.v, a, -a.v / (b.v * b.v), b);
    }
    friend Dual sqrt(const Dual& a)
    {
        const T root = std::sqrt(a.v);
        return chain(root, root > 0 ? T(0.5) / root : 0, a, 0, a); // a length of zero has no direction
    }
    friend Dual atan2(const Dual& y, const Dual& x)
    {
        const T r2 = x.v * x.v + y.v * y.v;
        return chain(std::atan2(y.v, x.v), x.v / r2, y, -y.v / r2, x);
    }
    friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }
};

template <typename T>
struct HingeAngle
{
    T angle{};
    std::array<Vec<T>, 4> gradient; ///< edge0, edge1, wing0, wing1, rad/m
    bool valid = false;             ///< false when the edge or an area vanishes: no gradient
};

inline double plain(double a) { return a; }
inline double plain(long double a) { return static_cast<double>(a); }
template <std::size_t N, typename T>
double plain(const Dual<N, T>& a)
{
    return static_cast<double>(a.v);
}

/// x = edge0, edge1, wing0, wing1.
template <typename T>
HingeAngle<T> hinge_angle(const std::array<Vec<T>, 4>& x)
{
    using std::atan2;
    using std::sqrt;
    const Vec<T> e = x[1] - x[0], w2 = x[2] - x[0], w3 = x[3] - x[0];
    const Vec<T> n1 = cross(e, w2), n2 = cross(w3, e);
    const T ee = dot(e, e), nn1 = dot(n1, n1), nn2 = dot(n2, n2);
    HingeAngle<T> out;
    if (!(plain(ee) > 0) || !(plain(nn1) > 0) || !(plain(nn2) > 0))
        return out;
    const T length = sqrt(ee);
    out.valid = true;
    out.angle = atan2(dot(cross(n1, n2), e) / length, dot(n1, n2));
    const T zero = ee - ee;
    const Vec<T> g2 = ((zero - length) / nn1) * n1, g3 = ((zero - length) / nn2) * n2;
    const T b2 = dot(w2, e) / ee, b3 = dot(w3, e) / ee;
    const Vec<T> along = b2 * g2 + b3 * g3;
    out.gradient = {along - g2 - g3, Vec<T>{zero - along.x, zero - along.y, zero - along.z}, g2, g3};
    return out;
}

/// The way from the rest angle, through the branch cut at pi where that is shorter.
template <typename T>
T angle_difference(const T& angle, double rest)
{
    constexpr long double kTurn = 6.283185307179586476925286766559L;
    T out = angle - static_cast<T>(rest);
    if (out > static_cast<T>(kTurn / 2))
        out -= static_cast<T>(kTurn);
    else if (out < static_cast<T>(-kTurn / 2))
        out += static_cast<T>(kTurn);
    return out;
}

} // namespace taut::reference
