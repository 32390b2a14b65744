#pragma once
// Random hinges with what has no angle planted among them, and the angle's derivatives by automatic
// differentiation, for kernels that gather hinges at a vertex.

#include "support/dual.hpp"
#include "support/expect.hpp"
#include "support/random.hpp"

#include <numbers>

namespace taut::conformance {

using HingeCorners = std::array<glm::dvec3, 4>; ///< both ends of the edge, then both wings

/// The signed angle between the planes of two triangles about their edge, with all twelve derivatives.
inline Dual<12> dual_angle(const HingeCorners& x)
{
    std::array<Dual3<12>, 4> p;
    for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t k = 0; k < 3; ++k)
            p[v][k] = Dual<12>::variable(x[v][static_cast<int>(k)], 3 * v + k);
    const Dual3<12> edge = unit(p[1] - p[0]);
    const Dual3<12> n1 = unit(cross(p[1] - p[0], p[2] - p[0]));
    const Dual3<12> n2 = unit(cross(p[3] - p[0], p[1] - p[0]));
    return atan2(dot(cross(n1, n2), edge), dot(n1, n2));
}

/// What one hinge asks of one corner.
struct HingeTerm
{
    bool shaped = false;
    double value = 0;       ///< angle - rest, rad, in (-pi, pi]
    glm::dvec3 gradient{0}; ///< rad/m
    double gradient_scale = 0;
    double value_scale = 0;
};

inline double wing_height(const glm::dvec3& wing, const glm::dvec3& from, const glm::dvec3& edge)
{
    const double size = glm::length(edge);
    return size > 0 ? glm::length(glm::cross(wing - from, edge)) / size : 0;
}

/// `places` are the corners as they were added up from values of size `sum` in all.
template <typename Real>
HingeTerm hinge_term(const layout::BendingConstraint<Real>& c, const HingeCorners& x, double sum,
                     std::size_t corner)
{
    HingeTerm out;
    double size = 0;
    for (std::size_t v = 1; v < 4; ++v)
        size = std::max(size, glm::length(x[v] - x[0]));
    const double thin = std::min(wing_height(x[2], x[0], x[1] - x[0]), wing_height(x[3], x[0], x[1] - x[0]));
    if (thin <= 1e-5 * size)
        return out;
    const Dual<12> angle = dual_angle(x);
    out.shaped = true;
    out.value = std::remainder(angle.value - static_cast<double>(c.rest_angle), 2 * std::numbers::pi);
    for (int k = 0; k < 3; ++k)
        out.gradient[k] = angle.slope[3 * corner + static_cast<std::size_t>(k)];
    const double shape = (size + sum) / thin; // thin triangles turn with the rounding of their corners
    out.value_scale = std::numbers::pi * shape;
    out.gradient_scale = shape * shape / thin;
    return out;
}

template <typename Real>
struct HingeNet
{
    std::vector<glm::vec<4, Real>> position, low;
    std::vector<layout::BendingConstraint<Real>> hinge;

    std::array<std::uint32_t, 4> corners(std::uint32_t k) const
    {
        return {hinge[k].edge0, hinge[k].edge1, hinge[k].wing0, hinge[k].wing1};
    }
    HingeCorners places(std::uint32_t k, double& sum) const
    {
        HingeCorners x;
        const auto vertex = corners(k);
        for (std::size_t v = 0; v < 4; ++v)
        {
            x[v] = glm::dvec3(position[vertex[v]]) + glm::dvec3(low[vertex[v]]);
            sum += glm::length(x[v]);
        }
        return x;
    }
    void incidence(std::uint32_t count, std::vector<std::uint32_t>& start,
                   std::vector<std::uint32_t>& incident) const
    {
        start = {0};
        incident.clear();
        for (std::uint32_t v = 0; v < count; ++v)
        {
            for (std::uint32_t k = 0; k < hinge.size(); ++k)
                for (std::uint32_t c = 0; c < 4; ++c)
                    if (corners(k)[c] == v)
                        incident.push_back(4 * k + c);
            start.push_back(static_cast<std::uint32_t>(incident.size()));
        }
    }
};

/// `hinges` between vertices of their own (so that each is well shaped), a second set over the same vertices
/// with edge and wings exchanged, and at the front, with eight or more, some without an angle.
template <typename Real>
HingeNet<Real> hinge_net(Random& random, std::uint32_t hinges)
{
    constexpr double kPi = std::numbers::pi;
    HingeNet<Real> net;
    const auto order = random.shuffled(4 * hinges);
    net.position.resize(4 * hinges);
    net.low = random.vec4s<Real>(4 * hinges, 0x1p-26, 0, 1e-3);
    for (std::uint32_t k = 0; k < hinges; ++k)
    {
        const glm::dvec3 e = glm::normalize(glm::dvec3(random.vec4<double>(1, 0)) + glm::dvec3(0, 0, 1e-3));
        const glm::dvec3 side = glm::normalize(glm::cross(e, glm::dvec3(0.6, -0.48, 0.64)));
        const glm::dvec3 up = glm::cross(e, side), from(random.vec4<double>(1, 0));
        const auto wing = [&] {
            const double angle = random.uniform(-kPi, kPi), far = random.uniform(0.4, 1.2);
            const double along = random.uniform(-0.2, 1.2);
            return from + e * along + (side * std::cos(angle) + up * std::sin(angle)) * far;
        };
        HingeCorners x = {from, from + e * random.uniform(0.5, 1.5), wing(), wing()};
        if (hinges >= 8 && k < 4)
            x[k == 3 ? 1 : 2] = k == 0 ? x[0] : k == 1 ? x[1] : k == 2 ? (x[0] + x[1]) * 0.5 : x[0];
        for (std::size_t v = 0; v < 4; ++v)
        {
            const std::uint32_t at = order[4 * k + v];
            const glm::vec<3, Real> place(x[v]);
            net.position[at] = glm::vec<4, Real>(place, random.inverse_mass<Real>());
            if (hinges >= 8 && k < 4)
                net.low[at] = glm::vec<4, Real>(0);
        }
        const double rest = k < 4 && hinges >= 8
                                ? 0.3
                                : std::remainder(dual_angle(x).value + random.uniform(-2.8, 2.8), 2 * kPi);
        const double compliance = std::pow(10.0, random.uniform(-4, 1));
        const std::uint32_t* at = &order[4 * k];
        net.hinge.push_back(
            {at[0], at[1], at[2], at[3], static_cast<Real>(rest), static_cast<Real>(compliance)});
    }
    for (std::uint32_t k = 0; k < hinges; k += 3)
    {
        auto turned = net.hinge[k];
        std::swap(turned.edge0, turned.wing0);
        turned.rest_angle = Real(0);
        double sum = 0;
        net.hinge.push_back(turned);
        const HingeTerm term = hinge_term(turned, net.places(std::uint32_t(net.hinge.size() - 1), sum), 0, 0);
        if (term.shaped && std::abs(std::abs(term.value) - kPi) < 0.1)
            net.hinge.pop_back(); // near half a turn both ways are right
    }
    return net;
}

} // namespace taut::conformance
