#include "taut/kernels/vbd_shift.hpp"

#include "support/rigid_sums.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

/// The motion that a body lacks.
struct Motion
{
    glm::dvec3 way{0}, centre{0}, half_turn{0};
    double size = 0; ///< of the way's terms over the inertia
};

Motion motion_of(const std::array<double, TAUT_VBD_DRIFT>& s)
{
    Motion out;
    out.way = glm::dvec3(s[1], s[2], s[3]) / s[0];
    out.centre = glm::dvec3(s[4], s[5], s[6]) / s[0];
    const glm::dvec3 c = out.centre, turn = glm::dvec3(s[7], s[8], s[9]) / s[0] - glm::cross(c, out.way);
    out.half_turn = 0.5 * rigid_turn_of(turn, c, glm::dvec3(s[10], s[11], s[12]) / s[0],
                                        glm::dvec3(s[13], s[14], s[15]) / s[0]);
    const double length = glm::length(out.half_turn);
    if (length > 0.25)
        out.half_turn *= 0.25 / length;
    return out;
}

glm::dvec3 turned(const glm::dvec3& half_turn, const glm::dvec3& r)
{
    const glm::dvec3 around = glm::cross(half_turn, r);
    return r + 2 / (1 + glm::dot(half_turn, half_turn)) * (around + glm::cross(half_turn, around));
}

} // namespace

TEMPLATE_TEST_CASE("vbd_shift moves and turns free bodies as a whole by what they lack", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    const double speed = GENERATE(1e-2, 1.0); // of which some turns are cut
    const bool contact = GENERATE(false, true);
    CAPTURE(count, words, speed, contact);
    Random random(1460 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3);
    auto predicted = random.vec4s<Real>(n, speed, 0, 0);
    for (auto& y : predicted)
        y.w = random.uniform<Real>(1, 3);
    const auto push = random.vec4s<Real>(n, 1e-3, 0, 0);
    std::vector<std::uint32_t> seen;
    for (std::uint32_t v = 0; v < n; ++v)
        seen.insert(seen.end(), {random.below(3), random.below(2)});
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (const double value : rigid_sums(parts, part, 3, position, predicted, delta, push).value)
            sums.push_back(static_cast<Real>(value));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"sums", bytes_of(sums)},
            {"delta", bytes_of(delta)},
            {"position", bytes_of(position)},
            {"seen", bytes_of(seen)}};
    const kernels::vbd_shift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {
        make_launch(kernels::vbd_shift::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    for (const BodyParts::Part& part : parts.parts)
    {
        if (part.held)
            continue;
        std::array<double, TAUT_VBD_DRIFT> body{};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::size_t k = 0; k < body.size(); ++k)
                body[k] += double(sums[TAUT_VBD_DRIFT * g + k]);
        Motion motion = motion_of(body);
        const glm::dvec3 pushed(body[16], body[17], body[18]);
        if (contact && seen[2 * (part.base + 3) + 1] != 0)
            motion.way -= pushed * glm::dot(motion.way, pushed) / glm::dot(pushed, pushed);
        const glm::dvec3 base(position[part.base + 3]);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const glm::dvec3 r = glm::dvec3(position[v]) - base + glm::dvec3(delta[v]) - motion.centre;
            want[v] += motion.way + turned(motion.half_turn, r) - r;
            // Squares of lengths of about 2 stand against their differences; the tensor is inverted.
            scale[v] = glm::length(glm::dvec3(delta[v])) + 4 * speed + 40 * (speed + glm::length(motion.way));
        }
    }
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}

// Of the formula of this test, which the kernel agrees with.
TEST_CASE("vbd_shift gives a body the momentum and angular momentum of its guess, and keeps its shape")
{
    using Real = double;
    Random random(1461);
    const BodyParts free = deal_parts(128); // of 1, 63 and 64; the last is free
    const std::uint32_t n = 128 + 9;
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    const auto delta = random.vec4s<Real>(n, 1e-3, 0, 1e-3);
    auto predicted = random.vec4s<Real>(n, 1e-3, 0, 0);
    for (auto& y : predicted)
        y.w = random.uniform<Real>(1, 3);
    for (const BodyParts::Part& part : free.parts)
    {
        if (part.held || part.end - part.first < 3)
            continue;
        std::array<double, TAUT_VBD_DRIFT> body{};
        for (const BodyParts::Part& other : free.parts)
            if (other.from == part.from)
                for (std::size_t k = 0; k < body.size(); ++k)
                    body[k] += rigid_sums(free, other, 3, position, predicted, delta).value[k];
        const Motion motion = motion_of(body);
        const glm::dvec3 base(position[part.base + 3]);
        glm::dvec3 momentum(0), angular(0);
        for (const BodyParts::Part& other : free.parts)
            for (std::uint32_t j = other.first; other.from == part.from && j < other.end; ++j)
            {
                const std::uint32_t v = free.order[j] + 3;
                const glm::dvec3 d(delta[v]), r = glm::dvec3(position[v]) - base + d - motion.centre;
                const glm::dvec3 after = d + motion.way + turned(motion.half_turn, r) - r;
                const glm::dvec3 lack = double(predicted[v].w) * (glm::dvec3(predicted[v]) - after);
                momentum += lack;
                angular += glm::cross(turned(motion.half_turn, r), lack);
            }
        CHECK(glm::length(momentum) < 1e-12 * body[0]);
        CHECK(glm::length(angular) < 1e-5 * body[0]); // of second order in the turn, from about 1e-3
    }
}
