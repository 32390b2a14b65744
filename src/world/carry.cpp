#include "taut/world/carry.hpp"

#include "taut/world/held_pairs.hpp"
#include "taut/world/moved.hpp"

#include <algorithm>
#include <cstring>

namespace taut {
namespace {

constexpr std::uint32_t kNowhere = 0xffffffff; ///< for renumbered(): the number of no vertex

std::array<std::vector<std::byte>*, kCarriedArrays> arrays_of(WorldState& s)
{
    return {&s.position, &s.low, &s.velocity, &s.delta, &s.force, &s.coasting, &s.owed};
}

} // namespace

std::vector<std::uint32_t> scene_vertices(const Plan& plan, const std::vector<std::uint32_t>& bodies,
                                          const std::vector<std::uint32_t>& first)
{
    std::vector<std::uint32_t> whole;
    for (std::size_t own = 0; own < bodies.size(); ++own)
        for (std::uint32_t v = plan.body_start[own]; v < plan.body_start[own + 1]; ++v)
            whole.push_back(first[bodies[own]] + (v - plan.body_start[own]));
    std::vector<std::uint32_t> out;
    for (const std::uint32_t v : plan.original)
        out.push_back(whole[v]);
    return out;
}

void collect(const World& world, const std::vector<std::uint32_t>& vertices, std::size_t total,
             CarriedState& out)
{
    WorldState state = world.state();
    const auto arrays = arrays_of(state);
    for (std::size_t k = 0; k < arrays.size(); ++k)
    {
        const std::size_t stride = vertices.empty() ? 0 : arrays[k]->size() / vertices.size();
        out.arrays[k].resize(std::max(out.arrays[k].size(), total * stride));
        for (std::size_t v = 0; v < vertices.size() && stride > 0; ++v)
            std::memcpy(out.arrays[k].data() + vertices[v] * stride, arrays[k]->data() + v * stride, stride);
    }
    out.clock = state.clock;
    out.step = state.step;
    // Pairs with what was not in this world stay.
    std::vector<std::uint32_t> own(total, kNowhere);
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        own[vertices[v]] = v;
    std::erase_if(out.held, [&](const HeldPair& pair) {
        return std::ranges::all_of(pair.vertex, [&](std::uint32_t v) { return own[v] != kNowhere; });
    });
    const std::vector<HeldPair> held = renumbered(state.held, own);
    out.held.insert(out.held.end(), held.begin(), held.end());
}

void deliver(World& world, const std::vector<std::uint32_t>& vertices,
             const std::vector<std::uint32_t>& bodies, const CarriedState& from)
{
    WorldState state = world.state();
    const auto arrays = arrays_of(state);
    for (std::size_t k = 0; k < arrays.size(); ++k)
    {
        const std::size_t stride = vertices.empty() ? 0 : arrays[k]->size() / vertices.size();
        for (std::size_t v = 0; v < vertices.size() && stride > 0; ++v)
            std::memcpy(arrays[k]->data() + v * stride, from.arrays[k].data() + vertices[v] * stride, stride);
    }
    state.clock = from.clock;
    state.step = from.step;
    state.moved = part_of(from.moved, bodies);
    state.held = renumbered(from.held, vertices);
    world.restore(state);
}

void place(std::vector<glm::dvec3>& out, const std::vector<glm::dvec3>& own, const Plan& plan,
           const std::vector<std::uint32_t>& bodies, const std::vector<std::uint32_t>& first)
{
    for (std::size_t b = 0; b < bodies.size(); ++b)
        std::copy(own.begin() + plan.body_start[b], own.begin() + plan.body_start[b + 1],
                  out.begin() + first[bodies[b]]);
}

Scene with_bodies(const Scene& scene, const std::vector<std::uint32_t>& bodies)
{
    Scene part = scene;
    part.bodies.clear();
    for (const std::uint32_t b : bodies)
        part.bodies.push_back(scene.bodies[b]);
    // Groups of which no body is left cannot be passed through.
    const std::vector<std::string> groups = contact_groups(part);
    for (Body& body : part.bodies)
        std::erase_if(body.contact.passes, [&](const std::string& name) {
            return std::find(groups.begin(), groups.end(), name) == groups.end();
        });
    return part;
}

void add(Events& sum, const Events& more)
{
    sum.non_finite += more.non_finite;
    sum.speed_clamped += more.speed_clamped;
    sum.degenerate += more.degenerate;
    sum.conflicts += more.conflicts;
}

void add(ContactCounts& sum, const ContactCounts& more)
{
    sum.any |= more.any;
    sum.searches += more.searches;
    sum.missing += more.missing;
    sum.cut += more.cut;
    sum.crowded += more.crowded;
}

void add(SolverReport& sum, const SolverReport& more)
{
    sum.last = more.solves > 0 || sum.solves == 0 ? more.last : sum.last;
    sum.solves += more.solves;
    sum.iterations += more.iterations;
    sum.most = std::max(sum.most, more.most);
    sum.limited += more.limited;
    sum.failed += more.failed;
}

} // namespace taut
