#include "taut/kernels/vbd_progress.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_progress sums the motion of each body and stops one that moves more than at first",
                   "", float, double)
{
    using Real = TestType;
    const std::uint32_t first_iteration = GENERATE(0u, 1u);
    CAPTURE(first_iteration);
    Random random(1270);
    std::vector<std::uint32_t> start = {0};
    for (const std::uint32_t size : {1u, 63u, 64u, 65u, 1000u, 128u, 5u, 5u, 5u})
        start.push_back(start.back() + size);
    const auto bodies = static_cast<std::uint32_t>(start.size() - 1);
    const std::uint32_t n = start.back() + 3;
    auto position = random.vec4s<Real>(n, 1, 0, 0);
    for (auto& p : position)
        p.w = random.inverse_mass<Real>();
    const auto delta = random.vec4s<Real>(n, 1, -1, 1), newest = random.vec4s<Real>(n, 1, -1, 1);
    std::vector<Real> progress;
    Field field;
    for (std::uint32_t b = 0; b < bodies; ++b)
    {
        double sum = 0;
        for (std::uint32_t v = start[b]; v < start[b + 1]; ++v)
        {
            const glm::dvec3 moved = glm::dvec3(delta[v]) - glm::dvec3(newest[v]);
            sum += position[v].w > 0 ? glm::dot(moved, moved) / double(position[v].w) : 0;
        }
        // Before: far above, far below, or switched off already.
        const double most = b % 3 == 0 ? 0.5 * sum : 2 * sum + 1, on = b % 3 == 2 ? 0 : 1;
        progress.insert(progress.end(), {static_cast<Real>(most), static_cast<Real>(on)});
        const bool first = first_iteration == 1;
        // Sums of some 16 terms a lane and a tree of 6.
        field.add(first ? sum : double(static_cast<Real>(most)), first ? 8 * sum : 0);
        field.add(first ? 1 : (on > 0 && sum <= most ? 1 : 0), 0);
    }
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"start", bytes_of(start)},
            {"position", bytes_of(position)},
            {"delta", bytes_of(delta)},
            {"newest", bytes_of(newest)},
            {"progress", bytes_of(progress)}};
    c.launches = {make_launch(kernels::vbd_progress::info("", c.precision),
                              kernels::vbd_progress::Params{bodies, first_iteration}, bodies)};
    c.expected["progress"] = field;
    check_on_every_device(c);
}
