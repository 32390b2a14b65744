#include "taut/kernels/collide_cuboid.hpp"

#include "support/touch_cuboid.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::collide_cuboid::Params;

namespace {

template <typename Real>
using Cuboid = layout::CuboidCollider<Real>;

template <typename Real>
void check_cuboids(const Contacts<Real>& in, const std::vector<Cuboid<Real>>& poses,
                   const std::string& variant, bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_cuboid::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    check_contacts(in, kernel, bytes_of(std::vector{params}), in.buffers("collider", poses), rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_cuboid(poses, in, j, x, d, kept);
                   });
}

/// Around the first box, which lies at the origin, 2 m by 1 m by 1/2 m.
template <typename Real>
void plant(Contacts<Real>& in)
{
    const auto put = [&](std::uint32_t i, glm::dvec3 x, double w, glm::dvec3 d) {
        if (i >= in.count)
            return;
        in.position[i] = {glm::vec<3, Real>(x), static_cast<Real>(w)};
        in.delta[i] = {glm::vec<3, Real>(d), Real(0)};
    };
    put(0, {0.25, 0.5, 0}, 1, {0, -0.125, 0});    // on the top, pressed in
    put(1, {0.25, 0.5, 0}, 1, {0, 0, 0});         // on the top, at rest
    put(2, {0.25, 0.5, 0}, 1, {0.5, -0.25, 0.03125}); // on the top, sliding and pressed in
    put(3, {0, 0, 0.125}, 0, {0, 0, 0});          // held inside: a conflict
    put(4, {0.75, 0.125, 0}, 0, {0, 0, 0});       // held inside: a conflict
    put(5, {-2, 0.25, 0}, 1, {4, 0, 0});          // through the long side
    put(6, {0.125, 3, 0.0625}, 1, {0, -6, 0});    // from the top through the bottom
    put(7, {0.125, 0.0625, 1}, 1, {0, 0, -1.125}); // stops inside, past the middle
    put(8, {0.125, 0.0625, 0.125}, 1, {0, 0, 0.03125}); // inside from the start: limited way out
    put(9, {-2, 2, 0}, 1, {4, 0, 0});             // passes by
    put(10, {0.5, 0.5, 0}, 1, {0.25, 0.25, 0});   // on the top, leaving
    put(11, {0.5, 0.5, 0}, 0, {0, 0, 0});         // held exactly on the surface
    put(12, {-2, 0.125, 0.0625}, 1, {1024, 0, 0}); // very fast
    put(13, {0.25, 0.49995, 0}, 1, {0.125, -2, 0}); // a hair inside, downwards: still above
    put(14, {0.25, 0.375, 0}, 1, {0, -2, 0});     // well inside, downwards: stays with the top
    put(15, {1.5, 0.75, 0}, 1, {-0.25, -2, 0});   // falls past the side
}

} // namespace

TEMPLATE_TEST_CASE("vertices end outside every box, swept, and friction takes sliding up to its cone",
                   "[cuboid]", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const double speed = GENERATE(0.1, 3.0);
    const std::uint64_t seed = 1200 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, speed, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 1.2, speed);
    in.substeps = 4;
    in.substep = count % 4;
    const auto poses = random_cuboids<Real>(random, in.substeps, colliders);
    plant(in);
    check_cuboids(in, poses, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("no boxes change nothing", "[cuboid]", float, double)
{
    using Real = TestType;
    Random random(1250);
    auto in = random_contacts<Real>(random, 65, 0, 1, 0.3);
    const std::vector<Cuboid<Real>> poses(1); // a buffer cannot be empty
    check_cuboids(in, poses, GENERATE("", "friction", "friction_kept"), true, true);
}

TEMPLATE_TEST_CASE("a vertex faster than a plate is thin stops where it enters", "[cuboid]", float, double)
{
    using Real = TestType;
    const double far = GENERATE(4.0, 2.001, 100.0);
    Contacts<Real> in;
    in.count = in.colliders = 1;
    in.position = {{Real(0), Real(2), Real(0), Real(1)}};
    in.delta = {{Real(0), static_cast<Real>(-far), Real(0), Real(0.001)}};
    const std::vector poses(2, make_cuboid<Real>({}, {1, 0.001, 1}, 0));
    const Launch launch =
        make_launch(kernels::collide_cuboid::info("", precision_of<Real>()), Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, far);
        const auto delta = reals_of<Real>(run(*device, {launch}, in.buffers("collider", poses)).at("delta"));
        CHECK(2 + delta[1] == Approx(0.002).margin(1e-5 * far)); // half the thickness and the gap kept
        CHECK((delta[0] == 0 && delta[2] == 0));
    }
}
