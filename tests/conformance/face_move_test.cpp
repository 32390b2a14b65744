#include "taut/kernels/face_move.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

#include "taut/kernels/shared/face_state.h"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("a vertex goes by the mean of what its triangles were pushed by, weighed by their shares",
                   "[face]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t look = GENERATE(0u, 1u), slots = GENERATE(4u, 6u);
    const std::uint64_t seed = 7400 + count;
    CAPTURE(count, look, slots, seed);
    Random random(seed);
    const std::uint32_t triangles = count + 5;
    std::vector<std::uint32_t> start = {0}, incident, state, near;
    for (std::uint32_t t = 0; t < triangles; ++t)
        state.push_back(random.below(4));
    for (std::uint32_t v = 0; v < count; ++v)
    {
        const std::uint32_t degree = v == 0 ? 200 : random.below(9);
        for (std::uint32_t k = 0; k < degree; ++k)
            incident.push_back(random.below(slots * triangles));
        start.push_back(static_cast<std::uint32_t>(incident.size()));
        near.push_back(random.below(2));
    }
    const auto slot = random.vec4s<Real>(slots * std::size_t(triangles), 0.1, 0, 1);
    const auto delta = random.vec4s<Real>(count + 3, 1, 0, 0.02);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)}, {"incident", bytes_of(incident)}, {"slot", bytes_of(slot)},
            {"state", bytes_of(state)}, {"delta", bytes_of(delta)},       {"near", bytes_of(near)}};
    c.launches = {make_launch(kernels::face_move::info("", c.precision),
                              kernels::face_move::Params{count, slots, look}, count)};
    Field& field = c.expected["delta"];
    for (std::uint32_t v = 0; v < delta.size(); ++v)
    {
        glm::dvec3 sum(0);
        double share = 0, size = 0;
        for (std::uint32_t k = v < count ? start[v] : 0; v < count && k < start[v + 1]; ++k)
            if (state[incident[k] / slots] == TAUT_FACE_PUSHED && (look != 0 || near[v] != 0))
            {
                const glm::dvec4 way(slot[incident[k]]);
                sum += glm::dvec3(way) * way.w;
                share += way.w;
                size += glm::length(glm::dvec3(way)) * way.w;
            }
        for (int axis = 0; axis < 3; ++axis)
        {
            const double was = static_cast<double>(delta[v][axis]);
            field.add(share > 0 ? was + sum[axis] / share : was,
                      share > 0 ? std::abs(was) + size / share : 0);
        }
        field.add(static_cast<double>(delta[v].w), 0);
    }
    check_on_every_device(c);
}

TEST_CASE("which vertices are near is told by their triangles where these were just asked", "[face]")
{
    const std::vector<std::uint32_t> start = {0, 2, 4, 4}, incident = {0, 4, 1, 8}, state = {0, 0, 1};
    const std::vector<glm::vec4> slot(12, glm::vec4(0)), delta(3, glm::vec4(0));
    const std::vector<std::uint32_t> near = {1, 0, 1};
    const Launch launch =
        make_launch(kernels::face_move::info("", Precision::float32), kernels::face_move::Params{3, 4, 1}, 3);
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        const Buffers out = run(*test_device(selector), {launch},
                                {{"start", bytes_of(start)},
                                 {"incident", bytes_of(incident)},
                                 {"slot", bytes_of(slot)},
                                 {"state", bytes_of(state)},
                                 {"delta", bytes_of(delta)},
                                 {"near", bytes_of(near)}});
        CHECK(values_of<std::uint32_t>(out.at("near")) == std::vector<std::uint32_t>{0, 1, 0});
    }
}
