// The cases of the robustness map about bad steps and bad input, changed steps, uneven springs, and
// constraints that say a thing twice or cannot hold (methods 2.A, 2.C, 2.F).

#include "hard/map_parts.hpp"

namespace taut::hard {
namespace {

using Shared = std::shared_ptr<Device>;

/// A10: neither a world nor a change of its step takes what is no time step.
Findings bad_steps(const Scene& scene, const Shared& device, int steps)
{
    World world(scene, device);
    run(world, steps);
    const WorldState before = world.state();
    int taken = 0;
    for (const double bad : {0.0, -1.0 / 60, kNaN, 1e30})
    {
        Scene other = scene;
        other.timestep = bad;
        if (refusal_of([&] { World refused(other, device); }) != "bad_timestep" ||
            refusal_of([&] { world.set_timestep(bad); }) != "bad_timestep")
            ++taken;
    }
    return each_of(above("bad steps that are not refused", taken, 0),
                   never("a refused step has changed the state", !same_state(world.state(), before)));
}

/// Angle of the pendulum of a metre from the vertical, let go at 30 degrees: Runge-Kutta, tiny steps.
double pendulum_angle(double time)
{
    double angle = std::asin(0.5), speed = 0;
    const int steps = 20000;
    const double h = time / steps;
    for (int k = 0; k < steps; ++k)
    {
        const double middle = angle + h / 2 * speed, fast = speed - h / 2 * 9.81 * std::sin(angle);
        angle += h * fast;
        speed -= h * 9.81 * std::sin(middle);
    }
    return angle;
}

/// A12: no jump of the velocity of a pendulum where the step changes, and its place is that of its time.
Findings changed_steps(const Scene& scene, const Shared& device, int steps)
{
    World world(scene, device);
    double jump = 0;
    for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 30})
    {
        world.set_timestep(h);
        for (int k = 0; k < steps / 3; ++k)
        {
            const glm::dvec3 velocity = world.velocities()[1];
            world.step();
            jump = std::max(jump, glm::length(world.velocities()[1] - velocity) / (9.81 * h));
        }
    }
    const glm::dvec3 bob = world.positions()[1];
    return each_of(above("error of the angle, rad",
                         std::abs(std::atan2(bob.x, -bob.y) - pendulum_angle(world.time())), 0.1),
                   above("change of speed in a step / (g h)", jump, 2));
}

/// C07.
Findings bad_springs(const Scene& scene, const Shared& device, int)
{
    const std::vector<Body::Spring> bad = {{1, 1, 0.1, 1},  {0, 9, 0.1, 1},    {0, 1, kNaN, 1},
                                           {0, 1, -0.1, 1}, {0, 1, 0.1, kNaN}, {0, 1, 0.1, -1e-3}};
    int taken = 0;
    for (const Body::Spring& spring : bad)
    {
        Scene other = scene;
        other.bodies[0].springs = {spring};
        if (refusal_of([&] { World refused(other, device); }) != "bad_input")
            ++taken;
    }
    return above("bad springs that are not refused", taken, 0);
}

/// C08: worlds of next to nothing run, and what is there falls.
Findings nothing(const Scene& scene, const Shared& device, int steps)
{
    double wrong = 0;
    bool stopped = false;
    for (const std::size_t count : {0u, 1u, 2u})
    {
        Scene few = scene;
        if (count == 0)
            few.bodies.clear();
        else
            few.bodies = {particles(std::vector<glm::dvec3>(count, glm::dvec3(0)))};
        World world(few, device);
        run(world, steps);
        stopped = stopped || measure(world).status != Status::completed;
        const double t = world.time();
        for (const glm::dvec3& x : world.positions())
            wrong = std::max(wrong, std::abs(x.y / (-9.81 * t * t / 2) - 1));
    }
    return each_of(above("error of the fall", wrong, 0.05), never("one of them does not run", stopped));
}

/// F07: what is between two held vertices is left out.
Findings between_pins(const Scene& scene, const Shared& device, int steps)
{
    Scene without = scene;
    without.bodies[0].springs.erase(without.bodies[0].springs.begin());
    World with(scene, device), plain(without, device);
    run(with, steps);
    run(plain, steps);
    return above("difference to a world without that spring",
                 largest_distance(with.positions(), plain.positions()), 0);
}

/// F04: every edge twice is every edge twice as stiff.
Findings doubled(const Scene& scene, const Shared& device, int steps)
{
    Scene twice = scene;
    for (const StretchElement& e : make_model(scene).springs)
        twice.bodies[0].springs.push_back({e.a, e.b, e.rest_length, e.compliance});
    World stiff(with_stretch(scene, 2 * scene.bodies[0].material.stretch_stiffness), device),
        pairs(twice, device);
    run(stiff, steps);
    run(pairs, steps);
    const auto low = lowest(scene.bodies[0].mesh);
    const double way = scene.bodies[0].mesh.positions[low[0]].y - pairs.positions()[low[0]].y;
    return each_of(above("difference, m", largest_distance(stiff.positions(), pairs.positions()), 1e-4),
                   above("fall of a lower corner, m", way, 0.1)); // 4.9 without springs
}

void add_steps_and_input(std::vector<MapCase>& out)
{
    const auto add = [&](const char* id, const char* what, const Scene& scene, int steps, auto check) {
        out.push_back({id, what, scene, steps, {}, 0, {}, 0, check});
    };
    const Scene small = with_stretch(hanging(2), 200);
    add("A10", "steps of 0, below 0, NaN, 1e30 s", small, 10, bad_steps);
    Scene pendulum = test::chain(1, 1e4, 1);
    pendulum.bodies[0].start_positions = {{0, 0, 0}, {0.5, -std::sqrt(0.75), 0}};
    add("A12", "pendulum, steps of 1/60, 1/240, 1/30 s", pendulum, 180, changed_steps);
    add("C07", "springs to themselves, to no vertex, NaN", small, 3, bad_springs);
    add("C08", "nothing, one particle, two", small, 10, nothing);
    Scene tiny = alone(particles({{100, 0, 0}}));
    tiny.gravity = {0, -9.81, 0};
    tiny.timestep = 1e-6;
    out.push_back({"A11", "5,000 steps of a microsecond, 100 m from the origin, in full 100,000", tiny,
                   100000, [](const Journey& j) {
                       const double t = j.world.time(), fall = -j.world.positions()[0].y;
                       return above("error of the fall", std::abs(fall / (9.81 * t * t / 2) - 1), 0.01);
                   }});
    out.back().short_steps = 5000;
}

void add_uneven(std::vector<MapCase>& out)
{
    std::vector<glm::dvec3> places;
    for (int k = 0; k <= 8; ++k)
        places.emplace_back(0, -4.0 * k, 0);
    Body rope = particles(places, 0.01);
    rope.vertex_masses.back() = 10;
    for (std::uint32_t k = 0; k < 8; ++k)
        rope.springs.push_back({k, k + 1, 4, k % 2 == 0 ? 1e-3 : 1e-6});
    rope.pins = {hold({0})};
    Scene s = alone(rope);
    s.gravity = {0, -9.81, 0};
    s.damping = 2;
    out.push_back({"A05", "springs of 1e3 and 1e6 N/m by turns", s, 600,
                   [](const Journey& j) {
                       const auto x = j.world.positions();
                       double least = kInfinity, most = 0;
                       for (std::uint32_t k = 0; k < 8; ++k)
                       {
                           const double pull = (glm::distance(x[k], x[k + 1]) - 4) * (k % 2 == 0 ? 1e3 : 1e6);
                           least = std::min(least, pull);
                           most = std::max(most, pull);
                       }
                       return above("largest tension / mean - 1", (most - least) / std::abs(most + least),
                                    0.01);
                   },
                   // Explicit springs in float: at 4 m a rounding of a length is 0.2 N in 1e6 N/m, a substep
                   // and again, on a vertex of 10 g. In double they pass.
                   kPositionBased | only(MethodKind::vbd) | kForces});
    s = test::chain(50, 1e5, 0.01);
    s.bodies[0].vertex_masses.back() = 2;
    s.damping = 4;
    out.push_back({"A07", "rope, last of 50 links 200 times heavier", s, 300,
                   [](const Journey& j) { return length_error(j, 1e5); }, kPositionBased});
}

Scene star_of(int springs)
{
    std::vector<glm::dvec3> star = {{0, 0, 0}};
    for (int k = 0; k < springs; ++k)
        star.emplace_back(1.05 * std::cos(k * 0.7), 1.05 * std::sin(k * 0.7), 0.1 * (k % 7));
    Body hub = particles(star, 0.01);
    for (std::uint32_t v = 1; v < star.size(); ++v)
        hub.springs.push_back({0, v, 1.0, 1e-2});
    Scene s = alone(hub);
    s.damping = 10;
    return s;
}

void add_star(std::vector<MapCase>& out)
{
    out.push_back({"C03", "star of 400 springs on one vertex, in full 10,000", star_of(400), 60,
                   [](const Journey& j) { return above("stretch left", j.last.max_stretch, 0.005); },
                   // Near its stable step the energy of explicit springs swings by some tenths; it does not
                   // grow, and with 1,000 substeps it passes.
                   kForces});
    out.back().full_size = [] { return star_of(10000); };
}

void add_twice(std::vector<MapCase>& out)
{
    Body body = particles({{0, 0, 0}, {5, 0, 0}, {5, -1.2, 0}});
    body.springs = {{0, 1, 1, 1e-2}, {1, 2, 1, 1e-2}};
    body.pins = {hold({0, 1})};
    Scene s = alone(body);
    s.gravity = {0, -9.81, 0};
    s.damping = 5;
    out.push_back({"F07",
                   "a violated spring between two held vertices",
                   s,
                   180,
                   [](const Journey& j) {
                       return above("error of the length", std::abs(j.world.positions()[2].y / -1.0981 - 1),
                                    0.01);
                   },
                   kOwnStiffness | kHoldsThreshold,
                   {},
                   0,
                   between_pins});
    out.push_back({"F04",
                   "cloth, every edge twice",
                   with_stretch(hanging(4, 1), 250),
                   60,
                   {},
                   only(MethodKind::xpbd),
                   {},
                   0,
                   doubled});
    Scene sheet = free_cloth(4, kInfinity, 0);
    sheet.gravity = {0, 0, -9.81};
    sheet.damping = 0.5;
    sheet.bodies[0].pins = {hold({0, 4, 20, 24})};
    out.push_back({"F08", "sheet of rigid edges held at four corners", sheet, 300,
                   [](const Journey& j) { return above("stretch", j.last.max_stretch, 0.01); }});
}

} // namespace

void add_more(std::vector<MapCase>& out)
{
    add_steps_and_input(out);
    add_uneven(out);
    add_star(out);
    add_twice(out);
}

} // namespace taut::hard
