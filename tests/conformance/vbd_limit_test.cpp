#include "taut/kernels/vbd_limit.hpp"

#include "support/block_parts.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_limit takes the share of a way that makes no more energy than was lost", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    CAPTURE(count, words);
    Random random(1480 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3), low = random.vec4s<Real>(n, 1e-8, 0, 1e-3);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (std::uint32_t k = 0; k < TAUT_VBD_SUMS; ++k)
            sums.push_back(k >= 10               ? Real(0.01 * (k + part.from)) // of the body
                           : k == 1              ? random.uniform<Real>(1, 3)
                           : k == 8 || k == 9    ? random.uniform<Real>(4, 9)
                                                 : random.uniform<Real>(-1, 1));
    std::vector<Real> lost; // nothing, less than is needed, more
    for (const BodyParts::Part& part : parts.parts) // alike in all groups of a body
        lost.push_back(part.from < lost.size() ? lost[part.from]
                       : random.chance(0.3)    ? Real(0)
                                               : random.uniform<Real>(0, 4));
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"low", bytes_of(low)},
            {"sums", bytes_of(sums)},
            {"delta", bytes_of(delta)},
            {"lost", bytes_of(lost)}};
    const kernels::vbd_limit::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {make_launch(kernels::vbd_limit::info("", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    std::uint32_t shortened = 0;
    for (const BodyParts::Part& part : parts.parts)
    {
        double sum[10] = {};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::uint32_t k = 0; k < 10; ++k)
                sum[k] += double(sums[TAUT_VBD_SUMS * g + k]);
        const glm::dvec3 mean(sum[2], sum[3], sum[4]), came(sum[5], sum[6], sum[7]);
        double had = 0.5 * sum[9], has = sum[0] + 0.5 * sum[8];
        if (!part.held)
        {
            had -= 0.5 * glm::dot(came, came) / sum[1];
            has -= 0.5 * glm::dot(mean, mean) / sum[1];
        }
        const double spare = std::min(double(lost[part.from]), had), surplus = has - had;
        c.expected["lost"].add(std::min(spare - std::min(surplus, spare), had),
                               8 * (std::abs(sum[0]) + sum[8] + sum[9]));
        if (has <= had + spare)
            continue;
        ++shortened;
        const std::size_t at = TAUT_VBD_SUMS * part.from + 10;
        const glm::dvec3 origin(sums[at], sums[at + 1], sums[at + 2]);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const glm::dvec3 still =
                glm::dvec3(low[v]) + (part.held ? glm::dvec3(0) : mean / sum[1] + origin);
            scale[v] = 8 * (glm::length(still) + glm::length(want[v]) + glm::length(mean / sum[1]));
            want[v] = still + (want[v] - still) * ((had + spare) / has);
        }
    }
    if (count == 1000)
        CHECK((shortened > 2 && shortened + 2 < parts.groups));
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    check_on_every_device(c);
}
