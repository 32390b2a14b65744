#include "taut/kernels/vbd_accelerate.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_accelerate goes on from the iterate before the last, where its body may", "", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const float omega = GENERATE(1.0f, 1.4f, 1.93f);
    CAPTURE(count, omega);
    Random random(1250 + count);
    const std::uint32_t n = count + 7, bodies = 4;
    const auto delta = random.vec4s<Real>(n, 1, -1, 1), newest = random.vec4s<Real>(n, 1, -1, 1),
               older = random.vec4s<Real>(n, 1, -1, 1);
    std::vector<std::uint32_t> support;
    for (std::uint32_t i = 0; i < n; ++i)
        support.push_back(random.below(2 * bodies));
    std::vector<Real> progress;
    for (std::uint32_t b = 0; b < bodies; ++b)
        progress.insert(progress.end(), {Real(3), Real(b % 2)});
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"delta", bytes_of(delta)},
            {"newest", bytes_of(newest)},
            {"older", bytes_of(older)},
            {"support", bytes_of(support)},
            {"progress", bytes_of(progress)}};
    c.launches = {make_launch(kernels::vbd_accelerate::info("", c.precision),
                              kernels::vbd_accelerate::Params{count, omega}, count)};
    for (std::uint32_t i = 0; i < n; ++i)
        for (int k = 0; k < 4; ++k)
        {
            const double x = double(delta[i][k]), last = double(newest[i][k]), base = double(older[i][k]);
            const bool on = k < 3 && omega != 1 && (support[i] / 2) % 2 == 1;
            const double fast = on ? double(omega) * (x - base) + base : x;
            const double scale = on ? double(omega) * (std::abs(x) + std::abs(base)) + std::abs(base) : 0;
            c.expected["delta"].add(i < count ? fast : x, i < count ? scale : 0);
            c.expected["newest"].add(i < count ? fast : last, i < count ? scale : 0);
            c.expected["older"].add(i < count ? last : base, 0);
        }
    check_on_every_device(c);
}
