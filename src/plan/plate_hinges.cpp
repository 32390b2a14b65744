// Based on: Hellan 1967, Herrmann 1967, Johnson, On the Convergence of a Mixed Finite-Element Method for
//   Plate Bending Problems, 1973: moments that are constant in a triangle and continuous along normals;
//   Arnold, Brezzi 1985: the same displacements as Morley's triangle; Neunteufel, Schoeberl, The
//   Hellan-Herrmann-Johnson Method for Nonlinear Shells, 2019: the angle between triangles is the curvature
//   at the edge.
// Departures: moments are eliminated, so that hinges with a matrix of compliances are left; the turns within
//   triangles are kept as a state (kernels/plate). A triangle whose corners are all held has no compliance.

#include "taut/plan/plate_hinges.hpp"

#include "taut/plan/topology.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/scene/held.hpp"
#include "taut/scene/membrane.hpp"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace taut {
namespace {

using TriangleCorners = std::array<std::uint32_t, 3>;
using Matrix = std::array<std::array<double, 3>, 3>;
constexpr std::uint32_t kNone = 0xffffffffu;

/// What one triangle has of its edges; edge i goes from corner i to the next.
struct Plate
{
    bool has_area = false, held = false;
    Matrix stiffness{}; ///< J/rad^2, against turns at its edges
    std::array<std::uint32_t, 3> hinge = {kNone, kNone, kNone};
    std::array<std::uint32_t, 3> side{};
    std::array<double, 3> sign{}; ///< of the hinge's angle as the triangle sees it
};

/// D of k^T D k / 2 an area, k = (curvature along u, along v, twist once), N m.
glm::dmat3 rigidity_of(const Material& material)
{
    const double nu = material.bending_poissons_ratio, one = material.bending_stiffness;
    FabricRigidity d{one, one, 2 * (1 - nu) * one, nu * one};
    if (!(one > 0))
        d = fabric_rigidity(material.fabric.bending, nu);
    return {{d.d11, d.d12, 0}, {d.d12, d.d22, 0}, {0, 0, d.d33}};
}

/// Along the warp where there is one.
glm::dvec3 first_axis(const Body& body, const std::vector<glm::dvec3>& warp, std::size_t t)
{
    if (!warp.empty())
        return warp[t];
    const auto& x = body.mesh.positions;
    const TriangleCorners& c = body.mesh.triangles[t];
    return glm::normalize(x[c[1]] - x[c[0]]);
}

/// K = L R D R^T L / A, L the lengths and R the rows (n_u^2, n_v^2, n_u n_v). As a product it keeps its sign
/// on slivers, whose compliance would be a difference of large numbers.
void fill_stiffness(const Body& body, const glm::dvec3& u, std::size_t t, const glm::dmat3& rigidity,
                    Plate& out)
{
    const auto& x = body.mesh.positions;
    const TriangleCorners& c = body.mesh.triangles[t];
    const glm::dvec3 up = glm::cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]]);
    const double area = glm::length(up) / 2;
    const glm::dvec3 v = glm::cross(up / (2 * area), u);
    std::array<glm::dvec3, 3> rows;
    for (int i = 0; i < 3; ++i)
    {
        const glm::dvec3 edge = x[c[(i + 1) % 3]] - x[c[i]];
        const double length = glm::length(edge);
        const double nu = glm::dot(edge, v) / length, nv = -glm::dot(edge, u) / length;
        rows[i] = glm::dvec3(nu * nu, nv * nv, nu * nv) * length;
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out.stiffness[i][j] = glm::dot(rows[i], rigidity * rows[j]) / area;
}

std::vector<Plate> plates_of(const Body& body)
{
    const auto& x = body.mesh.positions;
    const std::vector<bool> held = held_vertices(body);
    const glm::dmat3 rigidity = rigidity_of(body.material);
    const std::vector<glm::dvec3> warp =
        body.material.fabric.used ? scene_file::warp_directions(body) : std::vector<glm::dvec3>();
    std::vector<Plate> out(body.mesh.triangles.size());
    for (std::size_t t = 0; t < out.size(); ++t)
    {
        const TriangleCorners& c = body.mesh.triangles[t];
        out[t].has_area = glm::length(glm::cross(x[c[1]] - x[c[0]], x[c[2]] - x[c[0]])) > 0;
        out[t].held = held[c[0]] && held[c[1]] && held[c[2]];
        if (out[t].has_area && !out[t].held)
            fill_stiffness(body, first_axis(body, warp, t), t, rigidity, out[t]);
    }
    return out;
}

std::string edge_name(const Hinge& h)
{
    return "the edge between vertices " + std::to_string(h.edge0) + " and " + std::to_string(h.edge1);
}

/// Enters a hinge as side 0 or 1 at the edge of its triangle.
void enter(const Body& body, const Hinge& h, std::uint32_t hinge, std::uint32_t side, std::size_t t,
           Plate& plate)
{
    const TriangleCorners& c = body.mesh.triangles[t];
    for (std::uint32_t i = 0; i < 3; ++i)
    {
        const std::uint32_t a = c[i], b = c[(i + 1) % 3];
        const bool along = a == h.edge0 && b == h.edge1;
        if (!along && !(a == h.edge1 && b == h.edge0))
            continue;
        if (plate.hinge[i] != kNone)
            throw Error(ErrorCode::unsupported,
                        edge_name(h) + " has more than two triangles, which bend as no plate does; "
                                       "take bending_model \"hinge\"");
        plate.hinge[i] = hinge;
        plate.side[i] = side;
        plate.sign[i] = along == (side == 0) ? 1 : -1;
    }
}

/// Largest eigenvalue of the matrix scaled to a unit diagonal: one more than the largest root t of
/// t^3 - (a^2 + b^2 + c^2) t - 2 a b c, with a, b, c beside the diagonal.
double largest_scaled(const Matrix& k, std::size_t n)
{
    const auto scaled = [&](std::size_t i, std::size_t j) { return k[i][j] / std::sqrt(k[i][i] * k[j][j]); };
    if (n == 1)
        return 1;
    if (n == 2)
        return 1 + std::abs(scaled(0, 1));
    const double a = scaled(0, 1), b = scaled(1, 2), c = scaled(0, 2);
    const double third = (a * a + b * b + c * c) / 3, product = a * b * c;
    // Newton's method from above, since arc cosines are not the same on every machine.
    double t = 2;
    for (int i = 0; i < 60 && t * t > third * (1 + 1e-12); ++i)
        t -= ((t * t - 3 * third) * t - 2 * product) / (3 * (t * t - third));
    return 1 + t;
}

/// Of the edges that have a hinge, in their order: those without one turn freely (Schur's complement).
Matrix stiffness_of(const Plate& plate, const std::vector<int>& edges)
{
    constexpr double kLeast = 1e-9; // of a diagonal: what rounding leaves of slivers must not turn its sign
    Matrix k = plate.stiffness;
    for (int free = 0; free < 3; ++free)
    {
        if (plate.hinge[free] != kNone)
            continue;
        const Matrix before = k;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                k[i][j] -= before[i][free] * before[free][j] / std::max(before[free][free], 1e-300);
    }
    Matrix out{};
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < edges.size(); ++j)
            out[i][j] = k[edges[i]][edges[j]] * plate.sign[edges[i]] * plate.sign[edges[j]];
    for (std::size_t i = 0; i < edges.size(); ++i)
        out[i][i] = std::max(out[i][i], 0.0) + kLeast * plate.stiffness[edges[i]][edges[i]];
    return out;
}

/// By columns of the unit matrix (Gauss, symmetric and positive definite: no pivots).
Matrix inverse_of(Matrix k, std::size_t n)
{
    Matrix out{};
    for (std::size_t i = 0; i < n; ++i)
        out[i][i] = 1;
    for (std::size_t p = 0; p < n; ++p)
    {
        const double pivot = k[p][p];
        for (std::size_t j = 0; j < n; ++j)
        {
            k[p][j] /= pivot;
            out[p][j] /= pivot;
        }
        for (std::size_t i = 0; i < n; ++i)
        {
            const double factor = i == p ? 0 : k[i][p];
            for (std::size_t j = 0; j < n; ++j)
            {
                k[i][j] -= factor * k[p][j];
                out[i][j] -= factor * out[p][j];
            }
        }
    }
    return out;
}

/// Adds what a triangle has of its hinges.
void add_side(const Plate& plate, std::vector<PlateHinge>& out, std::vector<std::array<double, 2>>& soft)
{
    std::vector<int> edges;
    for (int i = 0; i < 3; ++i)
        if (plate.hinge[i] != kNone)
            edges.push_back(i);
    if (edges.empty() || plate.held)
        return;
    const Matrix k = stiffness_of(plate, edges), c = inverse_of(k, edges.size());
    const double most = largest_scaled(k, edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        const int edge = edges[i];
        PlateHinge& h = out[plate.hinge[edge]];
        const std::uint32_t side = plate.side[edge];
        soft[plate.hinge[edge]][side] = 1 / (most * k[i][i]);
        h.softness += c[i][i];
        h.pull[side][0] = 1 - 1 / most;
        std::size_t next = 0;
        for (std::size_t j = 0; j < edges.size(); ++j)
        {
            if (j == i)
                continue;
            h.neighbour[2 * side + next] = 2 * plate.hinge[edges[j]] + plate.side[edges[j]];
            h.coupling[2 * side + next] = c[i][j];
            h.pull[side][++next] = -k[i][j] / (most * k[i][i]);
        }
    }
}

} // namespace

bool is_plate(const Body& body)
{
    return body.material.bending_model == BendingModel::plate && body.mesh.tetrahedra.empty() &&
           !body.kinematic.used && !body.mesh.triangles.empty() && resists_bending(body.material);
}

std::vector<PlateHinge> plate_hinges(const Body& body, std::size_t* dropped)
{
    std::vector<Plate> plates = plates_of(body);
    std::map<TriangleCorners, std::size_t> triangle;
    const auto sorted = [](TriangleCorners c) {
        std::sort(c.begin(), c.end());
        return c;
    };
    for (std::size_t t = 0; t < plates.size(); ++t)
        triangle.emplace(sorted(body.mesh.triangles[t]), t);
    const auto& x = body.mesh.positions;
    std::vector<PlateHinge> out;
    std::size_t lost = 0;
    for (const Hinge& h : mesh_hinges(body.mesh))
    {
        const std::size_t first = triangle.at(sorted({h.edge0, h.edge1, h.wing0}));
        const std::size_t second = triangle.at(sorted({h.edge0, h.edge1, h.wing1}));
        if (!plates[first].has_area || !plates[second].has_area)
        {
            ++lost;
            continue;
        }
        if (plates[first].held && plates[second].held)
            continue;
        const auto own = static_cast<std::uint32_t>(out.size());
        PlateHinge hinge;
        hinge.element = {h.edge0,
                         h.edge1,
                         h.wing0,
                         h.wing1,
                         dihedral_angle(x[h.edge0], x[h.edge1], x[h.wing0], x[h.wing1]),
                         0};
        hinge.neighbour = {2 * own, 2 * own, 2 * own + 1, 2 * own + 1};
        out.push_back(hinge);
        enter(body, h, own, 0, first, plates[first]);
        enter(body, h, own, 1, second, plates[second]);
    }
    std::vector<std::array<double, 2>> soft(out.size(), {0, 0});
    for (const Plate& plate : plates)
        add_side(plate, out, soft);
    for (std::size_t k = 0; k < out.size(); ++k)
    {
        out[k].element.compliance = soft[k][0] + soft[k][1];
        out[k].share = soft[k][0] / out[k].element.compliance;
    }
    if (dropped)
        *dropped = lost;
    return out;
}

} // namespace taut
