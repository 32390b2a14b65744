#include "taut/world/separate_start.hpp"

#include "taut/plan/contact_scene.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/world/crossed_start.hpp"
#include "taut/world/start_moves.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace taut {
namespace {

/// While a scene runs: what a pinch has left is shallow, and the next step may do what this one does not.
constexpr StartRounds kInRun{.most = 200, .patience = 50, .finish = 10};

/// The body of a tetrahedron that had a volume and would have none.
std::optional<std::size_t> turned_inside_out(const Scene& scene, const std::vector<glm::dvec3>& before,
                                             const std::vector<glm::dvec3>& after)
{
    std::uint32_t first = 0;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
        const Mesh& mesh = scene.bodies[b].mesh;
        for (std::array<std::uint32_t, 4> t : mesh.tetrahedra)
        {
            for (std::uint32_t& v : t)
                v += first;
            if (six_volumes(before, t) > 0 && !(six_volumes(after, t) > 0))
                return b;
        }
        first += static_cast<std::uint32_t>(mesh.positions.size());
    }
    return {};
}

/// Bodies of which a vertex is elsewhere than `before` start where `x` says.
void put_starts(Scene& scene, const std::vector<glm::dvec3>& before, const std::vector<glm::dvec3>& x)
{
    std::ptrdiff_t first = 0;
    for (Body& body : scene.bodies)
    {
        const std::ptrdiff_t end = first + static_cast<std::ptrdiff_t>(body.mesh.positions.size());
        if (!std::equal(x.begin() + first, x.begin() + end, before.begin() + first))
            body.start_positions.assign(x.begin() + first, x.begin() + end);
        first = end;
    }
}

/// Raises vertices of bodies that touch others exactly by a share of the gap that rounding cannot undo, or
/// their sides would be chance: what is the higher goes up, and what lies on it further.
void raise_touching(const Scene& scene, const StartSurfaces& surfaces, std::vector<glm::dvec3>& x)
{
    constexpr double share = 1e-6;
    std::vector<std::vector<std::pair<std::size_t, double>>> below(scene.bodies.size()); // with the gap, m
    for (const NearPair& pair : surfaces.touching(x))
    {
        std::size_t a = surfaces.body_of(pair.corner[0]), b = surfaces.body_of(pair.corner[3]);
        if (touching_height(scene, a) > touching_height(scene, b))
            std::swap(a, b);
        below[b].emplace_back(a, pair.gap);
    }
    std::vector<double> up(scene.bodies.size(), 0); // m
    for (std::size_t b = 0; b < up.size(); ++b)     // those held whole stay, the others from low to high
        for (const auto& [a, gap] : below[b])
            up[b] = std::max(up[b], up[a] + share * gap);
    const std::vector<double> w = inverse_masses(scene);
    for (std::uint32_t v = 0; v < x.size(); ++v)
        if (w[v] > 0)
            x[v] += up[surfaces.body_of(v)] * upwards(scene);
}

/// What make_plan() would refuse is refused before anything is looked at.
void check_values(const Scene& resolved)
{
    for (const SceneIssue& issue : check_resolved(resolved))
        if (issue.error)
            throw Error(issue.code, issue.field + " " + issue.text);
}

} // namespace

SeparatedStart separate_start(const Scene& resolved)
{
    check_values(resolved);
    SeparatedStart out;
    out.scene = resolved;
    const StartSurfaces surfaces(resolved);
    std::vector<glm::dvec3> x = surfaces.places();
    out.crossed = surfaces.crossed(x);
    out.near = surfaces.near(x).size();
    if (out.crossed.empty() && out.near == 0)
        return out;
    raise_touching(resolved, surfaces, x);
    std::vector<double> w = inverse_masses(resolved);
    std::vector<StartLength> lengths = start_lengths(resolved, surfaces);
    const bool rigid = part_whole(surfaces, w, lengths, x);
    const bool done = rigid && surfaces.crossings(x).empty() && surfaces.near(x).empty();
    if (!done && !part_vertices(surfaces, std::move(w), std::move(lengths), x))
        throw Error(
            ErrorCode::bad_input,
            "contact.start is \"separate\", but what goes through each other at the start could not be "
            "taken apart: " +
                surfaces.crossed(x) + "; move the bodies apart");
    if (const auto body = turned_inside_out(resolved, surfaces.places(), x))
        throw Error(ErrorCode::bad_input,
                    "contact.start is \"separate\", but that would turn tetrahedra of bodies[" +
                        std::to_string(*body) + "] inside out; move the bodies apart");
    out.left = surfaces.near(x).size();
    for (std::size_t v = 0; v < x.size(); ++v)
        out.farthest = std::max(out.farthest, glm::distance(x[v], surfaces.places()[v]));
    put_starts(out.scene, surfaces.places(), x);
    return out;
}

std::vector<glm::dvec3> untangled_places(const Scene& now)
{
    const StartSurfaces surfaces(now);
    std::vector<glm::dvec3> x = surfaces.places();
    if (surfaces.crossings(x).empty())
        return x;
    const bool done = part_vertices(surfaces, inverse_masses(now), start_lengths(now, surfaces), x, kInRun);
    return done && !turned_inside_out(now, surfaces.places(), x) ? x : std::vector<glm::dvec3>();
}

Scene with_start(Scene resolved)
{
    if (resolved.contact.start == ContactStart::separate)
        return separate_start(resolved).scene;
    if (resolved.contact.start != ContactStart::refuse)
        return resolved;
    check_values(resolved);
    if (const std::string crossed = crossed_at_start(resolved); !crossed.empty())
        throw Error(ErrorCode::bad_input, crossed);
    return resolved;
}

} // namespace taut
