// Contact (methods 2.E E01, E03, E04, E06, E07, E10).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

namespace {

Collider plane(const glm::dvec3& normal, double friction = 0)
{
    Collider c;
    c.kind = ColliderKind::plane;
    c.normal = normal;
    c.friction = friction;
    return c;
}

Collider ball(const glm::dvec3& centre, double radius, double friction = 0)
{
    Collider c;
    c.point = centre;
    c.radius = radius;
    c.friction = friction;
    return c;
}

} // namespace

namespace {

/// Distance of the origin from the segment between two points, m.
double distance_of_path(const glm::dvec3& from, const glm::dvec3& to)
{
    const glm::dvec3 d = to - from;
    const double square = glm::dot(d, d);
    const double t = square > 0 ? std::clamp(-glm::dot(from, d) / square, 0.0, 1.0) : 0.0;
    return glm::length(from + t * d);
}

} // namespace

TEST_CASE("E01: particles of 100 m/s do not pass a plane or a small ball [hard]")
{
    on_every_device([](const auto& device) {
        std::vector<glm::dvec3> places;
        for (int k = 0; k < 64; ++k) // many phases of the step against the surface
            places.emplace_back(0.0004 * (k % 8), 1 + 0.026 * k, 0);
        Scene scene = alone(particles(places));
        scene.bodies[0].velocity = {0, -100, 0};
        scene.bodies[0].material.thickness = 0.001;
        scene.method.substeps = 1;
        // The nearest that any path between two steps comes to the surface, m.
        const auto nearest = [&](const Collider& collider) {
            scene.colliders = {collider};
            World world(scene, device);
            double least = 1e9;
            auto from = world.positions();
            for (int i = 0; i < 10; ++i)
            {
                world.step();
                const auto to = world.positions();
                for (std::size_t v = 0; v < to.size(); ++v)
                    least = std::min(least, collider.kind == ColliderKind::plane
                                                ? to[v].y
                                                : distance_of_path(from[v], to[v]) - collider.radius);
                from = to;
            }
            check_sound(world);
            return least;
        };
        const double floor = nearest(plane({0, 1, 0}));
        const double pearl = nearest(ball({0, 0, 0}, 0.004));
        note("E01", *device, "nearest to the plane, m", floor);
        note("E01", *device, "nearest to a ball of 4 mm, m", pearl);
        CHECK(floor >= 0.001 - 1e-6);
        CHECK(pearl >= 0.001 - 1e-6);
    });
}

TEST_CASE("E03: a ball of 20 m/s into hanging cloth leaves no vertex inside [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(12);
        scene.bodies[0].material.bending_stiffness = 1e-4;
        const double radius = 5.0 / 12;
        Collider fast = ball({0, -0.1, 1.5}, radius, 0.2);
        fast.motion = {{0, {0, 0, 0}}, {0.09, {0, 0, -1.8}}};
        scene.colliders = {fast};
        World world(scene, device);
        double deepest = 0, stretch = 0;
        for (int i = 0; i < 60; ++i)
        {
            world.step();
            if (i % 5 == 4 || i < 12)
            {
                const StepReport report = measure(world);
                deepest = std::max(deepest, report.penetration);
                stretch = std::max(stretch, report.max_stretch);
            }
        }
        const StepReport report = check_sound(world);
        note("E03", *device, "deepest vertex on the way / R", deepest / radius);
        note("E03", *device, "deepest vertex after 1 s / R", report.penetration / radius);
        note("E03", *device, "largest stretch on the way", stretch);
        CHECK(report.penetration < 0.01 * radius);
        CHECK(deepest < 0.01 * radius);
        CHECK(std::isfinite(stretch));
        for (const glm::dvec3& x :
             world.positions()) // the pinned corners stay, the cloth is pushed, not passed
            CHECK(x.z < 0.9);
    });
}

TEST_CASE("E04: what starts inside a collider leaves it slowly and completely [hard]")
{
    on_every_device([](const auto& device) {
        const double d = std::sqrt(2.0);
        for (const bool round : {false, true})
        {
            Scene scene = free_cloth(6, 1000, 1e-4);
            scene.gravity = {0, 0, -9.81};
            scene.colliders = {round ? ball({0, 0, -1 + 0.1 * d}, 1) : plane({0, 0, 1})};
            if (!round)
                scene.colliders[0].point = {0, 0, 0.1 * d};
            World world(scene, device);
            double fastest = 0, total = 0;
            for (int i = 0; i < 60; ++i)
            {
                world.step();
                const auto v = world.velocities();
                double mean = 0;
                for (const glm::dvec3& u : v)
                    mean += u.z / double(v.size());
                fastest = std::max(fastest, mean);
                total += mean;
            }
            const StepReport report = check_sound(world);
            note("E04", *device, round ? "exit speed, ball, m/s" : "exit speed, plane, m/s", fastest);
            note("E04", *device, round ? "depth after 1 s / D, ball" : "depth after 1 s / D, plane",
                 report.penetration / d);
            CHECK(total > 0);
            CHECK(fastest < std::sqrt(2 * 9.81 * 0.1 * d));
            CHECK(report.penetration < 0.01 * d);
        }
    });
}

namespace {

/// A small stiff square of cloth on a slope of tan 0.5, gravity turned so that the slope is the plane y = 0.
Scene on_slope(double friction, std::uint32_t iterations)
{
    Scene scene = free_cloth(2, 1e4, 1e-3);
    for (glm::dvec3& x : scene.bodies[0].mesh.positions)
        x = {x.x, 0.001, x.y};
    const double slope = std::atan(0.5);
    scene.gravity = {9.81 * std::sin(slope), -9.81 * std::cos(slope), 0};
    scene.colliders = {plane({0, 1, 0}, friction)};
    scene.method.iterations = iterations;
    return scene;
}

glm::dvec3 mean(const std::vector<glm::dvec3>& values)
{
    glm::dvec3 sum(0);
    for (const glm::dvec3& v : values)
        sum += v;
    return sum / double(values.size());
}

} // namespace

TEST_CASE("E06: cloth on a slope slides just below the friction that holds it, and is held above [hard]")
{
    for (const std::uint32_t iterations : {1u, 4u})
        on_every_device([&](const auto& device) {
            const int steps = 60;
            const double v_per_s = 1.0 * steps / 60;
            for (const auto& [mu, acceleration] :
                 {std::pair(0.49, 0.087743307437), std::pair(0.3, 1.754866148742)})
            {
                World slides(on_slope(mu, iterations), device);
                run(slides, steps);
                const double speed = mean(slides.velocities()).x / v_per_s;
                note("E06", *device,
                     mu > 0.4 ? "acceleration at 0.49 / exact" : "acceleration at 0.3 / exact",
                     speed / acceleration);
                CHECK(std::abs(speed / acceleration - 1) < 0.2);
                check_sound(slides);
            }
            World holds(on_slope(0.501, iterations), device);
            run(holds, steps);
            const double start = mean(holds.positions()).x;
            run(holds, steps);
            const double creep = std::abs(mean(holds.positions()).x - start) / v_per_s;
            note("E06", *device, "creep at 0.501, m/s", creep);
            CHECK(creep < 1e-3);
            check_sound(holds);
        });
}

TEST_CASE("E07: sliding cloth stops after v^2 / (2 mu g) [hard]")
{
    on_every_device([](const auto& device) {
        for (const double mu : {0.1, 0.5, 1.0})
        {
            const double exact = 100 / (2 * mu * 9.81), time = 10 / (mu * 9.81);
            if (device->info().executor != "cpu:serial" && mu < 0.5)
                continue;
            Scene scene = free_cloth(2, 1e4, 1e-3);
            for (glm::dvec3& x : scene.bodies[0].mesh.positions)
                x = {x.x, 0.001, x.y};
            scene.gravity = {0, -9.81, 0};
            scene.bodies[0].velocity = {10, 0, 0};
            scene.colliders = {plane({0, 1, 0}, mu)};
            World world(scene, device);
            run(world, int(60 * (time + 0.5)));
            const double slid = mean(world.positions()).x;
            note("E07", *device, "stop distance / exact", slid / exact);
            CHECK(std::abs(slid - exact) < std::max(0.02 * exact, 10 * scene.timestep));
            CHECK(check_sound(world).max_speed < 1e-3);
        }
    });
}

TEST_CASE("E10: a pinned vertex inside a collider stays, is counted, and shakes nobody [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene = test::hanging(6);
        scene.bodies[0].material.bending_stiffness = 1e-4;
        scene.damping = 2;
        scene.colliders = {ball(scene.bodies[0].mesh.positions[0] + glm::dvec3(0.02, 0.02, 0), 0.1, 0.3),
                           plane({0, 1, 0})};
        scene.colliders[1].point = {0, -5, 0};
        World world(scene, device);
        const auto start = world.positions();
        run(world, 480);
        const StepReport report = check_sound(world, {"conflict"});
        CHECK(report.warnings.at("conflict") == 480);
        CHECK(world.positions()[0] == start[0]);
        const double jitter = report.max_speed / std::sqrt(9.81 * std::sqrt(2.0));
        note("E10", *device, "speed after 8 s / sqrt(g D)", jitter);
        CHECK(jitter < 1e-3);
        CHECK(report.penetration < 1e-6);
    });
}

TEST_CASE("thick sheets that the guarantee holds in the air are not called completed [hard]")
{
    const auto fall = [](double thickness) {
        Scene scene;
        Body sheet;
        sheet.shape.cells = {8, 8};
        sheet.shape.size = {0.32, 0.32};
        sheet.material.stretch_stiffness = 2000;
        sheet.material.thickness = thickness;
        sheet.contact.self = true;
        sheet.transform.rotate_axis = {1, 0, 0};
        sheet.transform.rotate_degrees = -70;
        sheet.transform.translate = {0, 2, 0};
        scene.bodies = {sheet, sheet};
        scene.bodies[1].transform.translate.y = 2.1;
        scene.contact.between = true;
        scene.contact.guarantee = Guarantee::no_crossing;
        scene.colliders = {plane({0, 1, 0})}; // takes momentum, so that nobody asks where it went
        scene.colliders[0].point = {0, -5, 0};
        World world(resolve(scene), test_device("cpu:serial"));
        const double start = world.positions()[0].y;
        run(world, 12);
        note("thick sheets", *test_device("cpu:serial"), "fallen, m", start - world.positions()[0].y);
        note("thick sheets", *test_device("cpu:serial"), "held",
             static_cast<double>(world.contacts().held) /
                 (double(world.plan().vertex_count) * double(world.steps()) * world.plan().substeps));
        return measure(world);
    };
    const StepReport thick = fall(0.06); // beside cells of 4 cm
    CHECK(thick.status == Status::unconverged);
    CHECK_THAT(thick.reason, Contains("held vertices still"));
    const StepReport thin = fall(0.01);
    CHECK(thin.status == Status::completed);
    CHECK(thin.contacts.held == 0);
}
