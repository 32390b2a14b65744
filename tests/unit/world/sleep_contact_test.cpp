// Bodies that lie on each other sleep and wake as one, and nothing falls through what sleeps.

#include "support/catch.hpp"
#include "support/devices.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/world/islands.hpp"
#include "taut/world/sleep.hpp"

#include <algorithm>
#include <random>

using namespace taut;

namespace {

constexpr std::size_t kEach = 27; // vertices of a block

Body block(const glm::dvec3& middle)
{
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {2, 2, 2};
    body.shape.box_size = glm::dvec3(0.1);
    body.material = solid_material();
    body.material.density = 500;
    body.material.youngs_modulus = 1e5;
    body.material.thickness = 0.002;
    body.transform.translate = middle;
    return body;
}

/// Two blocks on each other, and a third 1 m beside them or in the air, on a mesh that is led: bodies 1, 2, 3
/// and 0.
Scene pile(const glm::dvec3& third)
{
    Scene scene;
    Body plate;
    plate.shape.kind = ShapeKind::grid;
    plate.shape.cells = {4, 4};
    plate.shape.size = {2, 2};
    plate.material.thickness = 0.002;
    plate.transform.rotate_axis = {1, 0, 0};
    plate.transform.rotate_degrees = -90;
    plate.kinematic.used = true;
    scene.bodies = {plate, block({-0.5, 0.0541, 0}), block({-0.49, 0.1583, 0}), block(third)};
    scene.contact.between = true;
    scene.contact.friction = 0.5;
    scene.method.substeps = 20;
    scene.damping = 2;
    scene.external_forces = true;
    return scene;
}

std::vector<glm::dvec3> of_block(const std::vector<glm::dvec3>& x, std::size_t body)
{
    const auto first = x.begin() + static_cast<std::ptrdiff_t>(x.size() - (4 - body) * kEach);
    return {first, first + kEach};
}

double lowest(const std::vector<glm::dvec3>& x)
{
    double y = x.front().y;
    for (const glm::dvec3& at : x)
        y = std::min(y, at.y);
    return y;
}

/// Until both of the pile sleep.
void let_sleep(SleepWorld& world)
{
    for (int k = 0; k < 300 && !(world.asleep(1) && world.asleep(2)); ++k)
        world.step();
    REQUIRE(world.asleep(1));
    REQUIRE(world.asleep(2));
}

} // namespace

TEST_CASE("a pile sleeps as one, and a body far from it moves bit for bit as beside it")
{
    Scene scene = pile({0.5, 0.2, 0});
    scene.bodies[1].contact.group = "low"; // which is not there once it sleeps
    scene.bodies[3].contact.passes = {"low"};
    scene.bodies[3].velocity = {0.3, 2, 0.2}; // in the air while the others fall asleep
    const Scene resolved = resolve(scene);
    for (const std::string& selector : test_devices())
    {
        CAPTURE(selector);
        SleepOptions often;
        often.look_every = 3;
        often.quiet_speed = 0.03;
        SleepWorld world(resolved, test_device(selector), often);
        World whole(resolved, test_device(selector));
        bool slept = false;
        for (int k = 0; k < 40; ++k)
        {
            world.step();
            whole.step();
            CHECK(world.asleep(1) == world.asleep(2));
            CHECK_FALSE((world.asleep(0) && !world.asleep(3)));
            slept = slept || world.asleep(1);
        }
        CHECK(slept);
        CHECK_FALSE(world.asleep(3));
        CHECK(lowest(of_block(world.positions(), 3)) < 0.03);
        CHECK(of_block(world.positions(), 3) == of_block(whole.positions(), 3)); // it has met the mesh by now
    }
}

TEST_CASE("a pile wakes before a body falls onto it, and carries it")
{
    SleepWorld world(resolve(pile({0.5, 0.0541, 0})), test_device("cpu:serial"));
    let_sleep(world);
    std::vector<glm::dvec3> above = of_block(world.positions(), 3);
    for (glm::dvec3& x : above)
        x += glm::dvec3(-0.985, 0.24, 0);
    world.set_positions(3, above);
    const auto before = of_block(world.positions(), 2);
    world.step();
    CHECK(world.asleep(1)); // it is 4 cm above them
    CHECK(world.asleep(2));
    CHECK_FALSE(world.asleep(0));
    while (world.asleep(2) && world.steps() < 2000)
        world.step();
    CHECK_FALSE(world.asleep(1));
    CHECK(lowest(of_block(world.positions(), 3)) > 0.22); // not there yet
    for (int k = 0; k < 600 && world.asleep() < 4; ++k)
        world.step();
    CHECK(world.asleep() == 4);
    CHECK(of_block(world.positions(), 2) != before);
    CHECK(lowest(of_block(world.positions(), 3)) ==
          Approx(0.21).margin(0.003)); // two blocks, pressed by 2 mm, and three gaps of 4
    CHECK(world.contacts().searches > 0);
    CHECK(world.contacts().missing == 0);
}

TEST_CASE("what lies on a body wakes with it")
{
    SleepWorld world(resolve(pile({0.5, 0.0541, 0})), test_device("cpu:serial"));
    let_sleep(world);
    while (world.asleep() < 4)
        world.step();
    world.set_force(25, {0, 0, 0}); // of the lower one
    CHECK_FALSE(world.asleep(0));
    CHECK_FALSE(world.asleep(1));
    CHECK_FALSE(world.asleep(2));
    CHECK(world.asleep(3));
    world.step();
    const auto forces = world.contact_forces();
    const auto on_lower = std::find_if(forces.begin(), forces.end(),
                                       [](const BodyContactForce& f) { return f.a == 1 && f.b == 2; });
    REQUIRE(on_lower != forces.end());
    CHECK(-on_lower->force.y == Approx(9.81 * 0.5).epsilon(0.05));
}

TEST_CASE("a mesh that begins to move wakes what lies on it")
{
    Scene scene = pile({0.5, 0.0541, 0});
    scene.bodies[0].kinematic.motion = {{6, {0, 0, 0}}, {7, {0, 0.3, 0}}};
    SleepWorld world(resolve(scene), test_device("cpu:serial"));
    while (world.time() < 5.9)
        world.step();
    REQUIRE(world.asleep() == 4);
    const double lay = lowest(of_block(world.positions(), 3));
    while (world.time() < 7)
        world.step();
    for (const std::size_t body : {1, 2, 3})
        CHECK_FALSE(world.asleep(body));
    CHECK(lowest(of_block(world.positions(), 3)) == Approx(lay + 0.3).margin(0.002));
}

TEST_CASE("what sleeps is no guarantee: refused")
{
    Scene scene = pile({0.5, 0.0541, 0});
    scene.contact.guarantee = Guarantee::no_crossing;
    CHECK_THROWS_WITH(SleepWorld(resolve(scene), test_device("cpu:serial")),
                      Contains("contact.guarantee") && Contains("leave"));
}

TEST_CASE("islands are what overlapping boxes hang together by")
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(0, 10), side(0, 1.2);
    for (int trial = 0; trial < 200; ++trial)
    {
        std::vector<Extent> boxes(30);
        for (Extent& box : boxes)
        {
            const glm::dvec3 low(place(random), place(random) / 3, place(random) / 5);
            box.take(low);
            box.take(low + glm::dvec3(side(random), side(random), side(random)));
        }
        boxes[7] = Extent(); // not there
        const auto meet = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 7 != 0; };
        std::vector<std::uint32_t> slow(
            boxes.size()); // the least index goes along overlaps until nothing changes
        for (std::uint32_t k = 0; k < slow.size(); ++k)
            slow[k] = k;
        for (bool changed = true; changed;)
        {
            changed = false;
            for (std::uint32_t a = 0; a < slow.size(); ++a)
                for (std::uint32_t b = 0; b < slow.size(); ++b)
                    if (a != b && overlap(boxes[a], boxes[b]) && meet(a, b) && slow[a] < slow[b])
                    {
                        slow[b] = slow[a];
                        changed = true;
                    }
        }
        CHECK(islands(boxes, meet) == slow);
    }
}
