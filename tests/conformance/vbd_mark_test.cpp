#include "taut/kernels/vbd_mark.hpp"

#include "support/expect.hpp"
#include "support/random.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_mark copies displacements", "", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    Random random(1200 + count);
    const auto delta = random.vec4s<Real>(count + 7, 1, -1, 1);
    Case c;
    c.precision = precision_of<Real>();
    c.in = {{"delta", bytes_of(delta)},
            {"solved", bytes_of(std::vector<glm::vec<4, Real>>(count + 7, glm::vec<4, Real>(7)))}};
    c.launches = {
        make_launch(kernels::vbd_mark::info("", c.precision), kernels::vbd_mark::Params{count}, count)};
    for (std::uint32_t i = 0; i < delta.size(); ++i)
        for (int k = 0; k < 4; ++k)
            c.expected["solved"].add(i < count ? double(delta[i][k]) : 7, 0);
    check_on_every_device(c);
}
