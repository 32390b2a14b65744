// Based on: Griewank, Walther. Evaluating Derivatives. 2nd ed. 2008, 3.1 (dual numbers, over the energy of
//   elements/membrane.hpp).
// Departures: none.
#include "taut/report/static_membranes.hpp"

#include "taut/elements/membrane.hpp"

#include <array>

namespace taut::reference {
namespace {

std::array<Real, 3> edge(const AddedElement& e, const State& x, std::size_t corner)
{
    const Vec<Real> d = x[e.vertex[corner]] - x[e.vertex[0]];
    return {d.x, d.y, d.z};
}

} // namespace

bool is_membrane(const AddedElement& element) { return is_own(*element.kind); }

Real membrane_energy(const AddedElement& element, const State& x)
{
    return taut::membrane_energy(edge(element, x, 1), edge(element, x, 2), element.values);
}

void add_membrane_gradient(const AddedElement& element, const State& x, State& g)
{
    using Number = Dual<6, Real>;
    std::array<std::array<Number, 3>, 2> edges;
    for (std::size_t e = 0; e < 2; ++e)
    {
        const std::array<Real, 3> at = edge(element, x, e + 1);
        for (std::size_t k = 0; k < 3; ++k)
        {
            edges[e][k].v = at[k];
            edges[e][k].d[3 * e + k] = 1;
        }
    }
    const auto slope = taut::membrane_energy(edges[0], edges[1], element.values).d;
    for (std::size_t e = 0; e < 2; ++e)
    {
        const Vec<Real> part{slope[3 * e], slope[3 * e + 1], slope[3 * e + 2]};
        g[element.vertex[e + 1]] = g[element.vertex[e + 1]] + part;
        g[element.vertex[0]] = g[element.vertex[0]] - part;
    }
}

} // namespace taut::reference
