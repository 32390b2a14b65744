#pragma once
// Random springs between random vertices with what divides by zero planted among them, and the forces by
// definition, for the kernels of mass-spring.

#include "support/expect.hpp"
#include "support/random.hpp"

namespace taut::conformance {

template <typename Real>
struct SpringNet
{
    std::vector<glm::vec<4, Real>> position, low, velocity;
    std::vector<layout::Spring<Real>> spring;
    bool damped = false;

    glm::dvec3 place(std::uint32_t v) const { return glm::dvec3(position[v]) + glm::dvec3(low[v]); }
    bool degenerate(std::uint32_t k) const
    {
        const auto& s = spring[k];
        return place(s.a) == place(s.b) && s.rest_length > 0 && position[s.a].w + position[s.b].w > 0;
    }

    /// Force on end a: -(k (l - L) + c v.n) n; and the size of what was added to make it.
    glm::dvec3 force(std::uint32_t k, double& scale) const
    {
        const auto& s = spring[k];
        const glm::dvec3 d = place(s.a) - place(s.b);
        const double length = glm::length(d), rest = double(s.rest_length), stiff = double(s.stiffness);
        if (length == 0)
            return glm::dvec3(0);
        const glm::dvec3 n = d / length;
        const double c = damped ? double(s.damping) : 0;
        const glm::dvec3 v = glm::dvec3(velocity[s.a]) - glm::dvec3(velocity[s.b]);
        const double pull = stiff * (length - rest) + c * glm::dot(v, n);
        const double size = glm::length(place(s.a)) + glm::length(place(s.b));
        const double speed = glm::length(glm::dvec3(velocity[s.a])) + glm::length(glm::dvec3(velocity[s.b]));
        scale += stiff * (size + rest) + (std::abs(pull) + c * speed) * (1 + size / length);
        return -pull * n;
    }

    /// Springs and ends at each of the first `count` vertices, ascending.
    void incidence(std::uint32_t count, std::vector<std::uint32_t>& start,
                   std::vector<std::uint32_t>& incident) const
    {
        start = {0};
        incident.clear();
        for (std::uint32_t v = 0; v < count; ++v)
        {
            for (std::uint32_t k = 0; k < spring.size(); ++k)
                for (std::uint32_t end = 0; end < 2; ++end)
                    if ((end == 0 ? spring[k].a : spring[k].b) == v)
                        incident.push_back(2 * k + end);
            start.push_back(static_cast<std::uint32_t>(incident.size()));
        }
    }

    /// One record an end: a = this vertex, b = the other.
    std::vector<layout::Spring<Real>> ends(const std::vector<std::uint32_t>& incident) const
    {
        std::vector<layout::Spring<Real>> out;
        for (const std::uint32_t at : incident)
        {
            out.push_back(spring[at / 2]);
            if (at % 2 == 1)
                std::swap(out.back().a, out.back().b);
        }
        return out;
    }

    void expect_forces(std::uint32_t count, Field& field) const
    {
        std::vector<glm::dvec3> sum(position.size(), glm::dvec3(0));
        std::vector<double> scale(position.size(), 0.0);
        for (std::uint32_t k = 0; k < spring.size(); ++k)
        {
            double own = 0;
            const glm::dvec3 f = force(k, own);
            sum[spring[k].a] += f;
            sum[spring[k].b] -= f;
            scale[spring[k].a] += own;
            scale[spring[k].b] += own;
        }
        for (std::uint32_t v = 0; v < position.size(); ++v)
            for (int c = 0; c < 4; ++c)
                field.add(v < count ? (c < 3 ? sum[v][c] : 0) : 7, v < count && c < 3 ? scale[v] : 0);
    }
};

template <typename Real>
SpringNet<Real> spring_net(Random& random, std::uint32_t vertices, std::uint32_t springs, bool damped)
{
    SpringNet<Real> net;
    net.damped = damped;
    net.position = random.vec4s<Real>(vertices, 1, 0, 0);
    for (auto& p : net.position)
        p.w = random.inverse_mass<Real>();
    net.low = random.vec4s<Real>(vertices, 0x1p-26, 0, 1e-3);
    net.velocity = random.vec4s<Real>(vertices, 3, 0, 0);
    for (std::uint32_t k = 0; k < springs; ++k)
    {
        const std::uint32_t a = random.below(vertices), b = (a + 1 + random.below(vertices - 1)) % vertices;
        const double stiffness = std::pow(10.0, random.uniform(-2, 5));
        net.spring.push_back({a, b, random.uniform<Real>(0, 1.5), static_cast<Real>(stiffness),
                              static_cast<Real>(stiffness * random.uniform(0, 0.1)), random.below(4)});
    }
    if (springs >= 4)
    {
        const auto coincide = [&](std::uint32_t k) {
            net.position[net.spring[k].b] = net.position[net.spring[k].a];
            net.low[net.spring[k].b] = net.low[net.spring[k].a];
        };
        coincide(0); // no direction: counted, unless both ends are held
        net.position[net.spring[0].a].w = net.position[net.spring[0].b].w = Real(1);
        coincide(1);
        net.spring[1].rest_length = 0; // where it wants to be: not counted
        net.spring[2].rest_length = 0; // pulls with k d
        net.spring[3].stiffness = 0;
    }
    return net;
}

} // namespace taut::conformance
