#include "taut/kernels/collide_plane.hpp"

#include "support/touch_plane.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::collide_plane::Params;

namespace {

template <typename Real>
using Plane = layout::PlaneCollider<Real>;

template <typename Real>
void check_planes(const Contacts<Real>& in, const std::vector<Plane<Real>>& planes,
                  const std::string& variant, bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_plane::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    check_contacts(in, kernel, bytes_of(std::vector{params}), in.buffers("collider", planes), rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_plane(planes[j], in, x, d, kept);
                   });
}

/// On the surface; below it, moving and held; resting on it at the gap kept; deep below; sliding along it.
template <typename Real>
void plant(Contacts<Real>& in, const Plane<Real>& ground)
{
    const Real y = ground.offset_start;
    const auto put = [&](std::uint32_t i, Real height, Real w, glm::vec<4, Real> delta) {
        if (i >= in.count)
            return;
        in.position[i] = {Real(0.25), y + height, Real(0.5), w};
        in.delta[i] = delta;
    };
    const Real zero(0), quarter(0.25);
    put(0, zero, Real(1), {zero, Real(-0.125), zero, zero});
    put(1, zero, Real(1), {zero, zero, zero, zero});
    put(2, zero, Real(0), {zero, zero, zero, zero});           // held exactly on the surface of ground: fine
    put(3, -quarter, Real(0), {zero, zero, zero, zero});       // held below: a conflict
    put(4, -quarter, Real(1), {zero, zero, zero, zero});       // comes out by depenetration only
    put(5, Real(-0.03125), Real(1), {zero, zero, zero, zero}); // comes out at once
    put(6, Real(0.015625), Real(1),
        {quarter, Real(-0.0625), zero, Real(0.015625)});       // lands at the gap kept, slides
    put(7, zero, Real(1), {Real(1), Real(-1), Real(2), zero}); // lands fast and slides
}

} // namespace

TEMPLATE_TEST_CASE("vertices end above every plane, and friction takes sliding up to its cone", "", float,
                   double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const std::uint64_t seed = 900 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 1, 0.3);
    in.substeps = 4;
    in.substep = count % 4;
    const auto planes = random_planes<Real>(random, colliders);
    plant(in, planes.front());
    check_planes(in, planes, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("a plane without colliders changes nothing", "", float, double)
{
    using Real = TestType;
    Random random(950);
    auto in = random_contacts<Real>(random, 65, 0, 1, 0.3);
    const std::vector<Plane<Real>> planes(1); // a buffer cannot be empty
    check_planes(in, planes, GENERATE("", "friction", "friction_kept"), true, true);
}

TEMPLATE_TEST_CASE("on a plane, friction holds a vertex inside the cone and slows one outside by the push",
                   "", float, double)
{
    using Real = TestType;
    const double pressed = 0.25, slides = GENERATE(0.0625, 0.5);
    const double left = std::max(0.0, slides - 0.5 * pressed); // friction 0.5
    Contacts<Real> in;
    in.count = in.colliders = 1;
    in.position = {{Real(0), Real(0), Real(0), Real(1)}};
    in.delta = {{static_cast<Real>(slides), static_cast<Real>(-pressed), Real(0), Real(0)}};
    in.contact = {glm::vec<4, Real>(Real(0))};
    const std::vector planes{make_plane<Real>({0, 1, 0}, 0, 0, {0, 0, 0}, 0.5)};
    const Launch launch =
        make_launch(kernels::collide_plane::info("friction", precision_of<Real>()),
                    Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, slides);
        const auto delta = reals_of<Real>(run(*device, {launch}, in.buffers("collider", planes)).at("delta"));
        CHECK(delta[0] == Approx(left).margin(1e-7));
        CHECK(delta[1] == 0);
    }
}
