#pragma once
// The membrane of woven cloth (kernels/elements/membrane.glsl) as a kind of element, in fp64 on the host.

#include "taut/elements/element.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace taut {

/// A yarn shorter than this, of its length, has no direction, and the triangle no shear.
inline constexpr double kLeastYarn = 1e-4;

/// J, of a triangle whose edges from its first corner are `e1` and `e2` (m) and whose values are `p`, as
/// membrane_kind() lists them. T: double, long double, or a number with derivatives, with sqrt()
/// and comparisons, made of one by T{a}.
template <typename T>
T membrane_energy(const std::array<T, 3>& e1, const std::array<T, 3>& e2, std::span<const double> p)
{
    using std::sqrt;
    std::array<T, 3> warp, weft; // images of a metre of each yarn
    for (std::size_t k = 0; k < 3; ++k)
    {
        warp[k] = e1[k] * T{p[0]} + e2[k] * T{p[2]};
        weft[k] = e1[k] * T{p[1]} + e2[k] * T{p[3]};
    }
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const T lu = sqrt(dot(warp, warp)), lv = sqrt(dot(weft, weft)), u = lu - T{1}, v = lv - T{1};
    const bool sheared = lu > T{kLeastYarn} && lv > T{kLeastYarn};
    const T q = sheared ? dot(warp, weft) / (lu * lv) : T{0};
    return T{0.5} * (T{p[4]} * u * u + T{2} * T{p[5]} * u * v + T{p[6]} * v * v + T{p[7]} * q * q);
}

/// Three corners; values p11, p12, p21, p22 (1/m) and c11, c12, c22, c33 (J), docs/fabric.md. Known to every
/// scene without add_element().
ElementKind membrane_kind();

} // namespace taut
