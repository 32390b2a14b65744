#pragma once
// Random tetrahedra as rows of implicit constraints behind those of springs, with the tetrahedra at each
// vertex: what the tests of kernels/constraint/volume_rows and corner_* share.

#include "support/linear_groups.hpp"

namespace taut::conformance {

template <typename Real>
struct VolumeNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<layout::VolumeConstraint<Real>> row;
    std::vector<std::uint32_t> start, incident; ///< 4 * tetrahedron + corner
    std::vector<Vec> position, delta, gradient; ///< 3 gradients a row
    std::vector<Real> x;                        ///< of all rows, those of springs first
    std::uint32_t first = 0;                    ///< rows of springs
    layout::StepValues<Real> step{};
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(position.size()); }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(row.size()); }

    glm::dvec3 gradient_of(std::uint32_t r, std::uint32_t corner) const
    {
        const glm::dvec3 g[3] = {glm::dvec3(gradient[3 * r]), glm::dvec3(gradient[3 * r + 1]),
                                 glm::dvec3(gradient[3 * r + 2])};
        return corner == 0 ? -(g[0] + g[1] + g[2]) : g[corner - 1];
    }
    /// Size of the terms of that.
    double scale_of(std::uint32_t r) const
    {
        double sum = 0;
        for (std::uint32_t k = 0; k < 3; ++k)
            sum += glm::length(glm::dvec3(gradient[3 * r + k]));
        return sum;
    }
};

/// `rows` tetrahedra among about half as many vertices, behind 5 rows of springs; some vertices held.
template <typename Real>
VolumeNet<Real> random_volume_net(Random& random, std::uint32_t rows)
{
    static constexpr double kCompliances[] = {0, 1e-9, 1e-4, 1e38};
    VolumeNet<Real> net;
    net.first = 5;
    const std::uint32_t vertices = rows / 2 + 5;
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        const Real w = random.inverse_mass<Real>();
        net.position.push_back(random.vec4<Real>(1, w));
        net.delta.push_back(random.vec4<Real>(1e-2, random.uniform<Real>(0, 1e-3)));
    }
    for (std::uint32_t r = 0; r < rows; ++r)
    {
        std::uint32_t v[4];
        for (std::uint32_t k = 0; k < 4; ++k)
            do
                v[k] = random.below(vertices);
            while (std::find(v, v + k, v[k]) != v + k);
        net.row.push_back({v[0], v[1], v[2], v[3], random.uniform<Real>(0.01, 0.5),
                           static_cast<Real>(kCompliances[random.below(4)])});
        const Real soft = random.chance(0.5) ? Real(0) : random.uniform<Real>(0, 9);
        for (std::uint32_t k = 0; k < 3; ++k)
            net.gradient.push_back(random.vec4<Real>(1, soft));
    }
    for (std::uint32_t r = 0; r < rows + net.first; ++r)
        net.x.push_back(random.uniform<Real>(-1, 1));
    net.start.assign(vertices + 1, 0);
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        for (std::uint32_t r = 0; r < rows; ++r)
        {
            const std::uint32_t own[4] = {net.row[r].a, net.row[r].b, net.row[r].c, net.row[r].d};
            for (std::uint32_t k = 0; k < 4; ++k)
                if (own[k] == v)
                    net.incident.push_back(4 * r + k);
        }
        net.start[v + 1] = static_cast<std::uint32_t>(net.incident.size());
    }
    net.step.substep = Real(1) / Real(600);
    net.step.inverse_substep = Real(600);
    return net;
}

} // namespace taut::conformance
