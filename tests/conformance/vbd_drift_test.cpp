#include "taut/kernels/vbd_drift.hpp"

#include "support/block_parts.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_drift sums what bodies that nothing holds lack of momentum", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    CAPTURE(count, words);
    Random random(1440 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3);
    auto predicted = random.vec4s<Real>(n, 1e-2, 0, 0);
    for (auto& y : predicted)
        y.w = random.uniform<Real>(1, 1000);
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"predicted", bytes_of(predicted)},
            {"delta", bytes_of(delta)},
            {"sums", bytes_of(std::vector<Real>(4 * parts.groups + 3, Real(7)))}};
    const kernels::vbd_drift::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words};
    c.launches = {make_launch(kernels::vbd_drift::info("", c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    for (const BodyParts::Part& part : parts.parts)
    {
        glm::dvec4 sum(0), size(0);
        for (std::uint32_t j = part.first; j < part.end && !part.held; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const double inertia = double(predicted[v].w);
            const glm::dvec3 lack = glm::dvec3(predicted[v]) - glm::dvec3(delta[v]);
            sum += inertia * glm::dvec4(lack, 1);
            size += inertia * glm::dvec4(glm::dvec3(glm::length(glm::dvec3(predicted[v])) +
                                                    glm::length(glm::dvec3(delta[v]))), 1);
        }
        for (int k = 0; k < 4; ++k)
            field.add(sum[k], size[k]);
    }
    for (int k = 0; k < 3; ++k)
        field.add(7, 0);
    check_on_every_device(c);
}
