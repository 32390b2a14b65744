#include "taut/kernels/vbd_choose.hpp"

#include "support/vbd_carrier.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_choose takes the fallback where the sums say that the start is above it", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 65u, 1000u);
    const std::uint32_t words = GENERATE(4u, 5u);
    const bool contact = GENERATE(false, true);
    CAPTURE(count, words, contact);
    Random random(1420 + count);
    const BodyParts parts = deal_parts(count);
    const std::uint32_t n = count + 9;
    const std::vector<std::uint32_t> row = parts.plain_rows(words, 3);
    const auto delta = random.vec4s<Real>(n, 1e-2, 0, 1e-3), low = random.vec4s<Real>(n, 1e-8, 0, 1e-3);
    const auto position = random.vec4s<Real>(n, 1, 0, 1);
    std::vector<Real> sums;
    for (const BodyParts::Part& part : parts.parts)
        for (std::uint32_t k = 0; k < TAUT_VBD_SUMS; ++k)
            sums.push_back(k < 10 ? random.uniform<Real>(k == 1 ? 1 : -1, 1 + 2 * (k == 1))
                                  : Real(0.01 * (k + part.from)));
    const std::uint32_t fall = TAUT_VBD_PARTS * parts.groups;
    sums.resize(fall + TAUT_VBD_FALL + 2, Real(7));
    const std::uint32_t frame = contact ? static_cast<std::uint32_t>(sums.size()) : 0;
    const std::vector<Carrier> carriers = add_frames(sums, parts, random);
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
            {"step_values", bytes_of(std::vector{step})},
            {"position", bytes_of(position)}};
    const kernels::vbd_choose::Params params{parts.groups, static_cast<std::uint32_t>(row.size()), words,
                                             frame};
    c.launches = {
        make_launch(kernels::vbd_choose::info(contact ? "contact" : "", c.precision), params, parts.groups)};
    std::vector<glm::dvec3> want(delta.begin(), delta.end());
    std::vector<double> scale(n, 0.0);
    std::array<std::uint32_t, 3> taken{}, kept{}; // of loose, held and carried bodies
    for (const BodyParts::Part& part : parts.parts)
    {
        const Carrier& carrier = carriers[part.from];
        const bool carried = contact && carrier.carries;
        const std::size_t kind = carried ? 2 : part.held ? 1 : 0;
        std::array<double, 8> sum{}, size{};
        for (std::uint32_t g = part.from; g < part.to; ++g)
            for (std::uint32_t k = 0; k < 8; ++k)
            {
                sum[k] += double(sums[TAUT_VBD_SUMS * g + k]);
                size[k] += std::abs(double(sums[TAUT_VBD_SUMS * g + k]));
            }
        const glm::dvec3 mean = glm::dvec3(sum[2], sum[3], sum[4]) / sum[1], guess(sum[5], sum[6], sum[7]);
        const std::size_t at = TAUT_VBD_SUMS * part.from + 10;
        const glm::dvec3 origin(sums[at], sums[at + 1], sums[at + 2]);
        // Of held and carried bodies the sums are against the fallback itself.
        const double rise =
            kind == 0 ? sum[0] + glm::dot(mean, guess) - 0.5 * sum[1] * glm::dot(mean, mean) : sum[0];
        ++(rise > 0 ? taken : kept)[kind];
        if (rise <= 0)
            continue;
        const glm::dvec3 base(position[part.base + 3]);
        for (std::uint32_t j = part.first; j < part.end; ++j)
        {
            const std::uint32_t v = parts.order[j] + 3;
            const glm::dvec3 place(position[v]);
            want[v] = glm::dvec3(low[v]);
            scale[v] = glm::length(glm::dvec3(low[v]));
            if (carried)
            {
                want[v] += carrier.way_at(place - base);
                scale[v] += carrier.size(glm::length(place) + glm::length(base));
            }
            else if (!part.held)
            {
                want[v] += mean + origin;
                scale[v] += glm::length(glm::dvec3(size[2], size[3], size[4])) / sum[1] + glm::length(origin);
            }
        }
    }
    for (std::size_t kind = 0; count == 1000 && kind < (contact ? 3u : 2u); ++kind)
        CHECK((taken[kind] > 0 && kept[kind] > 0));
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 4; ++k)
            c.expected["delta"].add(k < 3 ? want[v][k] : double(delta[v].w), k < 3 ? scale[v] : 0);
    Field& field = c.expected["sums"];
    for (const Real value : sums)
        field.add(double(value), 0);
    const double square = double(step.substep) * double(step.substep);
    const double pull[TAUT_VBD_FALL] = {double(step.gravity_x), double(step.gravity_y), 0};
    for (std::size_t k = 0; k < TAUT_VBD_FALL; ++k)
    {
        field.value[fall + k] = pull[k] * square;
        field.scale[fall + k] = std::abs(pull[k]) * square;
    }
    check_on_every_device(c);
}
