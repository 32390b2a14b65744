// Based on: Abramowitz, Stegun. Handbook of Mathematical Functions, 1964, 25.3.27 (the mixed second
//   derivative by six neighbours and the middle).
// Departures: none.
#include "taut/report/added_stiffness.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace taut::reference {
namespace {

/// An element's energy as a function of its corners alone.
class Local
{
public:
    Local(const AddedElement& element, std::span<const glm::dvec3> x) : element_(element)
    {
        for (std::uint32_t c = 0; c < element.kind->corners; ++c)
            corner_[c] = x[element.vertex[c]];
    }

    double size() const
    {
        double out = 0;
        for (std::uint32_t c = 1; c < element_.kind->corners; ++c)
            out = std::max(out, glm::distance(corner_[c], corner_[0]));
        return out;
    }

    /// J, with the unknowns r and s moved by `by`, one that is -1 by nothing.
    double moved(int r, int s, double by) const
    {
        std::array<glm::dvec3, 4> at = corner_;
        for (const int u : {r, s})
            if (u >= 0)
                at[static_cast<std::size_t>(u / 3)][u % 3] += by;
        return element_.kind->energy(std::span(at).first(element_.kind->corners), element_.values);
    }

private:
    const AddedElement& element_;
    std::array<glm::dvec3, 4> corner_{};
};

} // namespace

Eigen::MatrixXd added_stiffness(const AddedElement& element, std::span<const glm::dvec3> x)
{
    const int n = 3 * static_cast<int>(element.kind->corners);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
    const Local local(element, x);
    const double step = 1e-4 * local.size();
    if (!(step > 0))
        return out;
    const double middle = local.moved(-1, -1, 0);
    Eigen::VectorXd single(n); // J: the sum of both ways
    for (int r = 0; r < n; ++r)
        single[r] = local.moved(r, -1, step) + local.moved(r, -1, -step);
    for (int r = 0; r < n; ++r)
    {
        out(r, r) = (single[r] - 2 * middle) / (step * step);
        for (int s = 0; s < r; ++s)
            out(r, s) = out(s, r) =
                (local.moved(r, s, step) + local.moved(r, s, -step) - single[r] - single[s] + 2 * middle) /
                (2 * step * step);
    }
    return out;
}

} // namespace taut::reference
