#include "taut/kernels/collide_distance_field.hpp"

#include "support/touch_distance_field.hpp"

using namespace taut;
using namespace taut::conformance;
using kernels::collide_distance_field::Params;

namespace {

template <typename Real>
void check_fields(const Contacts<Real>& in, const DistanceFields<Real>& shapes, const std::string& variant,
                  bool first_iteration, bool report)
{
    const KernelInfo& kernel = kernels::collide_distance_field::info(variant, precision_of<Real>());
    const Params params{in.count, in.colliders, in.substep, in.substeps, first_iteration, report};
    const Rules rules{variant != "", variant == "friction_kept", first_iteration, 0};
    Buffers buffers = in.buffers("collider", shapes.poses);
    buffers["values"] = bytes_of(shapes.values());
    check_contacts(in, kernel, bytes_of(std::vector{params}), buffers, rules, report,
                   [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                       return touch_distance_field(shapes, in, j, x, d, kept);
                   });
}

/// Around the first, a ball of half a metre at the origin.
template <typename Real>
void plant(Contacts<Real>& in)
{
    const auto put = [&](std::uint32_t i, glm::dvec3 x, double w, glm::dvec3 d) {
        if (i >= in.count)
            return;
        in.position[i] = {glm::vec<3, Real>(x), static_cast<Real>(w)};
        in.delta[i] = {glm::vec<3, Real>(d), Real(0)};
    };
    put(0, {0.55, 0.25, 0}, 1, {-0.125, 0, 0}); // into it, and it stays on its side
    put(1, {0.3, 0.2, 0.1}, 0, {0, 0, 0});      // held inside: a conflict
    put(2, {-2, 0.1, 0.05}, 1, {4, 0, 0});      // through it
    put(3, {-2, 2, 0}, 1, {4, 0, 0});           // passes by
    put(4, {-2, 0.1, 0}, 1, {2.25, 0, 0});      // stops inside, past the middle
    put(5, {0.3, 0.1, 0.1}, 1, {0.0625, 0, 0}); // inside from the start: limited way out
    put(6, {-30, 0.1, 0}, 1, {60, 0, 0});       // very fast, from beyond the grid
    put(7, {3, 4, 5}, 1, {0, 0, 0});            // at rest beyond the grid
}

} // namespace

TEMPLATE_TEST_CASE(
    "vertices end outside every distance field, swept, and friction takes sliding up to its cone",
    "[distance_field]", float, double)
{
    using Real = TestType;
    const std::string variant = GENERATE("", "friction", "friction_kept");
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const bool first_iteration = GENERATE(true, false), report = GENERATE(true, false);
    const double speed = GENERATE(0.1, 2.0);
    const std::uint64_t seed = 5300 + count;
    CAPTURE(variant, count, colliders, first_iteration, report, speed, seed);
    Random random(seed);
    auto in = random_contacts<Real>(random, count, colliders, 1.2, speed);
    in.substeps = 4;
    in.substep = count % 4;
    const auto shapes = random_distance_fields<Real>(random, in.substeps, colliders);
    plant(in);
    check_fields(in, shapes, variant, first_iteration, report);
}

TEMPLATE_TEST_CASE("no distance field changes nothing", "[distance_field]", float, double)
{
    using Real = TestType;
    Random random(5390);
    const auto in = random_contacts<Real>(random, 65, 0, 1, 0.3);
    check_fields<Real>(in,
                       {{},
                        {make_distance_field<Real>(
                            {}, make_distance_grid<Real>({2, 2, 2}, {0, 0, 0}, 1, field_of_ball), 0, 0)}},
                       GENERATE("", "friction", "friction_kept"), true, true);
}

TEMPLATE_TEST_CASE("a vertex that is nowhere reads no value beyond the grid", "[distance_field]", float,
                   double)
{
    using Real = TestType;
    Contacts<Real> in;
    in.count = in.colliders = 1;
    const Real far = GENERATE(Real(1e30), -Real(1e30), std::numeric_limits<Real>::infinity(),
                              std::numeric_limits<Real>::quiet_NaN());
    in.position = {{far, Real(0), -far, Real(1)}};
    in.delta = {{Real(0), Real(0), Real(0), Real(0)}};
    const DistanceGrid grid = make_distance_grid<Real>({3, 3, 3}, {-1, -1, -1}, 1, field_of_ball);
    Buffers buffers = in.buffers("collider", std::vector(2, make_distance_field<Real>({}, grid, 0, 0)));
    buffers["values"] = bytes_of(std::vector<Real>(grid.values.begin(), grid.values.end()));
    const Launch launch = make_launch(kernels::collide_distance_field::info("", precision_of<Real>()),
                                      Params{1, 1, 0, 1, 1, 1}, 1);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const auto delta = reals_of<Real>(run(*device, {launch}, buffers).at("delta"));
        if (std::abs(far) <= Real(1e30)) // too far to be met; what is nowhere ends nowhere
            CHECK(delta[0] == Real(0));
        CHECK(device->counters().validation_messages == 0);
    }
}
