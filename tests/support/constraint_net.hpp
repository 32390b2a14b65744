#pragma once
// A random net of springs as rows of implicit constraints, with the rows at each vertex: what the tests of
// kernels/constraint and kernels/acad share.

#include "support/linear_groups.hpp"

#include <cstring>

namespace taut::conformance {

template <typename Real>
struct RowNet
{
    using Vec = glm::vec<4, Real>;
    std::vector<layout::Spring<Real>> row;
    std::vector<std::uint32_t> start, incident; ///< rows at each vertex: 2 * row + end
    std::vector<Vec> position, delta, direction;
    std::vector<Real> p;
    layout::StepValues<Real> step{};
    std::uint32_t vertices() const { return static_cast<std::uint32_t>(position.size()); }
    std::uint32_t rows() const { return static_cast<std::uint32_t>(row.size()); }
};

/// A record whose padding is zero, as in buffers that kernels copy member by member.
template <typename Real>
layout::Spring<Real> spring_record(std::uint32_t a, std::uint32_t b, Real rest_length, Real stiffness,
                                   Real damping, std::uint32_t kind)
{
    layout::Spring<Real> s;
    std::memset(static_cast<void*>(&s), 0, sizeof(s));
    s.a = a;
    s.b = b;
    s.rest_length = rest_length;
    s.stiffness = stiffness;
    s.damping = damping;
    s.kind = kind;
    return s;
}

/// `rows` springs among about half as many vertices; two of them the same, some vertices held.
template <typename Real>
RowNet<Real> random_row_net(Random& random, std::uint32_t rows)
{
    RowNet<Real> net;
    const std::uint32_t vertices = rows / 2 + 2;
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        const Real w = random.inverse_mass<Real>();
        net.position.push_back(random.vec4<Real>(1, w));
        net.delta.push_back(random.vec4<Real>(1e-2, random.uniform<Real>(0, 1e-3)));
    }
    static constexpr double kStiffness[] = {0, 1, 1e3, 1e6};
    static constexpr double kDamping[] = {0, 0, 0.5};
    for (std::uint32_t r = 0; r < rows; ++r)
    {
        const std::uint32_t a = random.below(vertices), b = (a + 1 + random.below(vertices - 1)) % vertices;
        const Real stiffness = static_cast<Real>(kStiffness[random.below(4)]);
        const Real damping = static_cast<Real>(kDamping[random.below(3)]) * stiffness;
        net.row.push_back(spring_record<Real>(a, b, random.uniform<Real>(0.1, 2), stiffness, damping, 0));
        net.p.push_back(random.uniform<Real>(-1, 1));
        glm::dvec3 n = glm::normalize(glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), 2));
        n = random.chance(0.1) ? glm::dvec3(0) : n; // an empty row
        net.direction.push_back(
            {glm::vec<3, Real>(n), random.chance(0.5) ? Real(0) : random.uniform<Real>(0, 9)});
    }
    if (rows > 5)
        net.row[4] = net.row[3];
    net.start.assign(vertices + 1, 0);
    for (std::uint32_t v = 0; v < vertices; ++v)
    {
        for (std::uint32_t r = 0; r < rows; ++r)
            for (std::uint32_t end = 0; end < 2; ++end)
                if ((end == 0 ? net.row[r].a : net.row[r].b) == v)
                    net.incident.push_back(2 * r + end);
        net.start[v + 1] = static_cast<std::uint32_t>(net.incident.size());
    }
    net.step.substep = Real(1) / Real(600);
    net.step.inverse_substep = Real(600);
    return net;
}

template <typename Real>
glm::dvec3 wide3(const glm::vec<4, Real>& v)
{
    return glm::dvec3(v);
}

/// Adds x, y, z and w with one scale for the first three.
inline void add_vec4(Field& field, const glm::dvec3& v, double scale, double w, double w_scale = 0)
{
    for (int k = 0; k < 3; ++k)
        field.add(v[k], scale);
    field.add(w, w_scale);
}

} // namespace taut::conformance
