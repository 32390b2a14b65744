#pragma once
// What the tests of collider kernels share: vertices, and contact with friction in fp64 from the written
// rules.

#include "support/expect.hpp"
#include "support/random.hpp"

#include <glm/geometric.hpp>

#include <algorithm>

namespace taut::conformance {

/// Input of a collider kernel, apart from the colliders.
template <typename Real>
struct Contacts
{
    std::vector<glm::vec<4, Real>> position, delta, contact; ///< contact: colliders * count
    layout::StepValues<Real> step{};
    std::uint32_t count = 0, colliders = 0, substep = 0, substeps = 1;

    template <typename Collider>
    Buffers buffers(const std::string& name, const std::vector<Collider>& collider) const
    {
        return {{"position", bytes_of(position)}, {"delta", bytes_of(delta)},
                {"contact", bytes_of(contact)},   {"step_values", bytes_of(std::vector{step})},
                {"events", no_events()},          {name, bytes_of(collider)}};
    }
};

/// Where a collider is during a substep and what it says to one vertex.
struct Touch
{
    glm::dvec3 normal{0};
    double gap_before = 0; ///< to the surface, less the gap kept, at the start of the substep
    double gap = 0;        ///< the same at its end
    glm::dvec3 shift{0};   ///< of the collider during the substep
    double friction = 0;
    double size = 0;        ///< of the numbers that made the gaps
    double normal_size = 0; ///< of those that made the normal, of length 1; 0: no rounding
};

/// The reference's view of one vertex.
struct Walker
{
    glm::dvec3 d{0};
    bool moves = true;
    double scale = 0; ///< size of what was rounded so far
};

struct Rules
{
    bool friction = false, kept = false, first_iteration = true;
    double depenetration = 0, braked = 0;
};

/// m, how far a substep lets out what began it below a surface.
inline double let_out(double gap_before, double depenetration, double braked)
{
    return gap_before < 0 ? std::min(depenetration, braked * std::sqrt(-gap_before)) : 0;
}

/// Pushes a vertex out along the normal to where the gap is 0, or no less deep than it began less the allowed
/// way out. Friction takes away sliding against the collider, at most friction * the push of the substep so
/// far. `store` is what earlier iterations took, xyz, and pushed, w. Returns whether it is a conflict: a held
/// vertex that would have to be pushed.
inline bool resolve_contact(Walker& v, const Touch& t, const Rules& rules, glm::dvec4& store,
                            double& store_scale)
{
    const double way = let_out(t.gap_before, rules.depenetration, rules.braked);
    const double target = std::min(0.0, t.gap_before + way);
    const double wanted = t.gap < target ? target - t.gap : 0;
    const double push = v.moves ? wanted : 0;
    v.d += t.normal * push;
    v.scale += t.size;
    if (rules.friction)
    {
        const glm::dvec4 before = rules.kept && !rules.first_iteration ? store : glm::dvec4(0);
        const double height = before.w + push;
        const glm::dvec3 relative = v.d - t.shift;
        const glm::dvec3 slide = relative - t.normal * glm::dot(relative, t.normal) + glm::dvec3(before);
        const double most = t.friction * height, size = glm::length(slide);
        const glm::dvec3 removal = size > most && size > 0 ? slide / size * most : slide;
        v.d -= removal - glm::dvec3(before);
        v.scale += glm::length(relative) + size + (1 + t.friction) * t.size;
        store = glm::dvec4(removal, height);
        store_scale = v.scale;
    }
    return wanted > 0 && !v.moves;
}

/// Random vertices in a cube of half width `size`, one in ten held.
template <typename Real>
Contacts<Real> random_contacts(Random& random, std::uint32_t count, std::uint32_t colliders, double size,
                               double speed)
{
    Contacts<Real> in;
    in.count = count;
    in.colliders = colliders;
    in.position = random.vec4s<Real>(count + 7, size, 0, 0);
    for (auto& p : in.position)
        p.w = random.inverse_mass<Real>();
    in.delta = random.vec4s<Real>(count + 7, speed, 0, 0.02); // w = gap kept
    in.contact = random.vec4s<Real>(std::size_t{colliders} * count + 3, 0.01, 0, 0.05);
    in.step.depenetration = Real(0.05);
    in.step.braked = Real(0.2); // brakes what is less than 0.0625 deep
    return in;
}

/// Runs `touch(vertex position, displacement, gap kept, collider index)` of every vertex and collider in turn
/// and checks the kernel on every executor. A Touch of infinite size is one the rules leave open.
template <typename Real, typename TouchOf>
void check_contacts(const Contacts<Real>& in, const KernelInfo& kernel, Bytes params, const Buffers& buffers,
                    Rules rules, bool report, TouchOf touch)
{
    Case c;
    c.precision = precision_of<Real>();
    c.in = buffers;
    c.launches = {{&kernel, std::move(params), in.count}};
    rules.depenetration = static_cast<double>(in.step.depenetration);
    rules.braked = static_cast<double>(in.step.braked);
    std::vector<glm::dvec4> store(in.contact.begin(), in.contact.end());
    std::vector<double> store_scale(store.size(), 0);
    Field& delta = c.expected["delta"];
    std::uint32_t open = 0;
    for (std::uint32_t i = 0; i < in.delta.size(); ++i)
    {
        Walker v{glm::dvec3(in.delta[i]), in.position[i].w > 0, 0};
        for (std::uint32_t j = 0; j < in.colliders && i < in.count; ++j)
        {
            const Touch t = touch(glm::dvec3(in.position[i]), v.d, static_cast<double>(in.delta[i].w), j);
            const std::size_t at = std::size_t{j} * in.count + i;
            const bool conflict = resolve_contact(v, t, rules, store[at], store_scale[at]);
            c.events[TAUT_EVENT_CONFLICT] += conflict && report ? 1 : 0;
        }
        open += v.scale == kAnyFinite ? 1 : 0;
        const bool written = i < in.count && v.moves;
        for (int k = 0; k < 3; ++k)
            delta.add(written ? v.d[k] : static_cast<double>(in.delta[i][k]), written ? v.scale : 0);
        delta.add(static_cast<double>(in.delta[i].w), 0);
    }
    if (rules.kept)
        for (std::size_t n = 0; n < store.size(); ++n)
            for (int k = 0; k < 4; ++k)
                c.expected["contact"].add(store[n][k], store_scale[n]);
    CHECK(open * 20 <= in.count); // else the reference would say nothing
    check_on_every_device(c);
}

} // namespace taut::conformance
