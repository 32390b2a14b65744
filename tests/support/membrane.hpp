#pragma once
// The membrane of woven cloth as docs/fabric.md has it, in fp64 and apart from kernels and library: energy,
// curvature, and random records.

#include "support/element_terms.hpp"

#include <glm/matrix.hpp>

namespace taut::elements_test {

/// values: p11, p12, p21, p22 1/m, then c11, c12, c22, c33 J.
struct MembraneEnergy
{
    static constexpr std::uint32_t corners = 3;
    static constexpr bool quadratic = false;
    using Corners = std::array<glm::dvec3, 3>;
    using Blocks = std::array<std::array<glm::dmat3, 3>, 3>;
    using D = Dual<9>;

    /// Of warp, weft and shear.
    template <typename T>
    static std::array<T, 3> strains(const std::array<Point<T>, 3>& x, std::span<const double> p)
    {
        const Point<T> e1 = minus(x[1], x[0]), e2 = minus(x[2], x[0]);
        Point<T> u, v;
        for (std::size_t k = 0; k < 3; ++k)
        {
            u[k] = e1[k] * T(p[0]) + e2[k] * T(p[2]);
            v[k] = e1[k] * T(p[1]) + e2[k] * T(p[3]);
        }
        const T lu = length_of(u), lv = length_of(v);
        return {lu - T(1), lv - T(1), (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) / (lu * lv)};
    }
    template <typename T>
    T operator()(const std::array<Point<T>, 3>& x, std::span<const double> p) const
    {
        const auto [u, v, q] = strains(x, p);
        return (u * u * T(p[4]) + u * v * T(2 * p[5]) + v * v * T(p[6]) + q * q * T(p[7])) * T(0.5);
    }

    static std::array<D, 3> strains_at(const Corners& x, std::span<const double> p)
    {
        std::array<Point<D>, 3> point;
        for (std::size_t k = 0; k < 9; ++k)
            point[k / 3][k % 3] = D::variable(x[k / 3][static_cast<int>(k % 3)], k);
        return strains(point, p);
    }
    /// Gauss-Newton of the three strains, and the curvature of the lengths of yarns that are pulled.
    static Blocks curvature(const Corners& x, std::span<const double> p)
    {
        const std::array<D, 3> here = strains_at(x, p);
        const double c[3][3] = {{p[4], p[5], 0}, {p[5], p[6], 0}, {0, 0, p[7]}};
        Blocks out{};
        for (std::size_t j = 0; j < 9; ++j)
            for (std::size_t k = 0; k < 9; ++k)
                for (std::size_t a = 0; a < 3; ++a)
                    for (std::size_t b = 0; b < 3; ++b)
                        out[j / 3][k / 3][static_cast<int>(k % 3)][static_cast<int>(j % 3)] +=
                            c[a][b] * here[a].slope[j] * here[b].slope[k];
        for (std::size_t yarn = 0; yarn < 2; ++yarn)
        {
            const double share[3] = {-p[yarn] - p[yarn + 2], p[yarn], p[yarn + 2]}; // of each corner in f
            const glm::dvec3 f = share[0] * x[0] + share[1] * x[1] + share[2] * x[2];
            const double length = glm::length(f);
            const double pull = c[yarn][0] * here[0].value + c[yarn][1] * here[1].value;
            const glm::dmat3 turn = (glm::dmat3(1) - glm::outerProduct(f / length, f / length)) / length;
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    out[i][k] += std::max(pull, 0.0) * share[i] * share[k] * turn;
        }
        return out;
    }
};

/// Orthotropic, in some direction, of triangles of about a metre.
template <typename Real>
struct Membrane
{
    using Energy = MembraneEnergy;
    std::uint32_t a, b, c;
    Real p11, p12, p21, p22, c11, c12, c22, c33;
    static Membrane random(Random& r)
    {
        const double angle = r.uniform(0, 6.28), s = r.uniform(0.5, 1.5), t = r.uniform(0.5, 1.5);
        const double warp = std::pow(10, r.uniform(2, 5)), weft = std::pow(10, r.uniform(2, 5));
        return {0,
                0,
                0,
                Real(s * std::cos(angle)),
                Real(s * std::sin(angle)),
                Real(-t * std::sin(angle)),
                Real(t * std::cos(angle)),
                Real(warp),
                Real(r.uniform(-0.7, 0.7) * std::sqrt(warp * weft)),
                Real(weft),
                Real(std::pow(10, r.uniform(0, 4)))};
    }
    std::array<double, 8> values() const
    {
        return {double(p11), double(p12), double(p21), double(p22),
                double(c11), double(c12), double(c22), double(c33)};
    }
};

} // namespace taut::elements_test
