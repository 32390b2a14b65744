#include "taut/kernels/collide_capsule.hpp"

#include "support/touch_capsule.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::collide_capsule::Params;

namespace {

template <typename Real>
using Capsule = layout::CapsuleCollider<Real>;

template <typename Real>
void check_capsules(const Contacts<Real>& in, const std::vector<Capsule<Real>>& poses,
                    const std::string& variant, bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_capsule::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    check_contacts(in, kernel, bytes_of(std::vector{params}), in.buffers("collider", poses), rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_capsule(poses, in, j, x, d, kept);
                   });
}

/// Around the first capsule, which stands at the origin, half a metre thick and high to each end.
template <typename Real>
void plant(Contacts<Real>& in)
{
    const auto put = [&](std::uint32_t i, glm::dvec3 x, double w, glm::dvec3 d) {
        if (i >= in.count)
            return;
        in.position[i] = {glm::vec<3, Real>(x), static_cast<Real>(w)};
        in.delta[i] = {glm::vec<3, Real>(d), Real(0)};
    };
    put(0, {0.5, 0.25, 0}, 1, {-0.125, 0, 0});  // on the side, pressed in
    put(1, {0.5, 0.25, 0}, 1, {0, 0, 0});       // on the side, at rest
    put(2, {0, 0.25, 0}, 1, {0, 0, 0});         // on the axis: leaves across it
    put(3, {0, 0, 0}, 0, {0, 0, 0});            // held on the axis: a conflict
    put(4, {0, 0.75, 0}, 0, {0, 0, 0});         // held in the cap: a conflict
    put(5, {-2, 0.25, 0}, 1, {4, 0, 0});        // through the side
    put(6, {0.125, 3, 0}, 1, {0, -6, 0});       // along the axis, through both caps
    put(7, {-2, 0.125, 0}, 1, {2.25, 0, 0});    // stops inside, past the axis
    put(8, {0, 1, 0}, 1, {0, -0.125, 0});       // on the tip, pressed in
    put(9, {-2, 2, 0}, 1, {4, 0, 0});           // passes by
    put(10, {0.5, 0, 0}, 1, {0.25, 0.25, 0});   // on the side, leaving
    put(11, {0.5, 0, 0}, 0, {0, 0, 0});         // held exactly on the surface
    put(12, {-2, 0, 0}, 1, {1024, 0, 0});       // very fast
    put(13, {0.49999, 0.1, 0}, 1, {-2, 0, 0});  // a hair inside, into it: still outside
    put(14, {0.25, 0.125, 0}, 1, {0.0625, 0, 0}); // inside from the start: limited way out
}

} // namespace

TEMPLATE_TEST_CASE("vertices end outside every capsule, swept, and friction takes sliding up to its cone",
                   "[capsule]", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 128u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const double speed = GENERATE(0.1, 3.0);
    const std::uint64_t seed = 1100 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, speed, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 1.2, speed);
    in.substeps = 4;
    in.substep = count % 4;
    const auto poses = random_capsules<Real>(random, in.substeps, colliders);
    plant(in);
    check_capsules(in, poses, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("a capsule without length is a ball, and none changes nothing", "[capsule]", float,
                   double)
{
    using Real = TestType;
    Random random(1150);
    const std::string variant = GENERATE("", "friction", "friction_kept");
    auto in = random_contacts<Real>(random, 65, GENERATE(0u, 1u), 1, 0.3);
    const std::vector<Capsule<Real>> poses(2, make_capsule<Real>({}, 0, 0.5, 0.3));
    check_capsules(in, poses, variant, true, true);
}

TEMPLATE_TEST_CASE("a capsule that turns takes a vertex that sticks to it along", "[capsule]", float, double)
{
    using Real = TestType;
    Contacts<Real> in;
    in.count = in.colliders = 1;
    in.position = {{Real(0.5), Real(0.25), Real(0), Real(1)}};
    in.delta = {{Real(-0.01), Real(0), Real(0), Real(0)}}; // pressed in, and so held by friction
    const double angle = 0.01;
    const std::vector poses{make_capsule<Real>({}, 0.5, 0.5, 10),
                            make_capsule<Real>(make_frame({0, 0, 0}, {0, 1, 0}, angle), 0.5, 0.5, 10)};
    const Launch launch =
        make_launch(kernels::collide_capsule::info("friction", precision_of<Real>()),
                    Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto delta = reals_of<Real>(run(*device, {launch}, in.buffers("collider", poses)).at("delta"));
        CHECK(0.5 + delta[0] == Approx(0.5 * std::cos(angle)).margin(1e-4));
        CHECK(delta[1] == Approx(0).margin(1e-6));
        CHECK(delta[2] == Approx(-0.5 * std::sin(angle)).margin(1e-4));
    }
}
