#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"
#include "taut/scene/distance_field.hpp"
#include "taut/world/beside.hpp"
#include "taut/world/split.hpp"

#include <glm/geometric.hpp>

using namespace taut;

namespace {

std::shared_ptr<Device> serial() { return Device::open("cpu:serial"); }

/// One cloth that bends, falls onto a ball and slides, with a corner that is led and one that is held.
Scene one_cloth(std::uint32_t columns, std::uint32_t rows)
{
    Scene scene = parse_scene(R"({"taut": 1, "duration": 1, "method": {"substeps": 5}, "damping": 0.1,
        "bodies": [{"grid": {"cells": [8, 8]}, "material": {"bending_stiffness": 1e-5},
                    "transform": {"rotate": {"axis": [1, 0, 0], "degrees": -90}},
                    "pins": [{"corners": ["top_left"],
                              "motion": [{"time": 0}, {"time": 0.5, "translate": [0, 0.2, 0.1]}]},
                             {"corners": ["bottom_right"]}]}],
        "colliders": [{"sphere": {"centre": [0, -0.2, 0], "radius": 0.15},
                       "friction": 0.3, "meets": "vertices"},
                      {"plane": {"point": [0, -0.3, 0]}, "friction": 0.2}]})");
    scene.bodies[0].shape.cells = {columns, rows};
    return resolve(scene);
}

/// Both after the same steps, and after one more of a world that the state was copied into.
void compare(const Scene& scene, const SplitOptions& options, int steps, std::shared_ptr<Device> second)
{
    SplitWorld split(scene, serial(), std::move(second), options);
    World one(scene, serial());
    for (int step = 0; step < steps; ++step)
    {
        split.step();
        one.step();
    }
    CHECK(split.positions() == one.positions());
    CHECK(split.velocities() == one.velocities());
    CHECK(split.time() == one.time());
    CHECK(split.steps() == one.steps());
    const Events got = split.events(), want = one.events();
    CHECK(got.non_finite == want.non_finite);
    CHECK(got.speed_clamped == want.speed_clamped);
    CHECK(got.degenerate == want.degenerate);
    CHECK(got.conflicts == want.conflicts);
    World copy(scene, serial());
    split.copy_into(copy);
    CHECK(measure(copy).position_hash == measure(one).position_hash);
    CHECK(copy.velocities() == one.velocities());
    copy.step();
    one.step();
    CHECK(copy.positions() == one.positions());
}

} // namespace

TEST_CASE("a cloth that is cut moves bit for bit as on one device, wherever the cut is", "[split]")
{
    for (const auto& [columns, rows] : {std::pair{1u, 1u}, {7u, 5u}, {8u, 8u}, {13u, 22u}})
        for (const double share : {0.0, 0.01, 0.34, 0.5, 0.97, 1.0})
            for (const Exchange exchange : {Exchange::sweep, Exchange::colour})
            {
                CAPTURE(columns, rows, share, exchange == Exchange::sweep);
                compare(one_cloth(columns, rows), {{}, share, exchange}, 25, serial());
            }
}

namespace {

void compare_cuts(const Scene& scene)
{
    for (const double share : {0.2, 0.55})
        for (const Exchange exchange : {Exchange::sweep, Exchange::colour})
        {
            CAPTURE(share, exchange == Exchange::sweep);
            compare(scene, {{}, share, exchange}, 20, serial());
        }
}

} // namespace

TEST_CASE("what methods and materials do is cut without a difference", "[split]")
{
    Scene scene = one_cloth(11, 9);
    SECTION("multipliers over iterations")
    {
        scene.method.iterations = 3;
        scene.method.substeps = 2;
        compare_cuts(scene);
    }
    SECTION("double precision, dampers and strain limits")
    {
        scene.method.precision = Precision::float64;
        scene.method.iterations = 2;
        scene.bodies[0].material.stretch_damping = 0.01;
        scene.bodies[0].material.strain_limit = 0.02;
        compare_cuts(scene);
    }
    SECTION("pbd, whose friction is kept over the iterations")
    {
        scene.method.type = MethodKind::pbd;
        scene.method.scheme = ElementScheme::coloured;
        scene.method.iterations = 4;
        scene.method.substeps = 2;
        compare_cuts(scene);
    }
    SECTION("a mesh without rows, and other bodies beside it")
    {
        scene.bodies[0].mesh.grid_columns = 0;
        scene.bodies.insert(scene.bodies.begin(), one_cloth(4, 6).bodies[0]);
        scene.bodies.push_back(one_cloth(2, 3).bodies[0]);
        compare_cuts(scene);
    }
    SECTION("a distance field, as a collider")
    {
        Collider ring;
        ring.kind = ColliderKind::distance_field;
        ring.point = {0, -0.2, 0};
        ring.friction = 0.3;
        ring.field = std::make_shared<const DistanceField>(
            read_distance_field(TAUT_SOURCE_DIR "/examples/scenes/shapes/ring.sdf"));
        scene.colliders.push_back(ring);
        compare_cuts(scene);
    }
    SECTION("gravity alone")
    {
        scene.colliders.clear();
        scene.damping = 0;
        scene.bodies[0].pins.clear();
        compare_cuts(scene);
    }
}

TEST_CASE("solids are cut as cloths are", "[split]")
{
    Scene scene = resolve(parse_scene(R"({"taut": 1, "duration": 1, "method": {"substeps": 3},
        "bodies": [{"box": {"cells": [3, 4, 3]},
                    "material": {"youngs_modulus": 1e4, "poissons_ratio": 0.3, "density": 100}}],
        "colliders": [{"plane": {"point": [0, -0.6, 0]}, "friction": 0.2}]})"));
    compare(scene, {{}, 0.4, Exchange::sweep}, 20, serial());
    scene.colliders.clear(); // sums over the whole body
    CHECK_THROWS_WITH(SplitWorld(scene, serial(), serial()), Contains("effect \"momentum\""));
}

TEST_CASE("what both sides solve is counted once", "[split]")
{
    Scene scene = one_cloth(6, 6);
    scene.method.substeps = 1;
    scene.max_speed = 0.05;
    scene.colliders[1].point = {0, 0.3, 0}; // the held corners lie below it
    auto& start = scene.bodies[0].start_positions;
    start = scene.bodies[0].mesh.positions;
    for (std::size_t v = 14; v < 35; ++v) // over the cut
        start[v] = start[24];
    World one(scene, serial());
    one.step();
    const Events counted = one.events();
    REQUIRE(counted.speed_clamped > 0);
    REQUIRE(counted.conflicts > 0);
    REQUIRE(counted.degenerate > 0);
    for (const Exchange exchange : {Exchange::sweep, Exchange::colour})
        compare(scene, {{}, 0.5, exchange}, 4, serial());
}

TEST_CASE("a cloth is cut between every two kinds of device", "[split]")
{
    const Scene scene = one_cloth(9, 7);
    World one(scene, serial());
    for (int step = 0; step < 8; ++step)
        one.step();
    for (const std::string& name : test_devices())
        for (const bool first : {false, true})
        {
            CAPTURE(name, first);
            const auto device = test_device(name), cpu = Device::open("cpu");
            SplitWorld split(scene, first ? device : cpu, first ? cpu : device, {{}, 0.4});
            for (int step = 0; step < 8; ++step)
                split.step();
            double worst = 0;
            const auto got = split.positions(), want = one.positions();
            for (std::size_t v = 0; v < got.size(); ++v)
                worst = std::max(worst, glm::length(got[v] - want[v]));
            CHECK(worst <= (device->info().hardware_gpu ? 1e-4 : 0.0));
        }
}

TEST_CASE("a sweep costs one exchange and a wider halo", "[split]")
{
    const Scene scene = one_cloth(20, 20);
    const SplitWorld sweep(scene, serial(), serial(), {{}, 0.5, Exchange::sweep});
    const SplitWorld colour(scene, serial(), serial(), {{}, 0.5, Exchange::colour});
    CHECK(sweep.exchanges() == 5);
    CHECK(colour.exchanges() > 5 * 6);
    const auto work = [](const SplitWorld& w) { return w.parts()[0].work + w.parts()[1].work; };
    CHECK(sweep.work() == colour.work());
    CHECK(work(sweep) > work(colour));
    CHECK(work(colour) > colour.work());
    CHECK(sweep.exchanged_bytes() < colour.exchanged_bytes());
    CHECK(sweep.parts()[0].vertices + sweep.parts()[1].vertices == 21 * 21);
    CHECK(sweep.share() == Approx(0.5).margin(2e-3));
    const SplitWorld alone(scene, serial(), serial(), {{}, 1});
    CHECK(alone.exchanges() == 0);
    CHECK(work(alone) == alone.work());
    CHECK(alone.parts()[1].bodies.empty());
    CHECK(alone.parts()[0].bodies == std::vector<std::uint32_t>{0});
}

TEST_CASE("bodies on either side of a cut that meets none exchange nothing", "[split]")
{
    Scene scene = one_cloth(5, 5);
    scene.bodies.push_back(scene.bodies[0]);
    const SplitWorld split(scene, serial(), serial(), {{}, 0.5});
    CHECK(split.exchanges() == 0);
    CHECK(split.parts()[1].bodies == std::vector<std::uint32_t>{1});
    compare(scene, {{}, 0.5}, 10, serial());
}

TEST_CASE("the model of a split says when it gains", "[split]")
{
    const SplitCosts same{4, 4, 0.1, 10};
    CHECK(even_share(same) == Approx(0.5));
    CHECK(split_ms(same, 0.5) == Approx(3));
    CHECK(split_ms(same, 1) == Approx(4)); // nothing is exchanged
    CHECK(split_ms(same, 0) == Approx(4));
    CHECK(best_share(same) == Approx(0.5));
    CHECK(best_share({4, 4, 0.2, 10}) == 1); // exchanges take what was gained
    CHECK(best_share({8, 2, 0.001, 10}) == Approx(0.2));
    CHECK(best_share({40, 1, 0.001, 10}) == 0); // less than a tenth
    CHECK(best_share({1, 40, 0.001, 10}) == 1);
}

TEST_CASE("a split that is not given is measured, and moves as before", "[split]")
{
    const Scene scene = one_cloth(16, 16);
    const SplitWorld split(scene, serial(), serial());
    CHECK(split.costs().first_ms > 0);
    CHECK(split.costs().second_ms > 0);
    CHECK(split.costs().exchanges == 5);
    CHECK((split.share() == 1 || split.share() == 0 ||
           split.share() == Approx(even_share(split.costs())).margin(2e-3)));
    CHECK(split.steps() == 0);
    compare(scene, {}, 15, serial());
    compare(scene, {}, 15, Device::open("cpu:shuffled"));
}

TEST_CASE("what cannot be cut is refused in words", "[split]")
{
    const auto make = [](const Scene& scene, const SplitOptions& options = {}) {
        SplitWorld(scene, serial(), serial(), options);
    };
    Scene scene = one_cloth(4, 4);
    CHECK_THROWS_WITH(make(scene, {{}, 1.5}), Contains("0 to 1"));
    CHECK_THROWS_WITH(make(scene, {{}, std::nan("")}), Contains("0 to 1"));
    CHECK_THROWS_WITH(make(Scene{}), Contains("no bodies"));
    CHECK_THROWS_AS(SplitWorld(scene, serial(), nullptr), Error);
    SECTION("methods")
    {
        scene.method.type = MethodKind::vbd;
        CHECK_THROWS_WITH(make(scene), Contains("\"vbd\"") && Contains("\"xpbd\""));
    }
    SECTION("schemes")
    {
        scene.method.type = MethodKind::pbd;
        scene.method.scheme = ElementScheme::node_centric;
        CHECK_THROWS_WITH(make(scene), Contains("\"node_centric\"") && Contains("coloured"));
    }
    SECTION("effects")
    {
        scene.wind.density = 1.2;
        scene.bodies[0].material.drag = 1;
        CHECK_THROWS_WITH(make(scene), Contains("\"wind\"") && Contains("cannot be cut"));
    }
    SECTION("tearing")
    {
        scene.bodies[0].material.tear_strain = 0.5;
        CHECK_THROWS_WITH(make(scene), Contains("\"tearing\""));
    }
    SECTION("colliders that meet triangles")
    {
        scene.colliders[0].meets = ColliderMeets::surface;
        CHECK_THROWS_WITH(make(scene), Contains("\"sphere\"") && Contains("\"meets\": \"vertices\""));
    }
}

TEST_CASE("a thread beside its owner does one thing at a time and hands errors over", "[split]")
{
    Beside beside;
    int count = 0;
    for (int turn = 0; turn < 100; ++turn)
    {
        beside.start([&] { ++count; });
        beside.finish();
        CHECK(count == turn + 1);
    }
    beside.start([] { throw std::runtime_error("planted"); });
    CHECK_THROWS_WITH(beside.finish(), "planted");
    beside.start([&] { count = 0; });
    beside.finish();
    CHECK(count == 0);
}
