#include "taut/world/start_surfaces.hpp"

#include "taut/judge/distance.hpp"
#include "taut/judge/scene_triangles.hpp"
#include "taut/judge/triangle_tree.hpp"
#include "taut/plan/contact_scene.hpp"
#include "taut/scene/pose.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace taut {
namespace {

/// Of the distance at rest that two of one body keep (kernels/contact/contact_make).
constexpr double kOfRest = 0.9999;

std::array<glm::dvec3, 3> corners_of(const judging::Triangle& t, const std::vector<glm::dvec3>& x)
{
    return {x[t[0]], x[t[1]], x[t[2]]};
}

judging::NearestOfSegments nearest(const judging::Edge& e, const judging::Edge& f,
                                   const std::vector<glm::dvec3>& x)
{
    return judging::nearest_of_segments(x[e[0]], x[e[1]], x[f[0]], x[f[1]]);
}

/// Whether both nearest points of two edges lie within: at an end a vertex and a triangle are as near.
bool within(const judging::NearestOfSegments& n)
{
    return n.along_p > 0 && n.along_p < 1 && n.along_q > 0 && n.along_q < 1;
}

/// Relative to coordinates: what turning and moving a body in double leaves.
constexpr double kRounding = 1e-14;

/// With the normal, which is that of the way between the nearest points.
NearPair finished(NearPair pair, const std::vector<glm::dvec3>& x)
{
    for (int k = 0; k < 4; ++k)
        pair.normal += pair.weight[k] * x[pair.corner[k]];
    const double size = glm::length(pair.normal);
    pair.normal = size > 0 ? pair.normal / size : glm::dvec3(0);
    return pair;
}

} // namespace

StartSurfaces::StartSurfaces(const Scene& resolved)
{
    if (!wants_contact(resolved))
        return;
    judging::SceneTriangles all = judging::scene_triangles(resolved);
    body_ = std::move(all.body);
    for (std::size_t b = 0; b < resolved.bodies.size(); ++b)
    {
        const Body& body = resolved.bodies[b];
        const auto& start = start_of(body);
        places_.insert(places_.end(), start.begin(), start.end());
        rest_.insert(rest_.end(), body.mesh.positions.begin(), body.mesh.positions.end());
        used_.resize(places_.size(), false);
        held_.resize(places_.size(), body.kinematic.used);
        for (const Pin& pin : body.pins)
            for (const std::uint32_t v : pin.vertices)
                held_[places_.size() - start.size() + v] = true;
        radius_.push_back(radius_of(resolved, body));
        names_.push_back(body.name);
        first_.push_back(b == 0 ? 0
                                : first_.back() + static_cast<std::uint32_t>(
                                                      resolved.bodies[b - 1].mesh.triangles.size()));
        std::vector<bool>& row = meet_.emplace_back();
        for (std::size_t other = 0; other < resolved.bodies.size(); ++other)
            row.push_back(surfaces_meet(resolved, b, other));
    }
    std::vector<bool> takes;
    for (const Body& body : resolved.bodies)
        takes.push_back(takes_part(resolved, body));
    for (const judging::Triangle& t : all.triangles)
        for (const std::uint32_t v : t)
            used_[v] = takes[body_[v]];
    surface_ = judging::make_surface(body_.size(), std::move(all.triangles), std::move(all.led),
                                     std::move(all.passing));
}

std::vector<judging::CrossingEdge> StartSurfaces::crossings(const std::vector<glm::dvec3>& places) const
{
    if (surface_.triangles.empty())
        return {};
    std::vector<judging::CrossingEdge> out = judging::crossing_edges(surface_, places);
    std::erase_if(out, [&](const judging::CrossingEdge& c) {
        return !meets(surface_.edges[c.edge][0], surface_.triangles[c.triangle][0]);
    });
    return out;
}

std::vector<NearPair> StartSurfaces::near(const std::vector<glm::dvec3>& places) const
{
    std::vector<NearPair> out = within_gap(places);
    std::erase_if(out, [](const NearPair& pair) { return pair.distance == 0; });
    return out;
}

std::vector<NearPair> StartSurfaces::touching(const std::vector<glm::dvec3>& places) const
{
    std::vector<NearPair> out = within_gap(places);
    std::erase_if(out, [&](const NearPair& pair) {
        const std::array<std::uint32_t, 4>& corner = pair.corner;
        double extent = 0; // m
        for (const std::uint32_t v : corner)
            extent = std::max(extent, glm::length(places[v]));
        return pair.distance > kRounding * extent || body_[corner[0]] == body_[corner[3]];
    });
    return out;
}

std::vector<NearPair> StartSurfaces::within_gap(const std::vector<glm::dvec3>& places) const
{
    std::vector<NearPair> out;
    if (surface_.triangles.empty())
        return out;
    near_triangles(places, out);
    near_edges(places, out);
    return out;
}

bool StartSurfaces::held(const std::array<std::uint32_t, 4>& corner) const
{
    return std::all_of(corner.begin(), corner.end(), [&](std::uint32_t v) { return held_[v]; });
}

void StartSurfaces::near_triangles(const std::vector<glm::dvec3>& x, std::vector<NearPair>& out) const
{
    const judging::TriangleTrees trees(surface_, x);
    const double widest = *std::max_element(radius_.begin(), radius_.end());
    for (std::uint32_t v = 0; v < x.size(); ++v)
    {
        if (!used_[v])
            continue;
        judging::Box box;
        box.add(x[v] - (radius_[body_[v]] + widest));
        box.add(x[v] + (radius_[body_[v]] + widest));
        trees.overlapping(surface_.is_led(std::array{v}), box, [&](std::uint32_t t) {
            const judging::Triangle& c = surface_.triangles[t];
            if (judging::has(c, v) || !meets(v, c[0]) || !surface_.judged(std::array{v}, c))
                return;
            const judging::NearestOfTriangle now = judging::nearest_of_triangle(x[v], corners_of(c, x));
            double gap = gap_of(v, c[0]);
            if (now.distance < gap && body_[v] == body_[c[0]])
                gap = std::min(
                    gap, kOfRest * judging::nearest_of_triangle(rest_[v], corners_of(c, rest_)).distance);
            const std::array<std::uint32_t, 4> corner{v, c[0], c[1], c[2]};
            if (now.distance < gap && !held(corner))
                out.push_back(finished({.corner = corner,
                                        .weight = {1, -now.shares[0], -now.shares[1], -now.shares[2]},
                                        .distance = now.distance,
                                        .gap = gap},
                                       x));
        });
    }
}

void StartSurfaces::near_edges(const std::vector<glm::dvec3>& x, std::vector<NearPair>& out) const
{
    std::vector<judging::Box> boxes(surface_.edges.size());
    for (std::size_t e = 0; e < boxes.size(); ++e)
        for (const std::uint32_t v : surface_.edges[e])
            boxes[e].add(x[v]);
    const judging::BoxTree tree(boxes);
    const double widest = *std::max_element(radius_.begin(), radius_.end());
    for (std::uint32_t e = 0; e < boxes.size(); ++e)
    {
        const judging::Edge own = surface_.edges[e];
        if (!used_[own[0]] || surface_.is_led(own)) // those that are not ask for those that are
            continue;
        judging::Box box = boxes[e];
        box.low -= radius_[body_[own[0]]] + widest;
        box.high += radius_[body_[own[0]]] + widest;
        tree.overlapping(box, [&](std::uint32_t f) {
            const judging::Edge& other = surface_.edges[f];
            if ((f <= e && !surface_.is_led(other)) || own[0] == other[0] || own[0] == other[1] ||
                own[1] == other[0] || own[1] == other[1] || !meets(own[0], other[0]) ||
                !surface_.judged(own, other))
                return;
            const judging::NearestOfSegments now = nearest(own, other, x);
            double gap = gap_of(own[0], other[0]);
            if (now.distance < gap && body_[own[0]] == body_[other[0]])
                gap = std::min(gap, kOfRest * nearest(own, other, rest_).distance);
            const std::array<std::uint32_t, 4> corner{own[0], own[1], other[0], other[1]};
            if (now.distance < gap && within(now) && !held(corner))
                out.push_back(
                    finished({.corner = corner,
                              .weight = {1 - now.along_p, now.along_p, now.along_q - 1, -now.along_q},
                              .distance = now.distance,
                              .gap = gap},
                             x));
        });
    }
}

/// "triangle 12 of bodies[1] ("cloth")"
std::string StartSurfaces::name_of(std::uint32_t triangle) const
{
    const std::uint32_t body = body_of(surface_.triangles[triangle][0]);
    return "triangle " + std::to_string(triangle - first_[body]) + " of bodies[" + std::to_string(body) +
           "]" + (names_[body].empty() ? "" : " (\"" + names_[body] + "\")");
}

std::string StartSurfaces::crossed(const std::vector<glm::dvec3>& places) const
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [edge, triangle] : crossings(places))
        for (const std::uint32_t own : surface_.edge_triangles[edge])
            pairs.push_back(std::minmax(own, triangle));
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    if (pairs.empty())
        return {};
    return std::to_string(pairs.size()) +
           (pairs.size() == 1 ? " pair of triangles, " : " pairs of triangles, the first ") +
           name_of(pairs[0].first) + " and " + name_of(pairs[0].second);
}

double deepest_contact(const Scene& resolved)
{
    const StartSurfaces surfaces(resolved);
    double out = 0;
    for (const NearPair& pair : surfaces.near(surfaces.places()))
        out = std::max(out, pair.gap - pair.distance);
    return out;
}

} // namespace taut
