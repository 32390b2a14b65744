#include "taut/report/model.hpp"

#include "taut/report/element_rates.hpp"
#include "taut/report/hinge.hpp"
#include "taut/report/plate_energy.hpp"
#include "taut/report/time_series.hpp"
#include "taut/scene/faces.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

namespace taut {
namespace {

using reference::Vec;

Vec<double> vec(const glm::dvec3& a) { return {a.x, a.y, a.z}; }

std::array<Vec<double>, 4> corners(const BendElement& h, std::span<const glm::dvec3> x)
{
    return {vec(x[h.edge0]), vec(x[h.edge1]), vec(x[h.wing0]), vec(x[h.wing1])};
}

void append_vertices(PhysicalModel& model, const Body& body)
{
    const std::vector<double> mass = vertex_masses(body);
    const std::vector<glm::dvec3>& start = start_of(body);
    assert(start.size() == body.mesh.positions.size());
    model.mass.insert(model.mass.end(), mass.begin(), mass.end());
    model.start.insert(model.start.end(), start.begin(), start.end());
    model.gap.resize(model.mass.size(), body.material.thickness);
    model.velocity.resize(model.mass.size(), body.velocity);
    model.pinned.resize(model.mass.size(), false);
    model.weightless.resize(model.mass.size(), body.kinematic.used);
    model.flows.resize(model.mass.size(), body.material.plastic_yield > 0);
}

void append_elements(PhysicalModel& model, const Body& body, std::uint32_t first)
{
    std::size_t dropped = 0;
    const auto moved = [first](BendElement h) {
        for (std::uint32_t* v : {&h.edge0, &h.edge1, &h.wing0, &h.wing1})
            *v += first;
        return h;
    };
    if (is_plate(body))
    {
        const auto before = static_cast<std::uint32_t>(2 * model.plates.size());
        for (PlateHinge h : plate_hinges(body, &dropped))
        {
            h.element = moved(h.element);
            for (std::uint32_t& n : h.neighbour)
                n += before;
            model.plates.push_back(h);
        }
    }
    else
        for (const BendElement& h : bend_elements(body, &dropped))
            model.hinges.push_back(moved(h));
    model.dropped_hinges += dropped;
    const auto append = [first](auto elements, auto& out) {
        for (auto& e : elements)
        {
            for (std::uint32_t& v : e.vertex)
                v += first;
            out.push_back(e);
        }
    };
    append(volume_elements(body), model.volumes);
    append(solid_elements(body), model.solids);
    if (has_gas(body))
        model.gases.push_back(gas_element(body, first));
    if (!holds_surface_volume(body))
        return;
    model.surfaces.push_back(surface_element(body));
    for (auto& triangle : model.surfaces.back().triangles)
        for (std::uint32_t& v : triangle)
            v += first;
}

/// The first pin that names a vertex holds it.
void append_pins(PhysicalModel& model, const Body& body, std::uint32_t first)
{
    std::map<std::uint32_t, const Pin*> held;
    for (const Pin& pin : body.pins)
        for (std::uint32_t v : pin.vertices)
            held.emplace(v, &pin);
    for (const auto& [v, pin] : held)
    {
        model.pins.push_back({first + v, pin->motion});
        model.pinned[first + v] = true;
        model.velocity[first + v] = glm::dvec3(0);
    }
}

} // namespace

double rest_diameter(const Scene& scene)
{
    constexpr double kFar = std::numeric_limits<double>::infinity();
    glm::dvec3 low(kFar), high(-kFar);
    for (const Body& body : scene.bodies)
        for (const glm::dvec3& x : body.mesh.positions)
        {
            low = glm::min(low, x);
            high = glm::max(high, x);
        }
    return low.x <= high.x ? glm::distance(low, high) : 0;
}

PhysicalModel make_model(const Scene& resolved)
{
    PhysicalModel model;
    model.gravity = resolved.gravity;
    model.damping = resolved.damping;
    model.max_speed = resolved.max_speed;
    model.timestep = resolved.timestep;
    model.duration = resolved.duration;
    model.colliders = resolved.colliders;
    for (const Body& body : resolved.bodies)
    {
        SurfaceRule rule(body);
        for (const Collider& collider : resolved.colliders)
            model.faces_meet = model.faces_meet || rule.meets(collider);
    }
    model.diameter = rest_diameter(resolved);
    model.springs = scene_springs(resolved);
    model.added = scene_elements(resolved);
    for (const Body& body : resolved.bodies)
    {
        const auto first = static_cast<std::uint32_t>(model.mass.size());
        model.body_start.push_back(first);
        append_vertices(model, body);
        append_elements(model, body, first);
        append_pins(model, body, first);
    }
    model.body_start.push_back(static_cast<std::uint32_t>(model.mass.size()));
    return model;
}

namespace {

using Corners = std::array<glm::dvec3, 4>;

Corners corners_of(const AddedElement& e, std::span<const glm::dvec3> x)
{
    Corners out{};
    for (std::uint32_t c = 0; c < e.kind->corners; ++c)
        out[c] = x[e.vertex[c]];
    return out;
}

double energy_of(const AddedElement& e, const Corners& corner)
{
    return e.kind->energy(std::span(corner).first(e.kind->corners), e.values);
}

} // namespace

std::vector<AddedElement> body_elements(const Body& body, std::uint32_t first)
{
    std::vector<AddedElement> out;
    for (const Body::Elements& list : body.elements)
    {
        const ElementKind* kind = find_element(list.kind);
        const std::size_t corners = kind->corners, values = kind->values.size();
        for (std::size_t k = 0; k < list.vertices.size() / corners; ++k)
        {
            AddedElement e;
            e.kind = kind;
            for (std::size_t c = 0; c < corners; ++c)
                e.vertex[c] = first + list.vertices[k * corners + c];
            const auto own = std::span(list.values).subspan(k * values, values);
            e.values.assign(own.begin(), own.end());
            out.push_back(std::move(e));
        }
    }
    return out;
}

std::vector<AddedElement> scene_elements(const Scene& resolved)
{
    std::vector<AddedElement> out;
    std::uint32_t first = 0;
    for (const Body& body : resolved.bodies)
    {
        std::ranges::move(body_elements(body, first), std::back_inserter(out));
        first += static_cast<std::uint32_t>(body.mesh.positions.size());
    }
    return out;
}

double AddedElement::energy(std::span<const glm::dvec3> x) const
{
    return energy_of(*this, corners_of(*this, x));
}

Corners AddedElement::forces(std::span<const glm::dvec3> x) const
{
    const Corners here = corners_of(*this, x);
    double size = 0;
    for (std::uint32_t c = 1; c < kind->corners; ++c)
        size = std::max(size, glm::distance(here[c], here[0]));
    const double step = 1e-5 * size;
    Corners out{};
    for (std::uint32_t c = 0; step > 0 && c < kind->corners; ++c)
        for (int axis = 0; axis < 3; ++axis)
        {
            Corners ahead = here, behind = here;
            ahead[c][axis] += step;
            behind[c][axis] -= step;
            out[c][axis] =
                (energy_of(*this, behind) - energy_of(*this, ahead)) / (ahead[c][axis] - behind[c][axis]);
        }
    return out;
}

std::optional<std::array<double, 2>> AddedElement::stretches(std::span<const glm::dvec3> x) const
{
    if (kind->stretches == nullptr)
        return {};
    const Corners corner = corners_of(*this, x);
    return kind->stretches(std::span(corner).first(kind->corners), values);
}

double bend_angle(const BendElement& element, std::span<const glm::dvec3> x)
{
    const auto hinge = reference::hinge_angle(corners(element, x));
    return hinge.valid ? reference::angle_difference(hinge.angle, element.rest_angle) : 0;
}

double bending_energy(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    double energy = plate_energy(model.plates, x);
    for (const BendElement& h : model.hinges)
        if (const double angle = bend_angle(h, x); angle != 0)
            energy += 0.5 * angle * angle / h.compliance;
    return energy;
}

double elastic_energy(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    double energy = 0;
    for (const StretchElement& s : model.springs)
    {
        const double stretch = glm::distance(x[s.a], x[s.b]) - s.rest_length;
        if (stretch != 0)
            energy += 0.5 * stretch * stretch / s.compliance;
    }
    energy += bending_energy(model, x);
    for (const VolumeElement& e : model.volumes)
    {
        const double change = volume_of(e.vertex, x) - e.rest_volume;
        if (change != 0)
            energy += 0.5 * change * change / e.compliance;
    }
    for (const SolidElement& e : model.solids)
        energy += solid_energy(e, x);
    for (const SurfaceElement& e : model.surfaces)
    {
        const double change = enclosed_volume(e.triangles, x) - e.rest_volume;
        if (change != 0)
            energy += 0.5 * change * change / e.compliance;
    }
    for (const AddedElement& e : model.added)
        energy += e.energy(x);
    return energy;
}

double gas_energy(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    double energy = 0;
    for (const GasElement& gas : model.gases)
        energy += gas_energy(gas, x);
    return energy;
}

double gravity_energy(const PhysicalModel& model, std::span<const glm::dvec3> x)
{
    double energy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        energy -= model.weightless[i] ? 0 : model.mass[i] * glm::dot(model.gravity, x[i]);
    return energy;
}

namespace {

/// `torque`: J, along the angle's gradients.
template <typename Add>
void add_torque(const BendElement& h, const reference::HingeAngle<double>& hinge, double torque, Add add)
{
    const std::uint32_t vertex[4] = {h.edge0, h.edge1, h.wing0, h.wing1};
    for (std::size_t c = 0; c < 4; ++c)
    {
        const Vec<double>& g = hinge.gradient[c];
        add(vertex[c], torque * glm::dvec3(g.x, g.y, g.z));
    }
}

/// Calls add(vertex, force) with what each compliant element does to each of its vertices.
template <typename Add>
void each_force(const PhysicalModel& model, std::span<const glm::dvec3> x, Add add)
{
    for (const StretchElement& s : model.springs)
    {
        const glm::dvec3 d = x[s.a] - x[s.b];
        const double length = glm::length(d);
        if (!(length > 0) || !(s.compliance > 0))
            continue;
        const glm::dvec3 f = ((length - s.rest_length) / (s.compliance * length)) * d;
        add(s.a, -f);
        add(s.b, f);
    }
    for (const BendElement& h : model.hinges)
    {
        const auto hinge = reference::hinge_angle(corners(h, x));
        if (!hinge.valid || !(h.compliance > 0))
            continue;
        add_torque(h, hinge, -reference::angle_difference(hinge.angle, h.rest_angle) / h.compliance, add);
    }
    const std::vector<double> moments = plate_moments(model.plates, x);
    for (std::size_t k = 0; k < moments.size(); ++k)
        if (const auto hinge = reference::hinge_angle(corners(model.plates[k].element, x)); hinge.valid)
            add_torque(model.plates[k].element, hinge, -moments[k], add);
    for (const VolumeElement& e : model.volumes)
    {
        if (!(e.compliance > 0))
            continue;
        const double pressure = -(volume_of(e.vertex, x) - e.rest_volume) / e.compliance;
        const std::array<glm::dvec3, 4> gradient = volume_gradient(e.vertex, x);
        for (std::size_t c = 0; c < 4; ++c)
            add(e.vertex[c], pressure * gradient[c]);
    }
    for (const SolidElement& e : model.solids)
    {
        const std::array<glm::dvec3, 4> force = solid_forces(e, x);
        for (std::size_t c = 0; c < 4; ++c)
            add(e.vertex[c], force[c]);
    }
    for (const AddedElement& e : model.added)
    {
        const Corners force = e.forces(x);
        for (std::uint32_t c = 0; c < e.kind->corners; ++c)
            add(e.vertex[c], force[c]);
    }
}

/// Of enclosed volumes and gases, which act on a whole surface.
void add_surface_forces(const PhysicalModel& model, std::span<const glm::dvec3> x,
                        std::vector<glm::dvec3>& out)
{
    for (const SurfaceElement& e : model.surfaces)
        if (e.compliance > 0)
            add_volume_gradient(e.triangles, x,
                                (e.rest_volume - enclosed_volume(e.triangles, x)) / e.compliance, out);
    for (const GasElement& gas : model.gases)
        add_gas_forces(gas, x, out);
}

} // namespace

void add_forces(const PhysicalModel& model, std::span<const glm::dvec3> x, std::vector<glm::dvec3>& out)
{
    for (std::size_t i = 0; i < x.size(); ++i)
        out[i] += model.mass[i] * model.gravity;
    each_force(model, x, [&](std::uint32_t v, const glm::dvec3& f) { out[v] += f; });
    add_surface_forces(model, x, out);
}

void add_force_sizes(const PhysicalModel& model, std::span<const glm::dvec3> x, std::vector<double>& out)
{
    std::vector<glm::dvec3> surface(x.size(), glm::dvec3(0));
    add_surface_forces(model, x, surface);
    for (std::size_t i = 0; i < x.size(); ++i)
        out[i] += glm::length(surface[i]) + model.mass[i] * glm::length(model.gravity);
    each_force(model, x, [&](std::uint32_t v, const glm::dvec3& f) { out[v] += glm::length(f); });
}

} // namespace taut
