// A gas within closed surfaces, as a force.
//
// Based on: kernels/volume/surface_volume_sum.comp, pressure.comp.
// Departures: none beyond those named there.

#include "taut/plan/pressure.hpp"

#include "taut/kernels/pressure.hpp"
#include "taut/kernels/surface_volume_sum.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/plan/surface.hpp"
#include "taut/plan/surface_volume.hpp"
#include "taut/runtime/base/shown.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {
namespace {

constexpr const char* kPressureEffect = "pressure";

bool has_gas(const Body& body) { return body.material.pressure != 0 && !body.mesh.triangles.empty(); }

bool is_isothermal(const Body& body) { return body.material.pressure_law == PressureLaw::isothermal; }

/// What explicit steps of this length cannot follow.
void warn_of_stiffness(PlanBuilder& b, std::size_t body)
{
    const double h = b.plan.timestep / b.plan.substeps, rate = pressure_rate(b.scene.bodies[body]);
    if (!(rate * h * h > 4))
        return;
    b.plan.warnings.push_back(
        {"energy_growth", 1,
         "bodies[" + std::to_string(body) +
             "].material.pressure: the gas may move the lightest vertex faster than substeps of " +
             shown(h, 3) + " s can follow; " + shown(std::ceil(b.plan.timestep * std::sqrt(rate) / 2), 6) +
             " substeps would be safe, or a lower pressure, or a heavier surface"});
}

} // namespace

bool wants_pressure(const Scene& scene)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), has_gas);
}

void check_pressure(const Scene& scene, Refusals& out)
{
    out.attempt_bodies(scene, [](const Body& body, std::size_t k) {
        if (body.material.pressure != 0)
            check_surface(body, "bodies[" + std::to_string(k) + "].material.pressure is not 0", "pressure");
    });
}

double pressure_rate(const Body& body)
{
    const std::vector<glm::dvec3>& x = body.mesh.positions;
    const std::vector<double> mass = vertex_masses(body);
    // f_a = p/6 sum b x c over the triangles (a, b, c): each moves with p/6 times the edge across.
    std::vector<double> row(x.size(), 0);
    std::vector<glm::dvec3> gradient(x.size(), glm::dvec3(0));
    for (const auto& t : body.mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k)
        {
            const glm::dvec3 to_next = x[t[(k + 1) % 3]] - x[t[k]], to_last = x[t[(k + 2) % 3]] - x[t[k]];
            row[t[k]] += (glm::length(to_next) + glm::length(to_last)) / 6;
            gradient[t[k]] += glm::cross(to_next, to_last) / 6.0;
        }
    double worst = 0, weight = 0;
    for (std::size_t v = 0; v < x.size(); ++v)
    {
        worst = std::max(worst, row[v] / mass[v]);
        weight += glm::dot(gradient[v], gradient[v]) / mass[v];
    }
    const double volume = std::abs(enclosed_volume(body.mesh.triangles, x));
    return std::abs(body.material.pressure) * (worst + (is_isothermal(body) ? weight / volume : 0));
}

void prepare_pressure(PlanBuilder& b)
{
    const SurfaceTables tables = surface_tables(b, has_gas, "pressure");
    SurfaceBuffers& s = b.gas;
    add_surface_tables(b, kPressureEffect, tables, s);
    if (s.groups == 0)
        return;
    std::vector<double> values;
    for (const std::size_t body : tables.bodies)
    {
        const Body& own = b.scene.bodies[body];
        const double rest = enclosed_volume(own.mesh.triangles, own.mesh.positions);
        values.insert(values.end(), {rest, rest < 0 ? -own.material.pressure : own.material.pressure,
                                     is_isothermal(own) ? 1.0 : 0.0});
        warn_of_stiffness(b, body);
    }
    with_real(b.plan.precision, [&](auto zero) {
        const std::vector<decltype(zero)> kept(values.begin(), values.end());
        s.values = b.add_buffer<decltype(zero)>(kPressureEffect, "gases", kept);
    });
}

void record_pressure(PlanBuilder& b, const Moment& moment)
{
    const SurfaceBuffers& s = b.gas;
    if (s.groups == 0)
        return;
    record_surface_sums(b, kPressureEffect, s, false);
    const kernels::pressure::Bindings<Use> push = {.table = {s.table, 2},
                                                   .surface = {s.values},
                                                   .gradient = {s.gradient},
                                                   .partials = {s.partials},
                                                   .step_values = {b.plan.step_values, 0},
                                                   .velocity = {b.plan.velocity},
                                                   .events = {b.plan.events, 0}};
    b.dispatch(kPressureEffect, "", push, {s.groups, moment.substep + 1 == b.plan.substeps}, s.groups,
               s.vertices);
}

} // namespace taut
