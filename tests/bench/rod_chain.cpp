#include "rod_chain.hpp"

#include <glm/geometric.hpp>

#include <cmath>

namespace bench {
namespace {

using Points = std::vector<glm::dvec2>;

struct State
{
    Points place, velocity;
};

/// Solves -d_k T_k + c_k T_{k-1} + c_{k+1} T_{k+1} = right_k (Thomas); `c[k]` couples rods k - 1 and k.
std::vector<double> tensions(const std::vector<double>& diagonal, const std::vector<double>& c,
                             std::vector<double> right)
{
    const std::size_t n = diagonal.size();
    std::vector<double> pivot(n);
    for (std::size_t k = 0; k < n; ++k)
    {
        const double factor = k == 0 ? 0 : c[k] / pivot[k - 1];
        pivot[k] = -diagonal[k] - (k == 0 ? 0 : factor * c[k]);
        right[k] -= k == 0 ? 0 : factor * right[k - 1];
    }
    for (std::size_t k = n; k-- > 0;)
        right[k] = (right[k] - (k + 1 < n ? c[k + 1] * right[k + 1] : 0)) / pivot[k];
    return right;
}

/// Accelerations of all masses, m/s^2; rod k joins masses k and k + 1.
Points accelerations(const State& s, double length)
{
    const glm::dvec2 gravity(0, -9.81);
    const std::size_t rods = s.place.size() - 1;
    Points along(rods);
    std::vector<double> diagonal(rods, 2.0), coupling(rods, 0.0), right(rods);
    for (std::size_t k = 0; k < rods; ++k)
    {
        along[k] = (s.place[k + 1] - s.place[k]) / length;
        const glm::dvec2 apart = s.velocity[k + 1] - s.velocity[k];
        right[k] = -glm::dot(apart, apart) / length;
        if (k > 0)
            coupling[k] = glm::dot(along[k], along[k - 1]);
    }
    diagonal[0] = 1; // the first mass does not move
    right[0] -= glm::dot(gravity, along[0]);
    const std::vector<double> tension = tensions(diagonal, coupling, right);
    Points out(rods + 1, glm::dvec2(0));
    for (std::size_t k = 1; k <= rods; ++k)
        out[k] = gravity - tension[k - 1] * along[k - 1] + (k < rods ? tension[k] * along[k] : glm::dvec2(0));
    return out;
}

State moved(const State& s, const State& rate, double h)
{
    State out = s;
    for (std::size_t k = 0; k < s.place.size(); ++k)
    {
        out.place[k] += h * rate.place[k];
        out.velocity[k] += h * rate.velocity[k];
    }
    return out;
}

} // namespace

std::vector<glm::dvec2> fallen_chain(int rods, double length, double time, double step)
{
    State s;
    for (int k = 0; k <= rods; ++k)
        s.place.emplace_back(k * length, 0);
    s.velocity.assign(s.place.size(), glm::dvec2(0));
    const auto rate = [&](const State& at) { return State{at.velocity, accelerations(at, length)}; };
    const int steps = static_cast<int>(std::ceil(time / step));
    const double h = time / steps;
    for (int i = 0; i < steps; ++i)
    {
        const State a = rate(s), b = rate(moved(s, a, h / 2)), c = rate(moved(s, b, h / 2)),
                    d = rate(moved(s, c, h));
        for (const auto& [slope, weight] :
             {std::pair(&a, 1.0), std::pair(&b, 2.0), std::pair(&c, 2.0), std::pair(&d, 1.0)})
            s = moved(s, *slope, h * weight / 6);
    }
    return s.place;
}

} // namespace bench
