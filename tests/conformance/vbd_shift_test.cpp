#include "taut/kernels/vbd_shift.hpp"

#include "support/block_parts.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_shift moves free bodies by what they lack, where they touch across gravity", "",
                   float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    const bool contact = GENERATE(false, true);
    const double pull = GENERATE(9.81, 0.0);
    CAPTURE(count, words, contact, pull);
    Random random(1460 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3);
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    std::vector<Real> sums;
    std::vector<std::uint32_t> seen;
    for (std::uint32_t k = 0; k < 4 * parts.groups; ++k)
        sums.push_back(random.uniform<Real>(k % 4 == 3 ? 1 : -1, k % 4 == 3 ? 3 : 1));
    for (std::uint32_t v = 0; v < n; ++v)
        seen.insert(seen.end(), {random.below(3), random.below(2)});
    layout::StepValues<Real> step{};
    step.gravity_x = Real(0.5 * pull);
    step.gravity_y = Real(-pull);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"sums", bytes_of(sums)},
            {"delta", bytes_of(delta)},
            {"seen", bytes_of(seen)},
            {"step_values", bytes_of(std::vector{step})}};
    const kernels::vbd_shift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {
        make_launch(kernels::vbd_shift::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    for (const BodyParts::Part& part : parts.parts)
    {
        if (part.held)
            continue;
        glm::dvec3 lack(0);
        double inertia = 0, size = 0;
        for (std::uint32_t g = part.from; g < part.to; ++g)
        {
            const glm::dvec3 own(sums[4 * g], sums[4 * g + 1], sums[4 * g + 2]);
            lack += own;
            size += glm::length(own);
            inertia += double(sums[4 * g + 3]);
        }
        glm::dvec3 way = lack / inertia;
        const glm::dvec3 gravity(step.gravity_x, step.gravity_y, step.gravity_z);
        if (contact && pull > 0 && seen[2 * (part.base + 3) + 1] != 0)
            way -= gravity * glm::dot(way, gravity) / glm::dot(gravity, gravity);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            want[v] += way;
            scale[v] = glm::length(glm::dvec3(delta[v])) + 3 * size / inertia;
        }
    }
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}
