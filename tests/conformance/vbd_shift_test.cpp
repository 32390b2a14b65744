#include "taut/kernels/vbd_shift.hpp"

#include "support/vbd_standing.hpp"

using namespace taut;
using namespace taut::conformance;

namespace {

glm::dvec3 half_turn_of(const glm::dvec3& turn)
{
    const double length = 0.5 * glm::length(turn);
    return 0.5 * turn * (length > 0.25 ? 0.25 / length : 1);
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
    const auto contacts = random_surfaces<Real>(random, 0, predicted);
    std::vector<Real> frames;
    const auto carriers = add_frames(frames, parts, random);
    std::vector<std::uint32_t> seen;
    for (std::uint32_t v = 0; v < n; ++v)
        seen.insert(seen.end(), {random.below(3), random.below(2)});
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    const glm::dvec3 fall(0.25 * speed, -0.5 * speed, 0.125 * speed);
    std::vector<Real> sums, lost;
    for (std::size_t g = 0; g < parts.groups; ++g)
    {
        for (const double v : rigid_sums(parts, parts.parts[g], 3, position, predicted, delta).value)
            sums.push_back(static_cast<Real>(v));
        const bool bare = parts.parts[g].from % 3 == 1; // of some bodies no vertex meets anything
        for (const double v :
             feet_sums(parts, g, 3, position, predicted, delta, push, contacts, 0, carriers).value)
            sums.push_back(bare && sums.size() % TAUT_VBD_PARTS >= TAUT_VBD_DRIFT + TAUT_VBD_PUSH
                               ? Real(0)
                               : static_cast<Real>(v));
        lost.push_back(parts.parts[g].from < g ? lost.back() : random.uniform<Real>(-1, 1));
    }
    for (int k = 0; k < 3; ++k)
        sums.push_back(static_cast<Real>(fall[k]));
    const auto frame = static_cast<std::uint32_t>(sums.size());
    sums.insert(sums.end(), frames.begin(), frames.end());
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))}, {"sums", bytes_of(sums)}, {"delta", bytes_of(delta)},
            {"position", bytes_of(position)},     {"seen", bytes_of(seen)}, {"lost", bytes_of(lost)}};
    const kernels::vbd_shift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words,
                                            frame};
    c.launches = {
        make_launch(kernels::vbd_shift::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0), debt(lost.begin(), lost.end()), debt_scale(lost.size(), 0.0);
    for (std::size_t g = 0; g < parts.groups; ++g)
    {
        const BodyParts::Part& part = parts.parts[g];
        std::array<double, TAUT_VBD_PARTS> body{};
        for (std::uint32_t other = part.from; other < part.to; ++other)
            for (std::size_t k = 0; k < body.size(); ++k)
                body[k] += double(sums[TAUT_VBD_PARTS * other + k]);
        if (part.held)
            continue;
        const Standing standing(body);
        RigidShift shift = contact && standing.stands() ? standing.on_its_feet() : standing.free();
        const glm::dvec3 pushed = standing.pushed();
        if (contact && !standing.stands() && seen[2 * (part.base + 3) + 1] != 0)
            shift.way -= pushed * (glm::dot(shift.way, pushed) / glm::dot(pushed, pushed));
        const double added = standing.mass() * standing.energy(shift, fall);
        if (contact && carriers[g].carries)
        {
            debt[g] -= std::max(added, 0.0);
            debt_scale[g] = 40 * standing.mass() * (speed + 0.05) * (speed + 0.05);
        }
        const glm::dvec3 base(position[part.base + 3]), half_turn = half_turn_of(shift.turn);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const glm::dvec3 r = glm::dvec3(position[v]) - base + glm::dvec3(delta[v]) - shift.centre;
            want[v] += shift.way + turned(half_turn, r) - r;
            // Squares of lengths of about 2 stand against their differences; the tensor is inverted.
            scale[v] = glm::length(glm::dvec3(delta[v])) + 4 * speed + 40 * (speed + glm::length(shift.way));
        }
    }
    if (contact)
        for (std::size_t g = 0; g < lost.size(); ++g)
            c.expected["lost"].add(debt[g], debt_scale[g]);
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
        std::array<double, TAUT_VBD_PARTS> body{};
        for (const BodyParts::Part& other : free.parts)
            if (other.from == part.from)
                for (std::size_t k = 0; k < TAUT_VBD_DRIFT; ++k)
                    body[k] += rigid_sums(free, other, 3, position, predicted, delta).value[k];
        const RigidShift motion = Standing(body).free();
        const glm::dvec3 half_turn = half_turn_of(motion.turn);
        const glm::dvec3 base(position[part.base + 3]);
        glm::dvec3 momentum(0), angular(0);
        for (const BodyParts::Part& other : free.parts)
            for (std::uint32_t j = other.first; other.from == part.from && j < other.end; ++j)
            {
                const std::uint32_t v = free.order[j] + 3;
                const glm::dvec3 d(delta[v]), r = glm::dvec3(position[v]) - base + d - motion.centre;
                const glm::dvec3 after = d + motion.way + turned(half_turn, r) - r;
                const glm::dvec3 lack = double(predicted[v].w) * (glm::dvec3(predicted[v]) - after);
                momentum += lack;
                angular += glm::cross(turned(half_turn, r), lack);
            }
        CHECK(glm::length(momentum) < 1e-12 * body[0]);
        CHECK(glm::length(angular) < 1e-5 * body[0]); // of second order in the turn, from about 1e-3
    }
}
