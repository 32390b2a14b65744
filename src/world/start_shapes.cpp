#include "taut/world/start_shapes.hpp"

#include "taut/elements/element.hpp"
#include "taut/plan/material.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace taut {

std::uint32_t Joined::find(std::uint32_t v)
{
    while (root_[v] != v)
        v = root_[v] = root_[root_[v]];
    return v;
}

std::vector<std::uint32_t> Joined::roots()
{
    std::vector<std::uint32_t> out;
    for (std::uint32_t v = 0; v < root_.size(); ++v)
        out.push_back(find(v));
    return out;
}

std::vector<double> inverse_masses(const Scene& scene)
{
    std::vector<double> out;
    for (const Body& body : scene.bodies)
    {
        const std::size_t first = out.size();
        for (const double m : vertex_masses(body))
            out.push_back(body.kinematic.used ? 0 : 1 / m);
        for (const Pin& pin : body.pins)
            for (const std::uint32_t v : pin.vertices)
                out[first + v] = 0;
    }
    return out;
}

std::vector<StartLength> start_lengths(const Scene& scene, const StartSurfaces& surfaces)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const auto add = [&](std::uint32_t a, std::uint32_t b) { pairs.insert(std::minmax(a, b)); };
    const judging::Surface& surface = surfaces.surface();
    for (std::size_t e = 0; e < surface.edges.size(); ++e)
    {
        const std::uint32_t a = surface.edges[e][0], b = surface.edges[e][1];
        add(a, b);
        const auto& beside = surface.edge_triangles[e];
        const auto other = [&](std::uint32_t t) {
            for (const std::uint32_t v : surface.triangles[t])
                if (v != a && v != b)
                    return v;
            return a;
        };
        if (beside.size() == 2)
            add(other(beside[0]), other(beside[1]));
    }
    std::uint32_t first = 0;
    for (const Body& body : scene.bodies)
    {
        for (const auto& t : body.mesh.tetrahedra)
            for (std::uint32_t i = 0; i < 4; ++i)
                for (std::uint32_t j = 0; j < i; ++j)
                    add(first + t[i], first + t[j]);
        for (const auto& l : body.mesh.links)
            add(first + l[0], first + l[1]);
        for (const Body::Spring& s : body.springs)
            add(first + s.a, first + s.b);
        for (const Body::Elements& list : body.elements)
            if (const ElementKind* kind = find_element(list.kind))
                for (std::size_t v = 0; v < list.vertices.size(); ++v)
                    if (v % kind->corners > 0)
                        add(first + list.vertices[v - 1], first + list.vertices[v]);
        first += static_cast<std::uint32_t>(body.mesh.positions.size());
    }
    std::vector<StartLength> out;
    for (const auto& [a, b] : pairs)
        out.push_back({a, b, glm::distance(surfaces.places()[a], surfaces.places()[b])});
    return out;
}

} // namespace taut
