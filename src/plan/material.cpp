// Based on: Van Gelder, Approximate Simulation of Elastic Membranes by Triangulated Spring Meshes, 1998
//   (k = Y (A0 + A1) / L^2); Seung and Nelson, Defects in flexible membranes, 1988 (both moduli of the
//   equilateral lattice); Bridson, Marino, Fedkiw, Simulation of Clothing with Folds and Wrinkles, 2003
//   (the dihedral angle as the bending strain); Feng, Huang, Xu, Wang, Learning-Based Bending Stiffness
//   Parameter Estimation by a Drape Tester, 2022 (of woven cloth, stiffness by the direction across the
//   edge).
// Departures: Poisson's ratio is left out of k (a spring mesh has its own, near 1/3). The hinge has the
//   factor 1, k = B |e|^2 / (A0 + A1): exact for the equilateral lattice, and a cylinder along a grid of
//   right triangles then has 1/2 B kappa^2 (1 - 1/n) per area; the factor 3 often seen triples it.
#include "taut/plan/material.hpp"

#include "taut/plan/plate_hinges.hpp"
#include "taut/plan/topology.hpp"
#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

namespace taut {
namespace {

double triangle_area(const Mesh& mesh, std::uint32_t triangle)
{
    const auto& [a, b, c] = mesh.triangles[triangle];
    const std::vector<glm::dvec3>& x = mesh.positions;
    return 0.5 * glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
}

double area_of(const Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
    const std::vector<glm::dvec3>& x = mesh.positions;
    return 0.5 * glm::length(glm::cross(x[b] - x[a], x[c] - x[a]));
}

/// Vertices without cloth still need inertia: the mean of the others, or a strip as large as the shape says.
void fill_missing(std::vector<double>& mass, const Body& body)
{
    double total = 0;
    std::size_t have = 0;
    for (double m : mass)
    {
        total += m;
        have += m > 0;
    }
    const double alone = body.material.density * body.shape.length * body.shape.width;
    const double value = have > 0 ? total / static_cast<double>(have) : alone;
    std::replace_if(mass.begin(), mass.end(), [](double m) { return !(m > 0); }, value);
}

void append_edges(std::vector<StretchElement>& out, const Mesh& mesh, double modulus)
{
    out.reserve(out.size() + 3 * mesh.triangles.size() / 2 + mesh.positions.size() / 100);
    each_edge(mesh, [&](std::uint32_t a, std::uint32_t b, std::span<const std::uint32_t> triangles) {
        const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
        double area = 0;
        for (const std::uint32_t t : triangles)
            area += triangle_area(mesh, t);
        if (!triangles.empty() && (!(length > 0) || area > 0))
            out.push_back({a, b, length, length > 0 ? length * length / (modulus * area) : 0.0});
    });
}

void append_links(std::vector<StretchElement>& out, const Mesh& mesh, double modulus)
{
    for (const auto& [a, b] : mesh.links)
    {
        const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
        if (length > 0 && !(mesh.link_width > 0))
            continue;
        out.push_back({a, b, length, length > 0 ? length / (modulus * mesh.link_width) : 0.0});
    }
}

/// Each edge with the volume round it, m^3, by (a, b).
std::map<std::array<std::uint32_t, 2>, double> edge_volumes(const Mesh& mesh)
{
    std::map<std::array<std::uint32_t, 2>, double> out;
    for (const auto& t : mesh.tetrahedra)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = i + 1; j < 4; ++j)
                out[{std::min(t[i], t[j]), std::max(t[i], t[j])}] += six_volumes(mesh.positions, t) / 6;
    return out;
}

void append_solid_edges(std::vector<StretchElement>& out, const Mesh& mesh, double modulus)
{
    for (const auto& [edge, volume] : edge_volumes(mesh))
    {
        const double length = glm::distance(mesh.positions[edge[0]], mesh.positions[edge[1]]);
        out.push_back({edge[0], edge[1], length, length * length / (modulus * volume)});
    }
}

bool of_springs(const Body& body)
{
    return !body.mesh.tetrahedra.empty() && body.material.model == SolidModel::springs;
}

} // namespace

bool has_springs(const Body& body)
{
    return body.material.stretch_stiffness > 0 || of_springs(body) || !body.springs.empty();
}

std::vector<double> vertex_masses(const Body& body)
{
    const Mesh& mesh = body.mesh;
    if (!body.vertex_masses.empty())
    {
        assert(body.vertex_masses.size() == mesh.positions.size());
        return body.vertex_masses;
    }
    std::vector<double> mass(mesh.positions.size(), 0.0);
    for (const auto& t : mesh.tetrahedra)
        for (std::uint32_t v : t)
            mass[v] += body.material.density * six_volumes(mesh.positions, t) / 24;
    for (std::uint32_t t = 0; t < mesh.triangles.size() && mesh.tetrahedra.empty(); ++t)
        for (std::uint32_t v : mesh.triangles[t])
            mass[v] += body.material.density * triangle_area(mesh, t) / 3;
    for (const auto& [a, b] : mesh.links)
    {
        const double length = glm::distance(mesh.positions[a], mesh.positions[b]);
        const double half = 0.5 * body.material.density * length * mesh.link_width;
        mass[a] += half;
        mass[b] += half;
    }
    fill_missing(mass, body);
    return mass;
}

std::vector<StretchElement> stretch_elements(const Body& body)
{
    std::vector<StretchElement> out;
    const double modulus = body.material.stretch_stiffness;
    if (modulus > 0 && !(body.shape.kind == ShapeKind::grid && body.shape.network.used))
    {
        append_edges(out, body.mesh, modulus);
        append_links(out, body.mesh, modulus);
    }
    if (of_springs(body))
        append_solid_edges(out, body.mesh, body.material.youngs_modulus);
    out.reserve(out.size() + body.springs.size());
    for (const Body::Spring& s : body.springs)
        out.push_back({s.a, s.b, s.rest_length, s.compliance, s.kind});
    for (StretchElement& e : out)
        e.damping = e.compliance > 0 ? body.material.stretch_damping / e.compliance : 0;
    return out;
}

namespace {

/// N m of each hinge of one body: one value, or that of the direction in which the sheet curves there.
class HingeRigidity
{
public:
    explicit HingeRigidity(const Body& body)
        : body_(body),
          one_(body.material.bending_stiffness)
    {
        const Fabric& fabric = body.material.fabric;
        if (one_ > 0 || !fabric.used || !fabric.bending.used)
            return;
        by_direction_ = fabric_rigidity(fabric.bending);
        const std::vector<glm::dvec3> warp = scene_file::warp_directions(body);
        for (std::size_t t = 0; t < warp.size(); ++t)
            warp_.emplace(sorted(body.mesh.triangles[t]), warp[t]);
    }

    bool any() const { return one_ > 0 || !warp_.empty(); }

    /// The mean over both triangles; within each, the sheet curves across the edge.
    double of(const Hinge& h) const
    {
        if (one_ > 0)
            return one_;
        return (at(h.edge0, h.edge1, h.wing0) + at(h.edge0, h.edge1, h.wing1)) / 2;
    }

private:
    using Corners = std::array<std::uint32_t, 3>;

    static Corners sorted(Corners corners)
    {
        std::sort(corners.begin(), corners.end());
        return corners;
    }

    double at(std::uint32_t edge0, std::uint32_t edge1, std::uint32_t wing) const
    {
        const std::vector<glm::dvec3>& x = body_.mesh.positions;
        const double along = glm::dot(glm::normalize(x[edge1] - x[edge0]),
                                      warp_.at(sorted({edge0, edge1, wing})));
        return by_direction_.along(std::clamp(1 - along * along, 0.0, 1.0));
    }

    const Body& body_;
    double one_;
    FabricRigidity by_direction_;
    std::map<Corners, glm::dvec3> warp_; ///< by the corners of its triangle
};

} // namespace

std::vector<BendElement> bend_elements(const Body& body, std::size_t* dropped)
{
    std::vector<BendElement> out;
    if (is_plate(body))
    {
        for (const PlateHinge& h : plate_hinges(body, dropped))
            out.push_back(h.element);
        return out;
    }
    std::size_t lost = 0;
    const HingeRigidity rigidity(body);
    if (rigidity.any())
        for (const Hinge& h : mesh_hinges(body.mesh))
        {
            const std::vector<glm::dvec3>& x = body.mesh.positions;
            const glm::dvec3 e = x[h.edge1] - x[h.edge0];
            const double area0 = area_of(body.mesh, h.edge0, h.edge1, h.wing0);
            const double area1 = area_of(body.mesh, h.edge0, h.edge1, h.wing1);
            if (!(area0 > 0) || !(area1 > 0) || h.wing0 == h.wing1)
            {
                ++lost;
                continue;
            }
            out.push_back({h.edge0, h.edge1, h.wing0, h.wing1,
                           dihedral_angle(x[h.edge0], x[h.edge1], x[h.wing0], x[h.wing1]),
                           (area0 + area1) / (rigidity.of(h) * glm::dot(e, e))});
        }
    if (dropped)
        *dropped = lost;
    return out;
}

double dihedral_angle(const glm::dvec3& x0, const glm::dvec3& x1, const glm::dvec3& x2, const glm::dvec3& x3)
{
    const glm::dvec3 e = x1 - x0;
    const glm::dvec3 n1 = glm::cross(e, x2 - x0);
    const glm::dvec3 n2 = glm::cross(x3 - x0, e);
    const double length = glm::length(e);
    if (!(length > 0))
        return 0;
    return std::atan2(glm::dot(glm::cross(n1, n2), e) / length, glm::dot(n1, n2));
}

} // namespace taut
