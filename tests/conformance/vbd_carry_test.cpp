#include "taut/kernels/vbd_carry.hpp"

#include "support/vbd_feet.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_carry sums how the surfaces move that the guess goes below", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u), surfaces = GENERATE(0u, 50u);
    CAPTURE(count, words, surfaces);
    Random random(1500 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9, carry = 5;
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    const auto predicted = random.vec4s<Real>(n, 1, 0, 1);
    const auto contacts = random_surfaces<Real>(random, surfaces, predicted);
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"row", bytes_of(parts.behind(row))},
            {"position", bytes_of(position)},
            {"predicted", bytes_of(predicted)},
            {"contacts", bytes_of(contacts)},
            {"sums", bytes_of(std::vector<Real>(carry + TAUT_VBD_DRIFT * parts.groups + 3, Real(7)))}};
    const kernels::vbd_carry::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words,
                                            surfaces, carry};
    c.launches = {make_launch(kernels::vbd_carry::info("", c.precision), params, parts.groups)};
    Field& field = c.expected["sums"];
    for (std::uint32_t k = 0; k < carry; ++k)
        field.add(7, 0);
    for (const BodyParts::Part& part : parts.parts)
    {
        std::array<double, TAUT_VBD_DRIFT> value{}, size{};
        const glm::dvec3 base(position[part.base + 3]);
        for (std::uint32_t j = part.first; j < part.end && !part.held; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const std::size_t at = surfaces + 3 * std::size_t{v};
            const glm::dvec3 normal(contacts[at]), way(contacts[at + 1]), guess(predicted[v]);
            const double depth = std::max(double(contacts[at].w) - glm::dot(normal, guess), 0.0);
            const double deep = std::abs(double(contacts[at].w)) + glm::length(guess);
            const glm::dvec3 r = glm::dvec3(position[v]) - base, turn = glm::cross(r, way);
            const double far = glm::length(glm::dvec3(position[v])) + glm::length(base);
            const auto add = [&](std::size_t k, double term, double terms) {
                value[k] += depth * term;
                size[k] += deep * terms;
            };
            add(0, 1, 1);
            for (int axis = 0; axis < 3; ++axis)
            {
                const auto k = static_cast<std::size_t>(axis);
                add(1 + k, way[axis], glm::length(way));
                add(4 + k, r[axis], far);
                add(7 + k, turn[axis], 4 * far * glm::length(way));
                add(10 + k, r[axis] * r[axis], 2 * far * far);
                add(13 + k, r[(axis + 1) % 3] * r[(axis + 2) % 3], 2 * far * far);
            }
        }
        for (std::size_t k = 0; k < TAUT_VBD_DRIFT; ++k)
            field.add(value[k], size[k]);
    }
    for (int k = 0; k < 3; ++k)
        field.add(7, 0);
    check_on_every_device(c);
}
