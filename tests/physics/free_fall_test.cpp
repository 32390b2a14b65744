// Gravity is a parabola under every method, and velocities are those at the steps (decision 33).

#include "hard/cases.hpp"
#include "support/methods.hpp"

#include "taut/world/hybrid.hpp"
#include "taut/world/sleep.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

const glm::dvec3 kGravity(0.5, -9.81, 0.25);

struct Way
{
    std::string method;
    Integrator integrator = Integrator::semi_implicit;
};

std::vector<Way> all_ways()
{
    std::vector<Way> out;
    for (const std::string_view name : kWords<MethodKind>)
        out.push_back({std::string(name)});
    out.push_back({"mass_spring", Integrator::explicit_euler});
    out.push_back({"mass_spring", Integrator::verlet});
    return out;
}

/// A thrown cloth at rest in itself, under a method.
Scene thrown(const Way& way, const char* precision, std::uint32_t substeps)
{
    // Of explicit Euler, whose rounding would grow with the rest.
    const double soft = way.integrator == Integrator::explicit_euler ? 0.01 : 1;
    Scene scene = test::under(free_cloth(3, 5 * soft, 1e-6 * soft), way.method);
    scene.method.integrator = way.integrator;
    scene.method.precision = option_named<Precision>(precision);
    scene.method.substeps = substeps;
    scene.method.stability = StabilityRule::refuse;
    scene.gravity = kGravity;
    scene.bodies[0].velocity = {1, 2, -0.5};
    return scene;
}

Collider floor_of(const glm::dvec3& point = {0, 0, 0}, const glm::dvec3& normal = {0, 1, 0})
{
    Collider out;
    out.kind = ColliderKind::plane;
    out.point = point;
    out.normal = normal;
    return out;
}

/// The exact motion of what is thrown, through changes of gravity.
struct Parabola
{
    glm::dvec3 moved{0}, velocity;

    void go(double time, const glm::dvec3& gravity)
    {
        moved += velocity * time + 0.5 * time * time * gravity;
        velocity += time * gravity;
    }
};

double unit(const char* precision) { return precision[0] == 'd' ? 0x1p-52 : 0x1p-23; }

/// A substep rounds a velocity by half a unit at most; `substeps` of them in a row to one side are the worst.
double rounding(const char* precision, double substeps) { return substeps * unit(precision); }

/// Elements of up to 1 m round the displacements of a substep of h s.
double rounding_of_elements(const char* precision, double h) { return unit(precision) / h; }

Words warnings(const Way& way)
{
    return way.integrator == Integrator::explicit_euler ? Words{"energy_growth"} : Words{};
}

template <typename AnyWorld>
void check_fall(const AnyWorld& world, const std::vector<glm::dvec3>& start, const Parabola& exact,
                double relative, double more_speed = 0)
{
    const auto x = world.positions(), v = world.velocities();
    double off = 0, off_speed = 0;
    for (std::size_t k = 0; k < x.size(); ++k)
    {
        off = std::max(off, glm::distance(x[k] - start[k], exact.moved));
        off_speed = std::max(off_speed, glm::distance(v[k], exact.velocity));
    }
    CHECK(off < relative * 10);
    CHECK(off_speed < relative * 10 + more_speed);
}

template <typename F>
void on_ways_and_devices(F&& f)
{
    for (const std::string& selector : test_devices())
        for (const Way& way : all_ways())
            if (selector == "cpu:serial" || way.method == "xpbd" || way.method == "vbd" ||
                way.integrator == Integrator::explicit_euler)
            {
                CAPTURE(selector, way.method, way.integrator);
                f(way, test_device(selector));
            }
}

} // namespace

TEST_CASE("free fall is the parabola at every step, velocities too, under every method")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        for (const char* precision : {"float", "double"})
            for (const std::uint32_t substeps : {1u, 10u})
            {
                CAPTURE(precision, substeps);
                World world(thrown(way, precision, substeps), device);
                const auto start = world.positions();
                Parabola exact{{}, {1, 2, -0.5}};
                const double elements = rounding_of_elements(precision, 1.0 / 60 / substeps);
                check_fall(world, start, exact, rounding(precision, 1));
                for (int step = 1; step <= 60; ++step)
                {
                    world.step();
                    exact.go(1.0 / 60, kGravity);
                    if (step % 20 == 1)
                        check_fall(world, start, exact, rounding(precision, step * substeps), elements);
                }
                CHECK(check_sound(world, warnings(way)).momentum_error < rounding(precision, 60 * substeps));
            }
    });
}

TEST_CASE("free fall goes on as the parabola through changes of the time step and of gravity")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        for (const std::uint32_t substeps : {1u, 10u})
        {
            CAPTURE(substeps);
            World world(thrown(way, "double", substeps), device);
            const auto start = world.positions();
            Parabola exact{{}, {1, 2, -0.5}};
            glm::dvec3 gravity = kGravity;
            const auto go = [&](int steps) {
                check_fall(world, start, exact, rounding("double", 600)); // a change makes no jump
                run(world, steps);
                exact.go(steps * world.plan().timestep, gravity);
            };
            world.set_timestep(1.0 / 90); // before the first step, too
            go(5);
            world.set_timestep(1.0 / 200);
            go(7);
            world.set_gravity(gravity = {-3, 4, 1});
            go(7);
            world.set_gravity(gravity = {0, 0, 0});
            world.set_timestep(1.0 / 60);
            go(7);
            world.set_gravity(gravity = kGravity);
            go(7);
            go(0);
            CHECK(check_sound(world, warnings(way)).momentum_error < rounding("double", 600));
        }
    });
}

TEST_CASE("a state goes on as the parabola where the time step, the substeps or gravity are others")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        Scene scene = thrown(way, "double", 2);
        World first(scene, device);
        run(first, 20);
        scene.timestep = 1.0 / 90;
        scene.gravity = {1, 2, 3};
        scene.method.substeps = 5;
        World second(scene, device);
        const auto start = second.positions();
        second.restore(first.state());
        CHECK(second.velocities() == first.velocities());
        Parabola exact{{}, {1, 2, -0.5}};
        exact.go(20.0 / 60, kGravity);
        run(second, 30);
        exact.go(30.0 / 90, scene.gravity);
        check_fall(second, start, exact, rounding("double", 600));
    });
}

TEST_CASE("bodies fall along the parabola on two devices, and while others sleep")
{
    Scene scene = free_cloth(3, 5, 1e-6);
    scene.gravity = kGravity;
    scene.method.precision = Precision::float64;
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[0].velocity = scene.bodies[1].velocity = {1, 2, -0.5};
    HybridOptions options;
    options.measure_every = 7;
    HybridWorld hybrid(scene, test_device("cpu:serial"), test_device("cpu"), options);
    World one(scene, test_device("cpu:serial"));
    auto start = hybrid.positions();
    Parabola exact{{}, {1, 2, -0.5}};
    for (int step = 0; step < 30; ++step)
    {
        hybrid.step();
        one.step();
        exact.go(1.0 / 60, kGravity);
    }
    check_fall(hybrid, start, exact, rounding("double", 600));
    CHECK(hybrid.velocities() == one.velocities());
    World whole(scene, test_device("cpu:serial"));
    hybrid.copy_into(whole);
    CHECK(whole.velocities() == one.velocities());

    scene.gravity = {0, -9.81, 0};
    scene.bodies[0].velocity = {0, 0, 0};
    for (Body& body : scene.bodies) // the first lies on the floor, the second comes back to it after 4 s
        for (glm::dvec3& x : body.mesh.positions)
            x = {x.x, body.material.thickness, x.y};
    scene.bodies[1].velocity = {1, 20, 0};
    scene.colliders = {floor_of()};
    SleepWorld sleepy(scene, test_device("cpu:serial"));
    start = sleepy.positions();
    for (int step = 0; step < 120; ++step)
        sleepy.step();
    CHECK(sleepy.asleep(0));
    exact = {{}, {1, 20, 0}};
    exact.go(2, scene.gravity);
    const auto x = sleepy.positions(), v = sleepy.velocities();
    CHECK(glm::distance(x.back() - start.back(), exact.moved) < 1e-11);
    CHECK(glm::distance(v.back(), exact.velocity) < 1e-11);
    CHECK(glm::length(v[0]) == 0);
}

TEST_CASE("what lies or hangs at rest has no speed, before and after a change of the time step")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        for (const bool hangs : {false, true})
        {
            CAPTURE(hangs);
            Scene scene = thrown(way, "double", 4);
            scene.gravity = {0, -9.81, 0};
            scene.bodies[0].velocity = {0, 0, 0};
            if (hangs)
                scene = test::under(test::chain(1, 100, 1), way.method);
            else
                for (glm::dvec3& x : scene.bodies[0].mesh.positions)
                    x = {x.x, scene.bodies[0].material.thickness, x.y};
            scene.method.integrator = way.integrator;
            scene.method.precision = Precision::float64;
            scene.method.stretch = 1; // of pbd
            scene.damping = hangs ? 10 : 0;
            if (!hangs)
                scene.colliders = {floor_of()};
            World world(scene, device);
            const double kick = 9.81 * scene.timestep / world.plan().substeps / 2;
            run(world, hangs ? 300 : 20);
            const auto fastest = [&] {
                double out = 0;
                for (const glm::dvec3& v : world.velocities())
                    out = std::max(out, glm::length(v));
                return out;
            };
            note("decision 33", *device, hangs ? "hangs, speed / half a kick" : "lies, the same",
                 fastest() / kick);
            CHECK(fastest() < 1e-3 * kick);
            world.set_timestep(1.0 / 75);
            CHECK(fastest() < 1e-3 * kick);
            run(world, 20);
            CHECK(fastest() < 1e-3 * kick);
        }
    });
}

TEST_CASE("what slides from rest gains speed and way as friction leaves it, from the first step on")
{
    constexpr double slope = 0.5, friction = 0.3;
    on_ways_and_devices([](const Way& way, const auto& device) {
        Scene scene = test::under(alone(particles({{0, 0, 0}})), way.method);
        scene.method.integrator = way.integrator;
        scene.method.precision = Precision::float64;
        scene.gravity = {0, -9.81, 0};
        Collider plane = floor_of({0, 0, 0}, glm::normalize(glm::dvec3(slope, 1, 0)));
        plane.friction = friction;
        scene.colliders = {plane};
        scene.bodies[0].mesh.positions[0] = plane.normal * scene.bodies[0].material.thickness;
        World world(scene, device);
        const glm::dvec3 start = world.positions()[0];
        const double c = 1 / std::sqrt(1 + slope * slope), gain = 9.81 * c * (slope - friction);
        for (int step = 1; step <= 30; ++step)
        {
            world.step();
            const double t = world.time();
            CHECK(glm::length(world.positions()[0] - start) == Approx(gain * t * t / 2).epsilon(1e-9));
            CHECK(glm::length(world.velocities()[0]) == Approx(gain * t).epsilon(1e-9));
        }
    });
}

TEST_CASE("gravity that turns round lifts what lies, along the parabola")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        Scene scene = test::under(alone(particles({{0, 0, 0}})), way.method);
        scene.method.integrator = way.integrator;
        scene.method.precision = Precision::float64;
        scene.gravity = {0, -9.81, 0};
        scene.colliders = {floor_of()};
        scene.bodies[0].mesh.positions[0].y = scene.bodies[0].material.thickness;
        World world(scene, device);
        run(world, 5);
        const double from = world.positions()[0].y;
        world.set_gravity({0, 9.81, 0});
        run(world, 60);
        CHECK(world.positions()[0].y - from == Approx(9.81 / 2).epsilon(1e-9));
    });
}

TEST_CASE("a blow is no acceleration: what has landed is at rest but for half a kick of gravity")
{
    on_ways_and_devices([](const Way& way, const auto& device) {
        Scene scene = test::under(alone(particles({{0, 0.5, 0}})), way.method);
        scene.method.integrator = way.integrator;
        scene.method.precision = Precision::float64;
        scene.gravity = {0, -9.81, 0};
        scene.bodies[0].velocity = {0, -50, 0};
        scene.colliders = {floor_of()};
        World world(scene, device);
        const double kick = 9.81 * scene.timestep / world.plan().substeps / 2;
        double fastest = 0;
        for (int step = 0; step < 10; ++step)
        {
            world.step();
            if (world.positions()[0].y < 2 * scene.bodies[0].material.thickness)
                fastest = std::max(fastest, glm::length(world.velocities()[0]));
        }
        CHECK(fastest <= kick * (1 + 1e-9));
    });
}
