#include "taut/report/gas.hpp"

#include "taut/plan/surface.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr double kLeastShare = 0.01; ///< of V0, below which the pressure grows no more

/// p at a volume V, Pa.
double pressure_at(const GasElement& gas, double volume)
{
    return gas.isothermal ? gas.pressure / std::max(volume / gas.rest_volume, kLeastShare) : gas.pressure;
}

} // namespace

bool has_gas(const Body& body)
{
    return body.material.pressure != 0 && !body.mesh.triangles.empty();
}

GasElement gas_element(const Body& body, std::uint32_t first)
{
    GasElement out;
    out.triangles = body.mesh.triangles;
    out.rest_volume = enclosed_volume(body.mesh.triangles, body.mesh.positions);
    out.pressure = out.rest_volume < 0 ? -body.material.pressure : body.material.pressure;
    out.isothermal = body.material.pressure_law == PressureLaw::isothermal;
    for (auto& triangle : out.triangles)
        for (std::uint32_t& v : triangle)
            v += first;
    return out;
}

double gas_energy(const GasElement& gas, std::span<const glm::dvec3> x)
{
    const double volume = enclosed_volume(gas.triangles, x);
    if (!gas.isothermal)
        return -gas.pressure * volume;
    const double share = volume / gas.rest_volume, work = gas.pressure * gas.rest_volume;
    if (share >= kLeastShare)
        return -work * std::log(share);
    return -work * (std::log(kLeastShare) + (share - kLeastShare) / kLeastShare);
}

void add_gas_forces(const GasElement& gas, std::span<const glm::dvec3> x, std::span<glm::dvec3> out)
{
    add_volume_gradient(gas.triangles, x, pressure_at(gas, enclosed_volume(gas.triangles, x)), out);
}

void add_stiffness(const GasElement& gas, std::span<const glm::dvec3> x, std::span<double> rows)
{
    const double volume = enclosed_volume(gas.triangles, x), push = std::abs(pressure_at(gas, volume));
    // Where V turns: the force on corner a of (a, b, c) is p/6 (b x c). By a closed surface corners may be
    // counted from any point; the vertex itself makes both terms short.
    for (const auto& t : gas.triangles)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t other = 1; other < 3; ++other)
                rows[t[c]] += push / 6 * glm::distance(x[t[(c + other) % 3]], x[t[c]]);
    if (!gas.isothermal || volume / gas.rest_volume < kLeastShare)
        return;
    // Where p changes with V: dp/dV = -p / V, a block of rank one.
    std::vector<glm::dvec3> slope(x.size(), glm::dvec3(0));
    add_volume_gradient(gas.triangles, x, 1, slope);
    double sum = 0;
    for (const glm::dvec3& g : slope)
        sum += glm::length(g);
    for (std::size_t v = 0; v < x.size(); ++v)
        rows[v] += push / std::abs(volume) * glm::length(slope[v]) * sum;
}

} // namespace taut
