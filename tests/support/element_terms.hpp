#pragma once
// What tests know of an element: an energy in fp64, and nothing of its kernels. Slopes and curvature follow
// by dual numbers; random nets of records, and what rounds in them. An Energy has `corners`, `quadratic`, and
// operator()(corners, values) for numbers and duals; it may have curvature(corners, values), the blocks that
// its kernels take; else they are Gauss-Newton's of C = sqrt(2 E). A Record has Energy, corners first,
// random(Random&) and values().

#include "support/dual.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>

namespace taut::elements_test {

using conformance::Dual;
using conformance::Random;

template <typename T>
using Point = std::array<T, 3>;

template <typename T>
Point<T> minus(const Point<T>& a, const Point<T>& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <typename T>
T length_of(const Point<T>& a)
{
    using std::sqrt;
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

template <typename Record>
std::array<std::uint32_t, Record::Energy::corners> corners_of(const Record& record)
{
    std::array<std::uint32_t, Record::Energy::corners> out;
    std::memcpy(out.data(), &record, sizeof(out)); // corners come first
    return out;
}

/// What an energy makes of its corners.
template <std::size_t n>
struct Terms
{
    double energy = 0;
    std::array<glm::dvec3, n> slope{};                    ///< N
    std::array<std::array<glm::dmat3, n>, n> curvature{}; ///< as kernels take it, N/m
    double stiff = 0; ///< N/m: how much a slope changes at most with a corner
};

template <typename Energy>
Dual<3 * Energy::corners> energy_at(const std::array<glm::dvec3, Energy::corners>& x,
                                    std::span<const double> values)
{
    using D = Dual<3 * Energy::corners>;
    std::array<Point<D>, Energy::corners> point;
    for (std::size_t k = 0; k < 3 * Energy::corners; ++k)
        point[k / 3][k % 3] = D::variable(x[k / 3][static_cast<int>(k % 3)], k);
    return Energy()(point, values);
}

/// Slopes, and how they change over a step of each coordinate: of a quadratic energy exactly.
template <typename Energy>
Terms<Energy::corners> terms_of(const std::array<glm::dvec3, Energy::corners>& x,
                                std::span<const double> values)
{
    constexpr std::size_t n = Energy::corners;
    constexpr bool own = requires { Energy::curvature(x, values); };
    const double step = Energy::quadratic ? 1 : 1e-6;
    Terms<n> out;
    const auto here = energy_at<Energy>(x, values);
    out.energy = here.value;
    for (std::size_t k = 0; k < 3 * n; ++k)
        out.slope[k / 3][static_cast<int>(k % 3)] = here.slope[k];
    for (std::size_t k = 0; k < 3 * n; ++k)
    {
        auto moved = x;
        moved[k / 3][static_cast<int>(k % 3)] += step;
        const auto there = energy_at<Energy>(moved, values);
        for (std::size_t j = 0; j < 3 * n; ++j)
        {
            const double change = (there.slope[j] - here.slope[j]) / step;
            out.stiff = std::max(out.stiff, std::abs(change));
            double& entry = out.curvature[j / 3][k / 3][static_cast<int>(k % 3)][static_cast<int>(j % 3)];
            // Without a curvature of its own Gauss-Newton's: C = sqrt(2 E), grad C grad C^T.
            entry = Energy::quadratic ? change
                    : here.value > 0  ? here.slope[j] * here.slope[k] / (2 * here.value)
                                      : 0;
        }
    }
    if constexpr (own)
        out.curvature = Energy::curvature(x, values);
    return out;
}

/// Elements on random vertices in a box of 2 m, every vertex in several.
template <typename Real, template <typename> typename Record>
struct ElementNet
{
    std::vector<glm::vec<4, Real>> position, low, delta;
    std::vector<Record<Real>> elements;

    static constexpr std::size_t n = Record<Real>::Energy::corners;

    ElementNet(std::uint32_t vertices, std::uint32_t count, std::uint64_t seed)
    {
        Random random(seed);
        position = random.vec4s<Real>(vertices, 1, 0, 0);
        low = random.vec4s<Real>(vertices, 0x1p-26, 0, 0);
        delta = random.vec4s<Real>(vertices, 0.1, 0, 0);
        for (auto& p : position)
            p.w = random.inverse_mass<Real>();
        while (elements.size() < count)
        {
            const auto order = random.shuffled(vertices);
            for (std::uint32_t k = 0; k + n <= vertices && elements.size() < count; k += n)
            {
                elements.push_back(Record<Real>::random(random));
                std::memcpy(&elements.back(), order.data() + k, 4 * n);
            }
        }
    }
    /// Terms of an element with its corners at position + `more`, and in `size` what was added up for them.
    Terms<n> terms(std::size_t k, const std::vector<glm::vec<4, Real>>& more, double& size) const
    {
        std::array<glm::dvec3, n> x;
        const auto v = corners_of(elements[k]);
        size = 0;
        for (std::size_t c = 0; c < n; ++c)
        {
            x[c] = glm::dvec3(position[v[c]]) + glm::dvec3(more[v[c]]);
            size = std::max({size, glm::length(glm::dvec3(position[v[c]])), glm::length(x[c] - x[0])});
        }
        const auto values = elements[k].values();
        return terms_of<typename Record<Real>::Energy>(x, values);
    }
};

/// How much curvature changes over the size of what rounds, and itself.
template <typename Record>
double block_size(const Record& record, std::array<glm::dvec3, Record::Energy::corners> x, double size)
{
    const auto values = record.values();
    const auto here = terms_of<typename Record::Energy>(x, values);
    double most = 0;
    for (std::size_t k = 0; k < 3 * x.size(); ++k)
    {
        auto moved = x;
        moved[k / 3][static_cast<int>(k % 3)] += 1e-6;
        const auto there = terms_of<typename Record::Energy>(moved, values);
        for (std::size_t i = 0; i < x.size(); ++i)
            for (std::size_t j = 0; j < x.size(); ++j)
                for (int c = 0; c < 3; ++c)
                    most = std::max(
                        {most, glm::length(here.curvature[i][j][c]),
                         glm::length(there.curvature[i][j][c] - here.curvature[i][j][c]) * (size / 1e-6)});
    }
    return most;
}

template <typename Real, template <typename> typename Record>
std::array<glm::dvec3, Record<Real>::Energy::corners> places(const ElementNet<Real, Record>& net,
                                                             std::size_t k)
{
    std::array<glm::dvec3, Record<Real>::Energy::corners> x;
    const auto v = corners_of(net.elements[k]);
    for (std::size_t c = 0; c < x.size(); ++c)
        x[c] = glm::dvec3(net.position[v[c]]) + glm::dvec3(net.delta[v[c]]);
    return x;
}

/// E(x + w) - E(x): the difference where w is large, else the slope along the way, summed (Gauss-Legendre).
template <typename Record>
double rise_of(const Record& record, const std::array<glm::dvec3, Record::Energy::corners>& x,
               const std::array<glm::dvec3, Record::Energy::corners>& w, double& size)
{
    using Energy = typename Record::Energy;
    const auto values = record.values();
    const auto at = [&](double share) {
        auto moved = x;
        for (std::size_t c = 0; c < x.size(); ++c)
            moved[c] += w[c] * share;
        return terms_of<Energy>(moved, values);
    };
    const auto now = at(0), then = at(1);
    double way = 0, steep = 0;
    for (std::size_t c = 0; c < x.size(); ++c)
    {
        way = std::max(way, glm::length(w[c] - w[0]));
        steep += glm::length(now.slope[c]) + glm::length(then.slope[c]);
    }
    size = now.energy + then.energy + steep * (size + way) + now.stiff * size * way;
    if (way > 1e-3)
        return then.energy - now.energy;
    double sum = 0;
    constexpr double kAt[] = {0.5, 0.230765344947158455, 0.769234655052841545, 0.046910077030668004,
                              0.953089922969331996};
    constexpr double kWeight[] = {0.284444444444444444, 0.239314335249683234, 0.239314335249683234,
                                  0.118463442528094544, 0.118463442528094544};
    for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t c = 0; c < x.size(); ++c)
            sum += kWeight[k] * glm::dot(at(kAt[k]).slope[c], w[c]);
    return sum;
}

} // namespace taut::elements_test
