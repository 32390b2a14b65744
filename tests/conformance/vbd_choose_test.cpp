#include "taut/kernels/vbd_choose.hpp"

#include "support/block_parts.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_choose takes the fallback where the sums say that the start is above it", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    CAPTURE(count, words);
    Random random(1420 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3), low = random.vec4s<Real>(n, 1e-8, 0, 1e-3);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (std::uint32_t k = 0; k < TAUT_VBD_SUMS; ++k)
            sums.push_back(k < 10 ? random.uniform<Real>(k == 1 ? 1 : -1, 1 + 2 * (k == 1))
                                 : Real(0.01 * (k + part.from)));
    for (std::uint32_t k = 0; k < TAUT_VBD_FALL; ++k)
        sums.push_back(Real(7));
    layout::StepValues<Real> step{};
    step.substep = Real(1.0 / 600);
    step.gravity_x = Real(0.5);
    step.gravity_y = Real(-9.81);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"low", bytes_of(low)},
            {"sums", bytes_of(sums)},
            {"delta", bytes_of(delta)},
            {"step_values", bytes_of(std::vector{step})}};
    const kernels::vbd_choose::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {make_launch(kernels::vbd_choose::info("", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    std::uint32_t taken = 0;
    for (const BodyParts::Part& part : parts.parts)
    {
        double sum[8] = {};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::uint32_t k = 0; k < 8; ++k)
                sum[k] += double(sums[TAUT_VBD_SUMS * g + k]);
        const glm::dvec3 mean = glm::dvec3(sum[2], sum[3], sum[4]) / sum[1], guess(sum[5], sum[6], sum[7]);
        const double rise = sum[0] + glm::dot(mean, guess) - 0.5 * sum[1] * glm::dot(mean, mean);
        if (part.held ? sum[0] <= 0 : rise <= 0)
            continue;
        ++taken;
        const std::size_t at = TAUT_VBD_SUMS * part.from + 10;
        const glm::dvec3 origin(sums[at], sums[at + 1], sums[at + 2]);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            want[v] = glm::dvec3(low[v]) + (part.held ? glm::dvec3(0) : mean + origin);
            scale[v] = glm::length(glm::dvec3(low[v])) + glm::length(origin) + 4 / sum[1];
        }
    }
    if (count == 1000)
        CHECK((taken > 2 && taken + 2 < parts.groups));
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    const double square = double(step.substep) * double(step.substep);
    for (std::size_t k = 0; k + TAUT_VBD_FALL < sums.size(); ++k)
        c.expected["sums"].add(double(sums[k]), 0);
    for (const double pull : {double(step.gravity_x), double(step.gravity_y), 0.0})
        c.expected["sums"].add(pull * square, std::abs(pull) * square);
    check_on_every_device(c);
}
