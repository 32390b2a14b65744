#include "taut/kernels/momentum_turn.hpp"

#include "support/rigid_sums.hpp"

#define TAUT_HOST
#include "taut/kernels/shared/layouts.h"

using namespace taut;
using namespace taut::conformance;

namespace {

/// The turn and the centre of mass, from the body's first row, of a body of these sums.
struct Turn
{
    glm::dvec3 turn{0}, centre{0};
};

Turn turn_of(const std::array<double, TAUT_MOMENTUM_SUMS>& s)
{
    const auto mean = [&](std::size_t k) { return glm::dvec3(s[k], s[k + 1], s[k + 2]) / s[0]; };
    return {rigid_turn_of(mean(1), mean(4), mean(7), mean(10)), mean(4)};
}

/// m^2/s, a vertex; alike at the first vertices of all groups of a body.
template <typename Real>
auto owed_by(const BodyParts& parts, Random& random, std::uint32_t count, double most)
{
    auto out = random.vec4s<Real>(count, most, 0, 1);
    for (const BodyParts::Part& part : parts.parts)
        out[parts.order[part.first]] = out[parts.order[parts.parts[part.from].first]];
    return out;
}

} // namespace

TEMPLATE_TEST_CASE("momentum_turn takes off what a displacement begins from, by a velocity that turns", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const double speed = GENERATE(1e-4, 1.0); // of which turns are given back in part
    const double owing = GENERATE(0.0, 1.0);
    CAPTURE(count, speed, owing);
    Random random(1490 + count);
    const BodyParts parts = deal_parts(count);
    const auto position = random.vec4s<Real>(count, 1, 0.1, 10);
    const auto before = random.vec4s<Real>(count, speed, 0, 1), delta = random.vec4s<Real>(count, 1e-2, 0, 1);
    const auto low = random.vec4s<Real>(count, 1e-7, 0, 1e-3);
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 512);
    const auto owed = owed_by<Real>(parts, random, count, owing);
    std::vector<glm::dvec4> left(owed.begin(), owed.end());
    std::vector<double> left_scale(count, 0.0);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (const double value : momentum_sums(parts, part, position, before, delta).value)
            sums.push_back(static_cast<Real>(value));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind({}))},
            {"sums", bytes_of(sums)},
            {"position", bytes_of(position)},
            {"delta", bytes_of(delta)},
            {"low", bytes_of(low)},
            {"owed", bytes_of(owed)},
            {"step_values", bytes_of(std::vector{step})}};
    c.launches = {make_launch(kernels::momentum_turn::info("", c.precision),
                              kernels::momentum_turn::Params{parts.groups}, parts.groups)};
    std::vector<glm::dvec3> want(low.begin(), low.end());
    std::vector<double> scale(count, 0.0);
    for (const BodyParts::Part& part : parts.parts)
    {
        std::array<double, TAUT_MOMENTUM_SUMS> body{};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::size_t k = 0; k < body.size(); ++k)
                body[k] += double(sums[TAUT_MOMENTUM_SUMS * g + k]);
        const std::uint32_t first = parts.order[part.first];
        for (int k = 0; k < 3; ++k)
            body[1 + std::size_t(k)] += body[0] * double(owed[first][k]) * double(step.substep);
        Turn motion = turn_of(body);
        const double size = glm::length(motion.turn), share = size > 0.002 ? 0.002 / size : 1;
        motion.turn *= share;
        const glm::dvec3 lack = glm::dvec3(body[1], body[2], body[3]) / body[0] / double(step.substep);
        left[first] = {(1 - share) * lack, 0};
        left_scale[first] = 20 * (512 * speed + owing);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j];
            const glm::dvec3 r = glm::dvec3(position[v]) - glm::dvec3(position[part.base]) +
                                 glm::dvec3(delta[v]) - motion.centre;
            want[v] -= glm::cross(motion.turn, r);
            scale[v] = 40 * (speed + owing / 512); // lengths of about 2, the tensor is inverted
        }
    }
    for (std::uint32_t v = 0; v < count; ++v)
        for (int k = 0; k < 4; ++k)
        {
            c.expected["low"].add(k < 3 ? want[v][k] : double(low[v].w), k < 3 ? scale[v] : 0);
            c.expected["owed"].add(left[v][k], k < 3 ? left_scale[v] : 0);
        }
    check_on_every_device(c);
}

// Of the formula of this test, which the kernel agrees with.
TEST_CASE("momentum_turn gives bodies back the angular momentum that they began with, and no momentum")
{
    Random random(1495);
    const BodyParts parts = deal_parts(258); // of 1, 63, 64 and 130
    const auto position = random.vec4s<double>(258, 1, 0.1, 10);
    const auto before = random.vec4s<double>(258, 0.1, 0, 1), delta = random.vec4s<double>(258, 0.1, 0, 1);
    std::uint32_t bodies = 0;
    for (const BodyParts::Part& first : parts.parts)
    {
        if (first.first != 0 && parts.parts[&first - parts.parts.data() - 1].from == first.from)
            continue; // not the first part of a body
        std::array<double, TAUT_MOMENTUM_SUMS> body{};
        std::uint32_t end = first.first;
        for (std::uint32_t g = first.from; g < first.to; ++g)
        {
            end = parts.parts[g].end;
            for (std::size_t k = 0; k < body.size(); ++k)
                body[k] += momentum_sums(parts, parts.parts[g], position, before, delta).value[k];
        }
        const Turn motion = turn_of(body);
        glm::dvec3 momentum(0), angular(0);
        for (std::uint32_t j = first.first; j < end; ++j)
        {
            const std::uint32_t v = parts.order[j];
            const double mass = 1 / position[v].w;
            const glm::dvec3 x = glm::dvec3(position[v]) - glm::dvec3(position[first.base]), d(delta[v]);
            const glm::dvec3 added = glm::cross(motion.turn, x + d - motion.centre);
            momentum += mass * added;
            angular += mass * (glm::cross(x + d, added) - glm::cross(x, glm::dvec3(before[v]) - d));
        }
        CHECK(glm::length(momentum) < 1e-12 * body[0]);
        if (end - first.first >= 3)
            CHECK(glm::length(angular) < 1e-12 * body[0]);
        ++bodies;
    }
    CHECK(bodies == 4);
}
