// Based on: O'Brien, Hodgins. Graphical Modeling and Animation of Brittle Fracture. SIGGRAPH 1999: a vertex
//   comes apart along a plane across the greatest tension, and its elements go to the side that they are on.
// Departures: in a sheet of triangles; the plane is across the overlong spring, the tear follows edges
//   instead of cutting triangles, and what touches in nothing but a vertex afterwards comes apart there too.

#include "taut/world/tearing.hpp"

#include "taut/plan/material.hpp"
#include "taut/plan/topology.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut {
namespace {

using Triangles = std::vector<std::uint32_t>;

bool has_corner(const std::array<std::uint32_t, 3>& triangle, std::uint32_t v)
{
    return std::find(triangle.begin(), triangle.end(), v) != triangle.end();
}

/// A body while it comes apart.
class Tearing
{
public:
    Tearing(Body& body, std::span<const glm::dvec3> x)
        : body_(body), x_(x.begin(), x.end()), at_(x.size()), held_(x.size(), false), used_(x.size(), false)
    {
        body.vertex_masses = vertex_masses(body);
        for (std::uint32_t v = 0; v < x.size(); ++v)
            origin.push_back(v);
        for (std::uint32_t t = 0; t < body.mesh.triangles.size(); ++t)
            for (const std::uint32_t v : body.mesh.triangles[t])
                at_[v].push_back(t);
        for (const Pin& pin : body.pins)
            for (const std::uint32_t v : pin.vertices)
                held_[v] = true;
    }

    void run()
    {
        for (const Overlong& spring : overlong())
        {
            if (used_[spring.a] || used_[spring.b])
                continue;
            // A tear goes on at its ends: an edge of the cloth gives way before its middle.
            const bool second = open_fan(spring.b) && !open_fan(spring.a);
            const std::uint32_t first = second ? spring.b : spring.a, other = second ? spring.a : spring.b;
            if (!split(first, other))
                split(other, first);
        }
        if (splits > 0)
        {
            body_.shape.kind = ShapeKind::mesh; // no grid any more
            body_.mesh.grid_columns = body_.mesh.grid_rows = 0;
        }
    }

    std::vector<std::uint32_t> origin; ///< of each vertex of the body
    std::uint64_t splits = 0;

private:
    struct Overlong
    {
        double strain;
        std::uint32_t a, b;
    };

    std::vector<Overlong> overlong() const
    {
        std::vector<Overlong> out;
        for (const StretchElement& e : stretch_elements(body_))
        {
            const double strain = e.rest_length > 0 ? glm::distance(x_[e.a], x_[e.b]) / e.rest_length - 1 : 0;
            if (strain > body_.material.tear_strain)
                out.push_back({strain, e.a, e.b});
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const Overlong& a, const Overlong& b) { return a.strain > b.strain; });
        return out;
    }

    const std::array<std::uint32_t, 3>& corners(std::uint32_t t) const { return body_.mesh.triangles[t]; }

    /// Two triangles at v that share one of its edges.
    bool beside(std::uint32_t s, std::uint32_t t, std::uint32_t v) const
    {
        return std::any_of(corners(s).begin(), corners(s).end(),
                           [&](std::uint32_t w) { return w != v && has_corner(corners(t), w); });
    }

    /// Those of `triangles` that hang together with the first ones of `seed` by edges at v.
    Triangles connected(Triangles seed, const Triangles& triangles, std::uint32_t v) const
    {
        for (std::size_t k = 0; k < seed.size(); ++k)
            for (const std::uint32_t t : triangles)
                if (std::find(seed.begin(), seed.end(), t) == seed.end() && beside(seed[k], t, v))
                    seed.push_back(t);
        return seed;
    }

    /// Whether an edge at v has one triangle only.
    bool open_fan(std::uint32_t v) const
    {
        for (const std::uint32_t t : at_[v])
            for (const std::uint32_t w : corners(t))
                if (w != v && std::count_if(at_[v].begin(), at_[v].end(), [&](std::uint32_t s) {
                        return has_corner(corners(s), w);
                    }) == 1)
                    return true;
        return false;
    }

    /// The triangles at v on the other end's side of the plane through v across the spring.
    Triangles far_side(std::uint32_t v, std::uint32_t other) const
    {
        const glm::dvec3 along = x_[other] - x_[v];
        Triangles seed, side;
        for (const std::uint32_t t : at_[v])
        {
            glm::dvec3 middle(0);
            for (const std::uint32_t w : corners(t))
                middle += x_[w] - x_[v];
            const bool own = has_corner(corners(t), other);
            if (own)
                seed.push_back(t);
            if (own || glm::dot(middle, along) > 0)
                side.push_back(t);
        }
        return connected(seed, side, v);
    }

    bool split(std::uint32_t v, std::uint32_t other)
    {
        if (held_[v])
            return false;
        const Triangles side = far_side(v, other);
        if (side.empty() || side.size() == at_[v].size())
            return false;
        std::vector<std::uint32_t> ring;
        for (const std::uint32_t t : at_[v])
            ring.insert(ring.end(), corners(t).begin(), corners(t).end());
        ++splits;
        part(v, side);
        for (const std::uint32_t w : ring) // v is among them
        {
            used_[w] = true;
            separate(w);
        }
        return true;
    }

    /// Gives `triangles` at v a vertex of their own.
    void part(std::uint32_t v, const Triangles& triangles)
    {
        const auto fresh = static_cast<std::uint32_t>(x_.size());
        const double share = area(triangles) / area(at_[v]), mass = body_.vertex_masses[v];
        for (const std::uint32_t t : triangles)
        {
            std::replace(body_.mesh.triangles[t].begin(), body_.mesh.triangles[t].end(), v, fresh);
            at_[v].erase(std::find(at_[v].begin(), at_[v].end(), t));
        }
        x_.push_back(x_[v]);
        at_.push_back(triangles);
        held_.push_back(held_[v]);
        used_.push_back(true);
        origin.push_back(origin[v]);
        body_.mesh.positions.push_back(body_.mesh.positions[v]);
        body_.vertex_masses.push_back(mass * share);
        body_.vertex_masses[v] = mass - mass * share;
        if (!body_.start_positions.empty())
            body_.start_positions.push_back(body_.start_positions[v]);
        for (Pin& pin : body_.pins)
            if (std::find(pin.vertices.begin(), pin.vertices.end(), v) != pin.vertices.end())
                pin.vertices.push_back(fresh);
    }

    /// Triangles that meet in nothing but v come apart there.
    void separate(std::uint32_t v)
    {
        while (!at_[v].empty())
        {
            const Triangles together = connected({at_[v].front()}, at_[v], v);
            if (together.size() == at_[v].size())
                return;
            ++splits;
            part(v, together);
        }
    }

    /// m^2 at rest. Triangles without area count a little, so that every part has mass.
    double area(const Triangles& triangles) const
    {
        double sum = 0;
        for (const std::uint32_t t : triangles)
        {
            const auto& [a, b, c] = corners(t);
            const std::vector<glm::dvec3>& rest = body_.mesh.positions;
            sum += std::max(0.5 * glm::length(glm::cross(rest[b] - rest[a], rest[c] - rest[a])), 1e-30);
        }
        return sum;
    }

    Body& body_;
    std::vector<glm::dvec3> x_;
    std::vector<Triangles> at_;
    std::vector<bool> held_, used_;
};

} // namespace

TornScene tear(const Scene& resolved, std::span<const glm::dvec3> x)
{
    TornScene out{resolved, {}, 0};
    std::uint32_t first = 0;
    for (Body& body : out.scene.bodies)
    {
        const auto count = static_cast<std::uint32_t>(body.mesh.positions.size());
        if (body.material.tear_strain > 0 && !body.mesh.triangles.empty())
        {
            Tearing tearing(body, x.subspan(first, count));
            tearing.run();
            for (const std::uint32_t v : tearing.origin)
                out.origin.push_back(first + v);
            out.splits += tearing.splits;
        }
        else
            for (std::uint32_t v = 0; v < count; ++v)
                out.origin.push_back(first + v);
        first += count;
    }
    return out;
}

} // namespace taut
