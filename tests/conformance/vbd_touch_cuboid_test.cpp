#include "taut/kernels/vbd_touch_cuboid.hpp"

#include "support/touch_cuboid.hpp"
#include "support/vbd_touches.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_touch_cuboid finds the face of the box that the guess goes deepest behind",
                   "[vbd_touch]", float, double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const TouchLaunch launch{GENERATE(true, false), GENERATE(false, true)};
    const std::uint64_t seed = 7400 + count;
    CAPTURE(count, colliders, launch.first, launch.apart, seed);
    Random random(seed);
    const auto in = random_guesses<Real>(random, count, colliders, 1);
    const auto poses = random_cuboids<Real>(random, in.substeps, colliders);
    check_touches(in, random, launch, kernels::vbd_touch_cuboid::info("", precision_of<Real>()),
                  {{"collider", bytes_of(poses)}},
                  [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                      return touch_cuboid(poses, in, j, x, d, kept);
                  });
}
