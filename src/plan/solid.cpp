#include "taut/plan/solid.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace taut {
namespace {

/// det F differentiated by F: columns are cross products of the other two.
glm::dmat3 cofactor(const glm::dmat3& f)
{
    return {glm::cross(f[1], f[2]), glm::cross(f[2], f[0]), glm::cross(f[0], f[1])};
}

double square(const glm::dmat3& f)
{
    return glm::dot(f[0], f[0]) + glm::dot(f[1], f[1]) + glm::dot(f[2], f[2]);
}

glm::dmat3 edges(const std::array<std::uint32_t, 4>& v, std::span<const glm::dvec3> x)
{
    return {x[v[1]] - x[v[0]], x[v[2]] - x[v[0]], x[v[3]] - x[v[0]]};
}

/// One of the same material for every tetrahedron.
std::vector<SolidElement> elements_like(SolidElement element, const Mesh& mesh)
{
    std::vector<SolidElement> out;
    for (const auto& t : mesh.tetrahedra)
    {
        element.vertex = t;
        element.inverse_rest = glm::inverse(edges(t, mesh.positions));
        element.rest_volume = six_volumes(mesh.positions, t) / 6;
        out.push_back(element);
    }
    return out;
}

} // namespace

double bulk_modulus(const Material& m)
{
    return m.volume_stiffness < 0 ? m.youngs_modulus / (3 * (1 - 2 * m.poissons_ratio)) : m.volume_stiffness;
}

bool holds_volumes(const Body& body)
{
    return !body.mesh.tetrahedra.empty() && body.material.model == SolidModel::springs &&
           body.material.volume == HeldVolume::tetrahedra && bulk_modulus(body.material) > 0;
}

bool is_elastic(const Body& body)
{
    return !body.mesh.tetrahedra.empty() && body.material.model != SolidModel::springs;
}

std::vector<VolumeElement> volume_elements(const Body& body)
{
    std::vector<VolumeElement> out;
    if (!holds_volumes(body))
        return out;
    const double modulus = bulk_modulus(body.material);
    for (const auto& t : body.mesh.tetrahedra)
    {
        const double volume = six_volumes(body.mesh.positions, t) / 6;
        out.push_back({t, volume, volume / modulus}); // 0 for an infinite modulus
    }
    return out;
}

std::vector<SolidElement> solid_elements(const Body& body)
{
    if (!is_elastic(body))
        return {};
    const double e = body.material.youngs_modulus, nu = body.material.poissons_ratio;
    const double lame_mu = e / (2 * (1 + nu)), lame_lambda = e * nu / ((1 + nu) * (1 - 2 * nu));
    const bool log = body.material.model == SolidModel::neo_hookean;
    SolidElement element;
    element.log = log ? 1 : 0;
    element.mu = log ? 4.0 / 3 * lame_mu : lame_mu;
    element.lambda = log ? lame_lambda + 5.0 / 6 * lame_mu : lame_lambda + lame_mu;
    element.rest = 1 + element.mu / element.lambda * (log ? 0.75 : 1);
    return elements_like(element, body.mesh);
}

std::vector<SolidElement> volume_solids(const Body& body)
{
    if (!holds_volumes(body))
        return {};
    SolidElement element;
    element.lambda = bulk_modulus(body.material);
    element.log = 0;
    return elements_like(element, body.mesh);
}

double volume_of(const std::array<std::uint32_t, 4>& v, std::span<const glm::dvec3> x)
{
    return glm::determinant(edges(v, x)) / 6;
}

std::array<glm::dvec3, 4> volume_gradient(const std::array<std::uint32_t, 4>& v,
                                          std::span<const glm::dvec3> x)
{
    const glm::dmat3 g = cofactor(edges(v, x));
    return {-(g[0] + g[1] + g[2]) / 6.0, g[0] / 6.0, g[1] / 6.0, g[2] / 6.0};
}

glm::dmat3 deformation(const SolidElement& e, std::span<const glm::dvec3> x)
{
    return edges(e.vertex, x) * e.inverse_rest;
}

double solid_energy(const SolidElement& e, std::span<const glm::dvec3> x)
{
    const glm::dmat3 f = deformation(e, x);
    const double i = square(f), j = glm::determinant(f) - e.rest;
    const double shape = i - 3 - e.log * std::log((i + 1) / 4);
    return e.rest_volume * 0.5 * (e.mu * shape + e.lambda * (j * j - (1 - e.rest) * (1 - e.rest)));
}

std::array<glm::dvec3, 4> solid_forces(const SolidElement& e, std::span<const glm::dvec3> x)
{
    const glm::dmat3 f = deformation(e, x);
    const double shape = e.mu * (1 - e.log / (square(f) + 1));
    const glm::dmat3 stress = shape * f + e.lambda * (glm::determinant(f) - e.rest) * cofactor(f);
    const glm::dmat3 force = -e.rest_volume * stress * glm::transpose(e.inverse_rest);
    return {-(force[0] + force[1] + force[2]), force[0], force[1], force[2]};
}

} // namespace taut
