#include "taut/plan/springs.hpp"

#include "taut/plan/records.hpp"
#include "taut/plan/refusals.hpp"
#include "taut/runtime/base/error.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace taut {

Incidence incidence_of(std::uint32_t vertex_count, std::span<const std::uint32_t> corners,
                       std::uint32_t arity)
{
    Incidence out;
    out.start.assign(vertex_count + 1, 0);
    for (const std::uint32_t v : corners)
        ++out.start[v + 1];
    for (std::uint32_t v = 0; v < vertex_count; ++v)
        out.start[v + 1] += out.start[v];
    out.entries.resize(corners.size());
    std::vector<std::uint32_t> next(out.start.begin(), out.start.end() - 1);
    for (std::uint32_t k = 0; k < corners.size() / arity; ++k)
        for (std::uint32_t c = 0; c < arity; ++c)
            out.entries[next[corners[k * arity + c]]++] = k * arity + c;
    return out;
}

Incidence triangles_at(const PlanBuilder& b, std::string_view effect, std::span<const std::uint32_t> corners)
{
    Incidence out = incidence_of(b.plan.vertex_count, corners, 3);
    for (std::uint32_t v = 0; v < b.plan.vertex_count; ++v)
        if (const std::uint32_t count = out.start[v + 1] - out.start[v]; count >= kMaxLoopTrips)
            throw Error(ErrorCode::limit, std::string(effect) + ": vertex " +
                                              std::to_string(b.plan.original[v]) + " has " +
                                              std::to_string(count) + " triangles, at most " +
                                              std::to_string(kMaxLoopTrips - 1) + " can act on one");
    return out;
}

namespace {

/// `where`: "bodies[0]"; `method`: in quotes. Counts the springs at each vertex.
void refuse_rigid_springs(const Body& body, const std::string& where, const std::string& method,
                          std::vector<std::uint32_t>& at)
{
    for (const StretchElement& e : stretch_elements(body))
    {
        const std::string pair = std::to_string(e.a) + " and " + std::to_string(e.b);
        if (!(e.compliance > 0) && !(e.rest_length > 0))
            throw Error(ErrorCode::degenerate_rest, where + " has an edge without length between vertices " +
                                                        pair + ", whose stiffness is infinite; weld them");
        if (!(e.compliance > 0))
            throw Error(ErrorCode::unsupported,
                        where +
                            (std::isinf(body.material.stretch_stiffness)
                                 ? ".material.stretch_stiffness is infinite"
                                 : " has a rigid spring") +
                            " between vertices " + pair + ", which has no force under method " + method +
                            "; give it a finite stiffness, or take a method with constraints (xpbd)");
        ++at[e.a];
        ++at[e.b];
    }
}

void refuse_rigid(const Body& body, const std::string& where, const std::string& method)
{
    std::vector<std::uint32_t> at(body.mesh.positions.size(), 0);
    refuse_rigid_springs(body, where, method, at);
    for (const BendElement& e : bend_elements(body))
    {
        if (!(e.compliance > 0))
            throw Error(ErrorCode::unsupported, where +
                                                    ".material.bending_stiffness is infinite, which gives no "
                                                    "force to method " +
                                                    method + "; give a finite one");
        for (const std::uint32_t v : corners_of(e))
            ++at[v];
    }
    for (const VolumeElement& e : volume_elements(body))
    {
        if (!(e.compliance > 0))
            throw Error(ErrorCode::unsupported,
                        where + ".material.volume_stiffness is infinite, which gives no force to method " +
                            method + "; give a finite one, or take a method with constraints (xpbd)");
        for (const std::uint32_t v : e.vertex)
            ++at[v];
    }
    for (const SolidElement& e : solid_elements(body))
        for (const std::uint32_t v : e.vertex)
            ++at[v];
    const auto most = std::max_element(at.begin(), at.end());
    if (most != at.end() && *most > kMaxLoopTrips)
        throw Error(ErrorCode::limit, where + " has " + std::to_string(*most) +
                                          " springs, hinges and tetrahedra at vertex " +
                                          std::to_string(most - at.begin()) + ", at most " +
                                          std::to_string(kMaxLoopTrips) + " fit one invocation");
}

} // namespace

void refuse_rigid(const Scene& scene, Refusals& out)
{
    out.attempt_bodies(scene, [&](const Body& own, std::size_t k) {
        refuse_rigid(own, "bodies[" + std::to_string(k) + "]", quoted(scene.method.type));
    });
}

std::vector<StretchElement> acting_springs(PlanBuilder& b, std::size_t body)
{
    std::vector<StretchElement> out = stretch_elements(b.scene.bodies[body]);
    std::size_t conflicts = 0, kept = 0;
    for (StretchElement e : out)
    {
        e.a = b.vertex(body, e.a);
        e.b = b.vertex(body, e.b);
        if (b.inverse_mass[e.a] > 0 || b.inverse_mass[e.b] > 0)
            out[kept++] = e;
        else
            conflicts +=
                std::abs(glm::length(b.start[e.a] - b.start[e.b]) - e.rest_length) > 1e-6 * e.rest_length;
    }
    out.resize(kept);
    if (conflicts > 0)
        b.plan.warnings.push_back({"conflict", conflicts,
                                   std::to_string(conflicts) +
                                       " violated constraints between held vertices of body " +
                                       std::to_string(body)});
    return out;
}

std::vector<BendElement> acting_hinges(PlanBuilder& b, std::size_t body)
{
    std::vector<BendElement> out;
    std::size_t dropped = 0;
    for (BendElement e : bend_elements(b.scene.bodies[body], &dropped))
    {
        double moves = 0;
        for (std::uint32_t* v : {&e.edge0, &e.edge1, &e.wing0, &e.wing1})
        {
            *v = b.vertex(body, *v);
            moves += b.inverse_mass[*v];
        }
        if (moves > 0)
            out.push_back(e);
    }
    if (dropped > 0)
        b.plan.warnings.push_back(
            {"degenerate", dropped,
             std::to_string(dropped) + " hinges without area at rest in body " + std::to_string(body)});
    return out;
}

namespace {

template <typename Element>
std::vector<Element> of_all_bodies(PlanBuilder& b, std::vector<Element> (*acting)(PlanBuilder&, std::size_t))
{
    std::vector<Element> out;
    for (std::size_t body = 0; body < b.scene.bodies.size(); ++body)
    {
        std::vector<Element> own = acting(b, body);
        if (out.empty())
            out = std::move(own);
        else
            out.insert(out.end(), own.begin(), own.end());
    }
    return out;
}

} // namespace

std::vector<StretchElement> all_springs(PlanBuilder& b) { return of_all_bodies(b, acting_springs); }
std::vector<BendElement> all_hinges(PlanBuilder& b) { return of_all_bodies(b, acting_hinges); }

} // namespace taut
