#include "taut/kernels/collide_sphere.hpp"

#include "support/touch_sphere.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::collide_sphere::Params;

namespace {

template <typename Real>
using Sphere = layout::SphereCollider<Real>;

template <typename Real>
void check_spheres(const Contacts<Real>& in, const std::vector<Sphere<Real>>& spheres,
                   const std::string& variant, bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_sphere::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    check_contacts(in, kernel, bytes_of(std::vector{params}), in.buffers("collider", spheres), rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_sphere(spheres[j], in, x, d, kept);
                   });
}

/// Around the first ball, which rests at the origin with radius 1/2.
template <typename Real>
void plant(Contacts<Real>& in)
{
    const auto put = [&](std::uint32_t i, glm::vec<3, Real> x, Real w, glm::vec<3, Real> d) {
        if (i >= in.count)
            return;
        in.position[i] = {x, w};
        in.delta[i] = {d, Real(0)};
    };
    using V = glm::vec<3, Real>;
    const Real zero(0), half(0.5), one(1), two(2);
    put(0, V(zero, half, zero), one, V(zero, Real(-0.125), zero)); // on the surface, pressed in
    put(1, V(zero, half, zero), one, V(zero));                     // on the surface, at rest
    put(2, V(zero), one, V(zero));                                 // at the centre: leaves upwards
    put(3, V(zero), Real(0), V(zero));                             // held at the centre: a conflict
    put(4, V(zero, Real(-0.25), zero), Real(0), V(zero));          // held inside: a conflict
    put(5, V(-two, zero, zero), one, V(Real(4), zero, zero));      // through the whole ball in one substep
    put(6, V(-two, Real(0.125), zero), one, V(two, zero, zero));   // stops inside, past the middle plane
    put(7, V(-two, zero, zero), one, V(two, zero, zero));          // stops exactly at the centre
    put(8, V(zero, Real(0.25), zero), one,
        V(Real(0.0625), zero, zero));                        // inside from the start: limited way out
    put(9, V(-two, two, zero), one, V(Real(4), zero, zero)); // passes by
    put(10, V(half, zero, zero), one, V(Real(0.25), Real(0.25), zero)); // on the surface, leaving
    put(11, V(half, zero, zero), Real(0), V(zero));                     // held exactly on the surface
    put(13, V(zero, Real(0.4999), zero), one,
        V(zero, Real(-4), zero)); // from a little inside through the ball
    put(13, V(Real(0.49999), zero, zero), one,
        V(-two, zero, zero)); // a hair inside, into the ball: still outside
    put(12, V(-two, zero, zero), one, V(Real(1024), zero, zero)); // very fast
}

} // namespace

TEMPLATE_TEST_CASE("vertices end outside every ball, swept, and friction takes sliding up to its cone", "",
                   float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const double speed = GENERATE(0.1, 3.0); // slow, and mostly faster than a ball is wide
    const std::uint64_t seed = 1000 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, speed, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 0.9, speed);
    in.substeps = 4;
    in.substep = count % 4;
    const auto spheres = random_spheres<Real>(random, colliders);
    plant(in);
    check_spheres(in, spheres, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("a ball without colliders changes nothing", "", float, double)
{
    using Real = TestType;
    Random random(1050);
    auto in = random_contacts<Real>(random, 65, 0, 1, 0.3);
    const std::vector<Sphere<Real>> spheres(1); // a buffer cannot be empty
    check_spheres(in, spheres, GENERATE("", "friction", "friction_kept"), true, true);
}

TEMPLATE_TEST_CASE("a vertex faster than a ball is wide stops where it enters", "", float, double)
{
    using Real = TestType;
    const double far =
        GENERATE(4.0, 2.5, 2.0, 100.0); // goes through, ends on the far side, at the centre, far away
    Contacts<Real> in;
    in.count = in.colliders = 1;
    in.position = {{Real(-2), Real(0), Real(0), Real(1)}};
    in.delta = {{static_cast<Real>(far), Real(0), Real(0), Real(0.25)}};
    const std::vector spheres{make_sphere<Real>({0, 0, 0}, {0, 0, 0}, 0.5, 0)};
    const Launch launch =
        make_launch(kernels::collide_sphere::info("", precision_of<Real>()), Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector, far);
        const auto delta =
            reals_of<Real>(run(*device, {launch}, in.buffers("collider", spheres)).at("delta"));
        CHECK(-2 + delta[0] == Approx(-0.75).epsilon(1e-5)); // radius and the gap kept
        CHECK((delta[1] == 0 && delta[2] == 0 && delta[3] == 0.25));
    }
}

TEMPLATE_TEST_CASE("a ball that moves faster than it is wide takes a resting vertex with it", "", float,
                   double)
{
    using Real = TestType;
    Contacts<Real> in;
    in.count = in.colliders = 1;
    in.position = {{Real(0), Real(0), Real(0), Real(1)}};
    in.delta = {glm::vec<4, Real>(Real(0))};
    const std::vector spheres{make_sphere<Real>({-2, 0, 0}, {2, 0, 0}, 0.5, 0)};
    const Launch launch =
        make_launch(kernels::collide_sphere::info("", precision_of<Real>()), Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto delta =
            reals_of<Real>(run(*device, {launch}, in.buffers("collider", spheres)).at("delta"));
        CHECK(delta[0] == Approx(2.5)); // in front of the ball at its new place
    }
}
