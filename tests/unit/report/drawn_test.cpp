// What bodies draw and squeeze out of each other where they meet, as the energy that a scene can hold.

#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"

namespace taut {
namespace {

/// J: the most there can be after a second, all of it at the start's places.
double most_of(const Scene& scene)
{
    const EnergyBudget budget(resolve(scene));
    return budget.most(budget.model().start, {1, 1.0 / 600, 0, true, 0}).all;
}

/// Two squares of cloth without gravity: the left edge of one is held, the right edge of the other is led
/// away by half a metre in a second.
Scene hooked()
{
    Scene scene;
    scene.gravity = glm::dvec3(0);
    Body body;
    body.shape.cells = {4, 4};
    scene.bodies = {body, body};
    scene.bodies[0].pins.emplace_back().vertices = {0, 5, 10, 15, 20};
    scene.bodies[1].pins.emplace_back().vertices = {4, 9, 14, 19, 24};
    scene.bodies[1].pins[0].motion = {{0}, {1, {0.5, 0, 0}}};
    scene.contact.between = true;
    return scene;
}

} // namespace

TEST_CASE("what one body draws out of another that it meets is energy that was put in")
{
    Scene scene = hooked();
    const double drawn = most_of(scene);
    // Springs of both, drawn by half of their length: hundreds of joules. What is led alone has a tenth of
    // one.
    CHECK(drawn > 100);
    scene.bodies[0].contact.passes = {"default"};
    CHECK(most_of(scene) < 1);
    scene.bodies[0].contact.passes = {};
    scene.contact.between = false;
    CHECK(most_of(scene) < 1);
}

TEST_CASE("what nothing else holds goes along with the body that draws it, and has no energy from that")
{
    Scene scene = hooked();
    scene.bodies[0].pins.clear();
    CHECK(most_of(scene) < 1);
    // A floor that is led holds it, too.
    scene.colliders.emplace_back();
    CHECK(most_of(scene) > 100);
}

TEST_CASE("a press squeezes a solid between it and what holds still, across its shortest side")
{
    Scene scene = hooked();
    Body& block = scene.bodies[0];
    block = {};
    block.material = solid_material();
    block.shape.kind = ShapeKind::box;
    block.shape.box_size = {1, 1, 0.1};
    scene.bodies.push_back(hooked().bodies[0]);
    const double thin = most_of(scene);
    scene.bodies[0].shape.box_size = {1, 1, 1};
    // As soft a block ten times as thick takes a tenth of the energy of the same way.
    CHECK(thin > 5 * most_of(scene));
}

} // namespace taut
