#pragma once
// How a body stands on surfaces, in fp64: what vbd_drift sums of its feet, and the motion as a whole that
// kernels/shared/vbd_wrench.glsl allows it, with tensors as matrices.

#include "support/rigid_sums.hpp"
#include "support/vbd_carrier.hpp"

#include <Eigen/Dense>

namespace taut::conformance {

/// Planes, drags and reactions of vertices as vbd_solve leaves them behind `first` other vectors. A third of
/// the vertices meet nothing, a third were pushed, the others were not, though their guess goes below.
template <typename Real>
std::vector<glm::vec<4, Real>> random_surfaces(Random& random, std::uint32_t first,
                                               const std::vector<glm::vec<4, Real>>& predicted)
{
    auto out = random.vec4s<Real>(first, 1, 0, 1);
    for (const auto& y : predicted)
    {
        const std::uint32_t kind = random.below(3);
        const glm::dvec3 n = glm::normalize(glm::dvec3(random.vec4<double>(0.3, 0)) + glm::dvec3(0, 2, 0));
        const double way = glm::length(glm::dvec3(y)), depth = way * random.uniform(0.2, 1);
        const glm::dvec3 drag = glm::dvec3(random.vec4<double>(0.2 * way, 0));
        const bool sticks = random.chance(0.5);
        const glm::dvec3 force = double(y.w) * (n * depth + glm::dvec3(random.vec4<double>(0.1 * way, 0)));
        // Alone, a foot holds with a friction of 30 and slips with one below a tenth.
        const double friction = kind == 2 && sticks ? 30 : random.uniform(0.02, 0.1);
        const bool near = kind != 0, pushed = kind == 1;
        out.emplace_back(glm::dvec4(near ? n : glm::dvec3(0), glm::dot(n, glm::dvec3(y)) + depth));
        out.emplace_back(glm::dvec4(near ? drag : glm::dvec3(0), friction));
        out.emplace_back(glm::dvec4(pushed ? force : glm::dvec3(0), pushed && sticks ? 1 : 0));
    }
    return out;
}

struct FeetSums
{
    std::array<double, TAUT_VBD_TOUCH + TAUT_VBD_RUBBING> value{}, size{};
};

/// Vertex v, and its place from the body's first row, before its displacement.
template <typename Vec4>
void add_foot(FeetSums& out, const Vec4& y, const Vec4& displacement, const Vec4& push, const Vec4* contact,
              const glm::dvec3& x, double far, const glm::dvec3& carried)
{
    const glm::dvec3 n(contact[0]), drag(contact[1]), reaction(contact[2]), d(displacement), guess(y);
    const double inertia = double(y.w), least = double(contact[0].w), mu = double(contact[1].w);
    const auto along = [&](const glm::dvec3& v) { return v - drag - n * glm::dot(n, v - drag); };
    const bool near = n != glm::dvec3(0), pushed = glm::dot(n, reaction) > 0;
    const double depth = near ? std::max(least - glm::dot(n, guess), 0.0) : 0;
    const double force = pushed ? glm::dot(n, reaction) : depth * inertia;
    const double force_size = pushed ? glm::length(reaction)
                              : near ? inertia * (std::abs(least) + glm::length(guess))
                                     : 0;
    const bool holds = pushed ? contact[2].w > 0 : glm::length(along(guess)) <= mu * depth;
    const glm::dvec3 r = x + d, slip = force > 0 ? along(d) : glm::dvec3(0), wants = along(guess);
    const double size = glm::length(wants), way = glm::length(d) + glm::length(drag),
                 doubt = size > 0 ? (glm::length(guess) + glm::length(drag)) / size : 0;
    const glm::dvec3 rub = force > 0 && !holds && size > 0 ? wants * (mu * force / size) : glm::dvec3(0);
    const double rub_size = holds ? 0 : mu * force_size * (1 + doubt);
    const auto add = [&](std::size_t k, double term, double terms) {
        out.value[k] += term;
        out.size[k] += terms;
    };
    const double counts = force > 0 ? 1 : 0;
    constexpr std::size_t kRub = TAUT_VBD_TOUCH;
    add(TAUT_VBD_SIZE, force, force_size);
    add(TAUT_VBD_HOLD, holds ? mu * force : 0, holds ? mu * force_size : 0);
    add(TAUT_VBD_COUNT, counts, counts);
    const glm::dvec3 moved = d - carried, slip_turn = glm::cross(r, slip), rub_turn = glm::cross(r, rub),
                     moved_turn = glm::cross(r, moved);
    const double ways = glm::length(d) + 4 * glm::length(carried) * (1 + far);
    for (int c = 0; c < 3; ++c)
    {
        const auto k = static_cast<std::size_t>(c);
        add(TAUT_VBD_PUSHED + k, inertia * double(push[c]), inertia * std::abs(double(push[c])));
        add(TAUT_VBD_PUSH + k, force > 0 ? n[c] * force : 0, force_size);
        add(TAUT_VBD_FEET + k, counts * r[c], counts * far);
        add(TAUT_VBD_FEET_SQUARE + k, counts * r[c] * r[c], 2 * counts * far * far);
        add(TAUT_VBD_FEET_MIXED + k, counts * r[(c + 1) % 3] * r[(c + 2) % 3], 2 * counts * far * far);
        add(kRub + TAUT_VBD_SLIP + k, slip[c] * force, 2 * way * force_size);
        add(kRub + TAUT_VBD_SLIP_TURN + k, slip_turn[c] * force, 8 * far * way * force_size);
        add(kRub + TAUT_VBD_RUB + k, rub[c], rub_size);
        add(kRub + TAUT_VBD_RUB_TURN + k, rub_turn[c], 4 * far * rub_size);
        add(kRub + TAUT_VBD_MOVED + k, inertia * moved[c], inertia * ways);
        add(kRub + TAUT_VBD_MOVED_TURN + k, inertia * moved_turn[c], inertia * 4 * far * ways);
    }
    const double height = force > 0 ? std::max(glm::dot(n, d) - least, 0.0) : 0;
    add(kRub + TAUT_VBD_HEIGHT, height * force, (glm::length(d) + std::abs(least)) * force_size);
}

/// Of the rows of a part; `surfaces`: where in `contacts` they begin.
template <typename Vec4>
FeetSums feet_sums(const BodyParts& parts, std::size_t group, std::uint32_t first_vertex,
                   const std::vector<Vec4>& position, const std::vector<Vec4>& predicted,
                   const std::vector<Vec4>& delta, const std::vector<Vec4>& push,
                   const std::vector<Vec4>& contacts, std::uint32_t surfaces,
                   const std::vector<Carrier>& carriers)
{
    FeetSums out;
    const BodyParts::Part& part = parts.parts[group];
    const glm::dvec3 base(position[part.base + first_vertex]);
    for (std::uint32_t j = part.first; j < part.end && !part.held; ++j)
    {
        const std::uint32_t v = parts.order[j] + first_vertex;
        const glm::dvec3 x = glm::dvec3(position[v]) - base;
        const double far =
            glm::length(glm::dvec3(position[v])) + glm::length(base) + glm::length(glm::dvec3(delta[v]));
        add_foot(out, predicted[v], delta[v], push[v], &contacts[surfaces + TAUT_VBD_CONTACT * v], x, far,
                 carriers[group].carries ? carriers[group].way_at(x) : glm::dvec3(0));
    }
    return out;
}

} // namespace taut::conformance
