#include "taut/kernels/wind.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("a vertex gets the impulses of its triangles by its inverse mass", "[wind]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 129u, 1000u);
    const std::uint64_t seed = 1700 + count;
    CAPTURE(count, seed);
    Random random(seed);
    const std::uint32_t triangles = count + 4;
    auto position = random.vec4s<Real>(count + 3, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    const auto velocity = random.vec4s<Real>(count + 3, 5, 0, 0);
    const auto impulse = random.vec4s<Real>(triangles, 0.1, 0, 0);
    std::vector<std::uint32_t> first = {0}, incident;
    for (std::uint32_t v = 0; v < count; ++v)
    {
        const std::uint32_t degree = v == 0 ? 300 : random.below(9); // some have none, one has many
        for (std::uint32_t k = 0; k < degree; ++k)
            incident.push_back(random.below(triangles));
        first.push_back(static_cast<std::uint32_t>(incident.size()));
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"first", bytes_of(first)},
            {"incident", bytes_of(incident)},
            {"impulse", bytes_of(impulse)},
            {"position", bytes_of(position)},
            {"velocity", bytes_of(velocity)}};
    c.launches = {
        make_launch(kernels::wind::info("", c.precision), kernels::wind::Params{count}, count)};
    Field& field = c.expected["velocity"];
    for (std::uint32_t v = 0; v < velocity.size(); ++v)
    {
        glm::dvec3 sum(0), size(0);
        for (std::uint32_t k = v < count ? first[v] : 0; v < count && k < first[v + 1]; ++k)
        {
            sum += glm::dvec3(impulse[incident[k]]);
            size += glm::abs(glm::dvec3(impulse[incident[k]]));
        }
        const double w = static_cast<double>(position[v].w);
        for (int k = 0; k < 3; ++k)
        {
            const double was = static_cast<double>(velocity[v][k]);
            field.add(was + w * sum[k], v < count && w > 0 ? std::abs(was) + w * size[k] : 0);
        }
        field.add(0, 0);
    }
    check_on_every_device(c);
}
