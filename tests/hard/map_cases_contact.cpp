// The cases of the robustness map with contacts, constraints and extremes, and on real meshes.

#include "hard/map_parts.hpp"
#include "support/data.hpp"

namespace taut::hard {
namespace {

Collider round(const glm::dvec3& centre, double radius, double friction = 0.3)
{
    Collider c;
    c.point = centre;
    c.radius = radius;
    c.friction = friction;
    return c;
}

Collider floor(double height, double friction = 0.3)
{
    Collider c;
    c.kind = ColliderKind::plane;
    c.point = {0, height, 0};
    c.friction = friction;
    return c;
}

Scene lying(double height)
{
    Scene scene = free_cloth(6);
    for (glm::dvec3& x : scene.bodies[0].mesh.positions)
        x = {x.x, height, x.y};
    scene.gravity = {0, -9.81, 0};
    scene.damping = 0.5;
    return scene;
}

Scene pulled_corner(double reach, double limit)
{
    Scene scene = hanging(8);
    scene.bodies[0].material.strain_limit = limit;
    Pin pin = hold({80});
    pin.motion = {{0, {0, 0, 0}}, {1, {reach, 0, reach}}};
    if (reach > 1) // and back, to see what is left of it
    {
        pin.motion.push_back({2, {0, 0, 0}});
        scene.damping = 5;
    }
    scene.bodies[0].pins.push_back(pin);
    return scene;
}

void add_contact(std::vector<MapCase>& out)
{
    out.push_back({"E01", "particles of 100 m/s against a floor",
                   [] {
                       std::vector<glm::dvec3> places;
                       for (int k = 0; k < 32; ++k)
                           places.emplace_back(0.1 * k, 1 + 0.05 * k, 0);
                       Scene s = alone(particles(places));
                       s.bodies[0].velocity = {0, -100, 0};
                       s.colliders = {floor(0)};
                       return s;
                   }(),
                   10,
                   [](const Journey& j) {
                       double high = -kInfinity;
                       for (const glm::dvec3& x : j.world.positions())
                           high = std::max(high, x.y);
                       return each_of(above("penetration", j.deepest, 1e-3),
                                      above("height at the end, m", high, 0.01));
                   }});
    out.push_back({"E03", "a ball of 20 m/s into hanging cloth",
                   [] {
                       Scene s = hanging(10);
                       Collider fast = round({0, -0.1, 1.5}, 0.42);
                       fast.motion = {{0, {0, 0, 0}}, {0.09, {0, 0, -1.8}}};
                       s.colliders = {fast};
                       return s;
                   }(),
                   60,
                   [](const Journey& j) {
                       return each_of(above("penetration / radius", j.last.penetration / 0.42, 0.01),
                                      above("missing of half the ball's speed, m/s", 10 - j.fastest, 0));
                   }});
    out.back().work = pushed_by(20);
    out.push_back({"E05", "cloth falls by 2 cm and lies on a floor",
                   [] {
                       Scene s = lying(0.02);
                       s.colliders = {floor(0)};
                       return s;
                   }(),
                   300,
                   [](const Journey& j) {
                       double high = -kInfinity;
                       for (const glm::dvec3& x : j.world.positions())
                           high = std::max(high, x.y);
                       return each_of(above("speed at rest", j.last.max_speed, 1e-3 * std::sqrt(9.81 * 1.4)),
                                      above("height above the cloth's thickness, m", high - 0.001, 1e-4),
                                      above("penetration", j.last.penetration, 1e-4));
                   }});
    out.push_back({"E09", "a ball and a floor that close on cloth",
                   [] {
                       Scene s = lying(0.01);
                       Collider press = round({0, 1.02, 0}, 1);
                       press.motion = {{0, {0, 0, 0}}, {0.5, {0, -0.05, 0}}};
                       s.colliders = {floor(0), press};
                       return s;
                   }(),
                   60,
                   [](const Journey& j) {
                       // Where they overlap, by 3 cm and the gaps, one of them must be missed.
                       return each_of(above("depth, m", j.deepest, 0.032),
                                      above("speed", j.last.max_speed, 1));
                   }});
    out.back().work = pushed_by(0.1);
    out.push_back({"E10", "a pinned vertex inside a ball",
                   [] {
                       Scene s = hanging(6, 5);
                       s.colliders = {round(s.bodies[0].mesh.positions[0] + glm::dvec3(0.02, 0.02, 0), 0.1)};
                       return s;
                   }(),
                   180,
                   [](const Journey& j) {
                       return each_of(
                           above("movement of the pin", glm::distance(j.start[0], j.world.positions()[0]), 0),
                           never("no conflict is said", j.last.warnings.count("conflict") == 0),
                           above("speed at the end", j.last.max_speed, 0.05));
                   }});
}

void add_constraints(std::vector<MapCase>& out)
{
    out.push_back({"F03", "chain of 16 links from the horizontal",
                   [] {
                       Scene s = test::chain(16, 1e5, 1.0 / 16);
                       for (glm::dvec3& x : s.bodies[0].mesh.positions)
                           x = {-x.y, 0, 0};
                       return s;
                   }(),
                   120,
                   [](const Journey& j) {
                       return each_of(above("stretch", j.stretch, 0.2),
                                      above("height of the lowest centre, m", j.lowest_centre, -0.4));
                   },
                   only(MethodKind::xpbd)}); // energy: of what its sweeps leave of stiff links
    out.push_back({"F06", "triangle of lengths 1, 1 and 3",
                   [] {
                       Body body = particles({{0, 0, 0}, {1, 0, 0}, {0.5, 0.8, 0}});
                       body.springs = {{0, 1, 1, 1e-4}, {1, 2, 1, 1e-4}, {2, 0, 3, 1e-4}};
                       Scene s = alone(body);
                       s.damping = 5;
                       return s;
                   }(),
                   300,
                   [](const Journey& j) {
                       // 4/3, 4/3 and 8/3 on a line: where the energy of three equal springs is least.
                       return each_of(
                           above("error of the stretch", std::abs(j.last.max_stretch - 1.0 / 3), 0.02),
                           above("speed at the end", j.last.max_speed, 0.05));
                   },
                   kOwnStiffness | kHoldsThreshold});
    out.push_back({"F13", "a corner dragged 10 times the cloth's size in a second", pulled_corner(7, 0), 300,
                   [](const Journey& j) { return hangs(j, kThirdCorner); },
                   // The free corner may fold over on the way back, and stay so.
                   kOwnStiffness | kHoldsThreshold});
    // All springs ten times their length, at most, and what the drag throws.
    out.back().work = [](const Journey& j) { return 0.5 * 1000 * 100 * 3 + pushed_by(10)(j); };
    // The diagonal between the corners must be 8.9 % longer; without the limit a spring stretches by 14 %.
    out.push_back({"F13", "a corner drawn out by 16 cm, strain limit of 10 %", pulled_corner(0.16, 0.1), 60,
                   [](const Journey& j) { return above("stretch", j.last.max_stretch, 0.12); },
                   kOwnStiffness | kHoldsThreshold});
    out.back().work = [](const Journey& j) { return 0.5 * 1000 * 0.01 * 3 + pushed_by(0.3)(j); };
    out.push_back({"pins apart", "two corners pulled to twice the width",
                   [] {
                       Scene s = test::hanging(8);
                       s.bodies[0].pins = {hold({0}), hold({8})};
                       s.bodies[0].pins[1].motion = {{0, {0, 0, 0}}, {1, {1, 0, 0}}};
                       s.damping = 5;
                       return s;
                   }(),
                   240,
                   [](const Journey& j) {
                       const auto x = j.world.positions(); // the middle of the upper edge, by symmetry
                       return each_of(above("distance of the middle from the middle, m",
                                            std::abs(x[4].x - (x[0].x + x[8].x) / 2), 0.02),
                                      above("speed at the end", j.last.max_speed, 0.1),
                                      above("stretch of the lower edge",
                                            std::abs(glm::distance(x[72], x[80]) - 1), 0.2));
                   },
                   only(MethodKind::implicit_constraints) | kHoldsThreshold});
    out.back().work = [](const Journey& j) { return 0.5 * 1000 * 1 * 3 + pushed_by(1)(j); };
    out.push_back({"F17", "stretch stiffness 1e-06 N/m", with_stretch(hanging(4, 0), 1e-6), 60,
                   [](const Journey& j) { // next to nothing holds it: it falls
                       const double t = j.world.time();
                       return above("error of the fall", std::abs(lifted(j) / (-9.81 * t * t / 2) - 1), 0.01);
                   },
                   kOwnStiffness | kHoldsThreshold});
    for (const double stiffness : {1e12, kInfinity})
        out.push_back(
            {"F17", stiffness > 1e300 ? "rigid" : "stretch stiffness 1e+12 N/m",
             with_stretch(hanging(4), stiffness), 60,
             [](const Journey& j) { return each_of(above("stretch", j.last.max_stretch, 0.01), calm(j)); },
             kSweeps | only(MethodKind::implicit_constraints)});
}

void add_extremes(std::vector<MapCase>& out)
{
    out.push_back({"G03", "an impulse of 1e6 N on one vertex",
                   [] {
                       Scene s = hanging(6, 5);
                       s.external_forces = true;
                       return s;
                   }(),
                   600, [](const Journey& j) { return hangs(j, kHang6); }, kOwnStiffness | kTangles,
                   [](World& world, int step) {
                       if (step == 10 || step == 11)
                           world.set_force(30, step == 10 ? glm::dvec3(0, 0, 1e6) : glm::dvec3(0));
                   }});
    // (F h)^2 / 2 m of the vertex, which is a 36th of the cloth.
    out.back().work = [](const Journey& j) { return 0.5 * std::pow(1e6 / 60, 2) / (free_mass(j) / 36); };
    out.push_back({"G04", "gravity of 1e4 m/s^2, turned over every frame for a second", hanging(6, 5), 360,
                   [](const Journey& j) { return hangs(j, kHang6); }, kOwnStiffness | kTangles,
                   [](World& world, int step) {
                       world.set_gravity({0, step >= 60 ? -9.81 : step % 2 ? 1e4 : -1e4, 0});
                   }});
    // A turn gives no more than twice the weight times the way, which is less than the diagonal.
    out.back().work = [](const Journey& j) { return 60 * 2 * free_mass(j) * 1e4 * std::sqrt(2.0); };
    out.push_back({"gust", "a flag in a gust of 50 m/s",
                   [] {
                       Scene s = hanging(8, 0.1);
                       s.bodies[0].pins[0] = hold({0, 9, 18, 27, 36, 45, 54, 63, 72});
                       s.bodies[0].material.drag = 1.2;
                       s.bodies[0].material.friction_drag = 0.05;
                       s.wind.density = 1.2;
                       s.wind.keys = {{0, {2, 0, 1}}, {0.3, {2, 0, 1}}, {0.4, {50, 0, 5}}, {1, {50, 0, -5}}};
                       return s;
                   }(),
                   60,
                   [](const Journey& j) {
                       const auto x = j.world.positions(); // in the gale it streams from its mast
                       return each_of(
                           above("missing of the length downwind, m", 1 - (x[44].x - x[36].x), 0.3),
                           above("speed", j.last.max_speed, 100));
                   }});
    out.back().work = pushed_by(50);
}

/// Real meshes, hung by what is highest.
void add_real(std::vector<MapCase>& out)
{
    for (const char* file : {"elephant-with-holes.off", "dress_stage.obj"})
    {
        const auto path = find_data(std::string("meshes/") + file);
        if (!path)
            continue;
        Scene s;
        Body body;
        body.shape.kind = ShapeKind::mesh;
        body.shape.file = *path;
        body.material.stretch_stiffness = 100;
        body.material.bending_stiffness = 1e-5;
        Pin pin;
        pin.use_box = true;
        s.bodies = {body};
        s.damping = 1;
        Scene resolved = resolve(s);
        std::vector<glm::dvec3>& x = resolved.bodies[0].mesh.positions;
        double high = -kInfinity, low = kInfinity;
        for (const glm::dvec3& p : x)
        {
            high = std::max(high, p.y);
            low = std::min(low, p.y);
        }
        for (glm::dvec3& p : x) // a metre tall, whatever the file's unit
            p /= high - low;
        std::vector<std::uint32_t> top;
        for (std::uint32_t v = 0; v < x.size(); ++v)
            if (x[v].y >= high / (high - low) - 0.05)
                top.push_back(v);
        resolved.bodies[0].pins = {hold(top)};
        // The largest stretch after 20 steps: mass_spring and implicit_euler agree on it within a fifth.
        const double right = std::string(file).starts_with("elephant") ? 0.65 : 0.13;
        // 2,798 and 15,656 vertices: a third of what the map costs, so a short run takes three steps.
        out.push_back(
            {kDataCase,
             file,
             resolved,
             20,
             [right](const Journey& j) {
                 return each_of(
                     above("error of the stretch", std::abs(j.last.max_stretch / right - 1), 0.3), calm(j));
             },
             // 20 steps are too few for sweeps, and one linearisation a solve for springs that soft.
             kPositionBased | kLinearised | only(MethodKind::vbd),
             {},
             -1});
    }
}

} // namespace

void add_contact_and_more(std::vector<MapCase>& out)
{
    add_contact(out);
    add_constraints(out);
    add_extremes(out);
    add_real(out);
}

} // namespace taut::hard
