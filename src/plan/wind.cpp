#include "taut/plan/wind.hpp"

#include "taut/plan/grouping.hpp"
#include "taut/plan/material.hpp"
#include "taut/plan/springs.hpp"
#include "taut/kernels/wind.hpp"
#include "taut/kernels/wind_pressure.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

/// The area of each triangle of a body at rest, m^2.
std::vector<double> areas(const Mesh& mesh)
{
    std::vector<double> out;
    for (const auto& [a, b, c] : mesh.triangles)
        out.push_back(0.5 * glm::length(glm::cross(mesh.positions[b] - mesh.positions[a],
                                                   mesh.positions[c] - mesh.positions[a])));
    return out;
}

/// Triangles of a body in plan vertices. What a vertex weighs is shared by area among its triangles, so that
/// the masses of all triangles fit into it; a triangle counts three times its least share.
template <typename Real>
void add_triangles(const PlanBuilder& b, std::size_t body, std::vector<layout::WindTriangle<Real>>& out)
{
    const Body& own = b.scene.bodies[body];
    const std::vector<double> mass = vertex_masses(own), area = areas(own.mesh);
    std::vector<double> around(mass.size(), 0);
    for (std::size_t t = 0; t < area.size(); ++t)
        for (const std::uint32_t v : own.mesh.triangles[t])
            around[v] += area[t];
    for (std::size_t t = 0; t < area.size(); ++t)
    {
        const auto& corners = own.mesh.triangles[t];
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t v : corners)
            least = std::min(least, mass[v] * area[t] / around[v]);
        if (area[t] > 0)
            out.push_back({b.vertex(body, corners[0]), b.vertex(body, corners[1]),
                           b.vertex(body, corners[2]), 0, static_cast<Real>(3 * least),
                           static_cast<Real>(own.material.drag),
                           static_cast<Real>(own.material.friction_drag)});
    }
}

} // namespace

bool catches_air(const Body& body)
{
    return (body.material.drag > 0 || body.material.friction_drag > 0) && !body.mesh.triangles.empty();
}

bool wants_wind(const Scene& scene)
{
    return scene.wind.density > 0 && std::any_of(scene.bodies.begin(), scene.bodies.end(), catches_air);
}

void prepare_wind(PlanBuilder& b)
{
    with_real(b.plan.precision, [&](auto zero) {
        using Real = decltype(zero);
        std::vector<layout::WindTriangle<Real>> triangles;
        for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
            if (catches_air(b.scene.bodies[body]))
                add_triangles(b, body, triangles);
        b.wind_triangle_count = static_cast<std::uint32_t>(triangles.size());
        if (triangles.empty())
            return;
        std::vector<std::uint32_t> corners;
        for (const auto& t : triangles)
            corners.insert(corners.end(), {t.a, t.b, t.c});
        Incidence at = triangles_at(b, "wind", corners);
        for (std::uint32_t& entry : at.entries)
            entry /= 3;
        b.wind_triangles = b.add_buffer<layout::WindTriangle<Real>>("wind", "wind triangles", triangles);
        b.wind_start = b.add_buffer<std::uint32_t>("wind", "triangles at a vertex, start", at.start);
        b.wind_incident = b.add_buffer<std::uint32_t>("wind", "triangles at a vertex", at.entries);
        b.wind_impulse = b.add_buffer("wind", "wind impulses", triangles.size() * 4 * sizeof(Real));
        b.plan.wind = b.add_buffer("wind", "wind", sizeof(layout::WindValues<Real>));
        b.plan.buffers[b.plan.wind].host_written = true;
    });
}

void record_wind(PlanBuilder& b, const Moment& moment)
{
    const std::uint32_t triangles = b.wind_triangle_count;
    if (triangles == 0)
        return;
    const kernels::wind_pressure::Bindings<Use> pressure = {.triangle = {b.wind_triangles},
                                                            .position = {b.plan.position, 3},
                                                            .velocity = {b.plan.velocity, 3},
                                                            .step_values = {b.plan.step_values, 0},
                                                            .wind = {b.plan.wind, 0},
                                                            .impulse = {b.wind_impulse}};
    b.dispatch("wind", "", pressure, {triangles, moment.substep, b.plan.substeps}, triangles);
    const kernels::wind::Bindings<Use> gather = {.first = {b.wind_start},
                                                 .incident = {b.wind_incident, 6},
                                                 .impulse = {b.wind_impulse, 6},
                                                 .position = {b.plan.position},
                                                 .velocity = {b.plan.velocity}};
    b.dispatch("wind", "", gather, {b.plan.vertex_count}, b.plan.vertex_count);
}

} // namespace taut
