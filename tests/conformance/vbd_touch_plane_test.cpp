#include "taut/kernels/vbd_touch_plane.hpp"

#include "support/touch_plane.hpp"
#include "support/vbd_touches.hpp"

using namespace taut;
using namespace taut::conformance;

TEMPLATE_TEST_CASE("vbd_touch_plane finds the plane that the guess goes deepest behind", "[vbd_touch]", float,
                   double)
{
    using Real = TestType;
    const std::uint32_t count = GENERATE(1u, 63u, 64u, 65u, 1000u);
    const std::uint32_t colliders = GENERATE(1u, 3u);
    const TouchLaunch launch{GENERATE(true, false), GENERATE(false, true)};
    const std::uint64_t seed = 7100 + count;
    CAPTURE(count, colliders, launch.first, launch.apart, seed);
    Random random(seed);
    const auto in = random_guesses<Real>(random, count, colliders, 1);
    const auto planes = random_planes<Real>(random, colliders);
    check_touches(in, random, launch, kernels::vbd_touch_plane::info("", precision_of<Real>()),
                  {{"collider", bytes_of(planes)}},
                  [&](const glm::dvec3& x, const glm::dvec3& d, double kept, std::uint32_t j) {
                      return touch_plane(planes[j], in, x, d, kept);
                  });
}

TEMPLATE_TEST_CASE("vbd_touch_plane keeps a vertex above a floor, and one below it no deeper", "[vbd_touch]",
                   float, double)
{
    using Real = TestType;
    using V = glm::vec<4, Real>;
    const Real o(0);
    const std::vector<V> position{V(o, Real(0.01), o, Real(2)), V(o, Real(-0.01), o, Real(2)),
                                  V(o, Real(1), o, Real(2)), V(o, Real(0.01), o, o)};
    const std::vector<V> delta(4, V(o, Real(-0.02), o, o));
    // The same floor again: of two that are as near, the first.
    const std::vector planes{make_plane<Real>({0, 1, 0}, 0, 0, {0.03, 0, 0}, 0.25),
                             make_plane<Real>({0, 1, 0}, 0, 0, {0.03, 0, 0}, 0.5)};
    layout::StepValues<Real> step{};
    step.inverse_substep = Real(100);
    const Buffers in = {{"position", bytes_of(position)},
                        {"delta", bytes_of(delta)},
                        {"collider", bytes_of(planes)},
                        {"step_values", bytes_of(std::vector{step})},
                        {"contacts", bytes_of(std::vector<V>(16, V(Real(7))))},
                        {"support", bytes_of(std::vector<std::uint32_t>{0, 0, 0, 0})},
                        {"touched", bytes_of(std::vector<std::uint32_t>{0})}};
    const Launch launch = make_launch(kernels::vbd_touch_plane::info("", precision_of<Real>()),
                                      TouchParams{4, 2, 0, 1, 1, 4, 1}, 4);
    for (const std::string& selector : test_devices())
    {
        const auto device = test_device(selector);
        if (!can_run(*device, precision_of<Real>()))
            continue;
        CAPTURE(selector);
        const Buffers out = run(*device, {launch}, in);
        CHECK(values_of<std::uint32_t>(out.at("touched")) ==
              std::vector<std::uint32_t>{2}); // held: not counted
        const auto contacts = values_of<V>(out.at("contacts"));
        for (const std::size_t i : {0u, 1u, 3u})
        {
            const V plane = contacts[4 + 3 * i], drag = contacts[5 + 3 * i];
            CHECK(glm::vec<3, Real>(plane) == glm::vec<3, Real>(o, Real(1), o));
            CHECK(plane.w == Approx(i == 1 ? 0 : -0.01).margin(1e-8));
            CHECK(drag.x == Approx(0.03));
            CHECK((drag.y == 0 && drag.z == 0 && drag.w == Real(0.25)));
        }
        CHECK(contacts[4 + 3 * 2] == V(o)); // far above
        CHECK(contacts[5 + 3 * 2] == V(o));
        CHECK(contacts[6 + 3 * 2] == V(Real(1e30), o, o, o));
        CHECK(contacts[2] == V(o, Real(-0.02), o, Real(5000)));
        CHECK(contacts[3] == V(o, Real(-0.02), o, o));
    }
}
