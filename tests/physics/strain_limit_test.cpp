// Claims about strain limits and long-range attachments, under every method.

#include "hard/cases.hpp"
#include "support/methods.hpp"

#include "taut/plan/limits.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

/// Soft cloth hung by two corners, which sags far without a limit.
Scene soft(std::uint32_t n)
{
    Scene scene = test::hanging(n);
    scene.bodies[0].material.stretch_stiffness = 20;
    scene.bodies[0].material.stretch_damping = 1e-3;
    scene.damping = 1;
    scene.method.stretch = 1e-3; // pbd has a stiffness of its own
    return scene;
}

/// How far the worst vertex is beyond its attachment, in parts of its rest distance.
double beyond_attachment(const World& world)
{
    const Body& body = world.scene().bodies[0];
    const auto x = world.positions();
    const auto nearest = nearest_pins(body);
    double worst = -1;
    for (std::uint32_t v = 0; v < x.size(); ++v)
        if (nearest[v].distance > 0)
            worst = std::max(worst, glm::distance(x[v], x[nearest[v].pin]) / nearest[v].distance - 1);
    return worst;
}

} // namespace

TEST_CASE("a strain limit keeps soft cloth near it, and does nothing to cloth within it", "[strain_limit]")
{
    test::on_methods_and_devices(soft(10), [](Scene scene, const auto& device) {
        World loose(scene, device);
        scene.bodies[0].material.strain_limit = 0.1;
        World limited(scene, device);
        run(loose, 60);
        run(limited, 60);
        const double without = check_sound(loose).max_stretch, with = check_sound(limited).max_stretch;
        note("physics", *device, "stretch without a limit", without);
        note("physics", *device, "stretch with the limit 0.1", with);
        CHECK(without > 0.3);
        CHECK(with < 0.12);
        scene.bodies[0].material.strain_limit = 1e6; // nobody comes near it
        World far(scene, device);
        run(far, 60);
        CHECK(far.state().position == loose.state().position);
    });
}

TEST_CASE("more iterations bring the largest stretch closer to the limit", "[strain_limit]")
{
    const auto device = test_device("cpu:serial");
    double before = 1;
    for (const std::uint32_t iterations : {1u, 4u, 16u, 64u})
    {
        Scene scene = soft(20);
        scene.bodies[0].material.strain_limit = 0.05;
        scene.method.iterations = iterations;
        World world(scene, device);
        run(world, 60);
        const double beyond = check_sound(world).max_stretch - 0.05;
        note("physics", *device, "stretch beyond the limit 0.05", beyond);
        CHECK(beyond < before);
        before = beyond;
    }
    CHECK(before < 0.01);
}

TEST_CASE("attachments keep every vertex within its distance of a pin", "[attachment]")
{
    test::on_methods_and_devices(soft(10), [](Scene scene, const auto& device) {
        World loose(scene, device);
        scene.bodies[0].material.attachment_slack = 0.02;
        World attached(scene, device);
        run(loose, 60);
        run(attached, 60);
        check_sound(attached);
        note("physics", *device, "beyond the rest distance without attachments", beyond_attachment(loose));
        note("physics", *device, "beyond the rest distance, slack 0.02", beyond_attachment(attached));
        CHECK(beyond_attachment(loose) > 0.1);
        CHECK(beyond_attachment(attached) < 0.02 + 1e-5);
    });
}

TEST_CASE("the distance to a pin is along the edges, from the nearest pin", "[attachment]")
{
    Scene scene;
    Body body;
    body.shape.cells = {4, 1};
    body.shape.size = {4, 1};
    Pin left, right;
    left.corners = {"top_left"};
    right.corners = {"top_right"};
    body.pins = {left, right};
    scene.bodies = {body};
    scene = resolve(scene);
    const auto nearest = nearest_pins(scene.bodies[0]);
    CHECK(nearest[0].distance == 0);
    CHECK(nearest[1].pin == 0);
    CHECK(nearest[1].distance == Approx(1));
    CHECK(nearest[3].pin == 4);
    CHECK(nearest[5].distance == Approx(1)); // below the corner
    CHECK(nearest[2].distance == Approx(2));
    scene.bodies[0].pins.clear();
    CHECK(nearest_pins(scene.bodies[0])[3].distance == std::numeric_limits<double>::infinity());
}
