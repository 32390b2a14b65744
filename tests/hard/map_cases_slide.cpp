// The cases of the robustness map with friction, gaps, sharp and spinning colliders, for cloth and for solids
// (methods 2.E: E02, E04, E06, E07, E10, E11, E13).

#include "hard/map_parts.hpp"

namespace taut::hard {
namespace {

Collider capsule(const glm::dvec3& from, const glm::dvec3& to, double radius, double friction)
{
    Collider c;
    c.kind = ColliderKind::capsule;
    c.point = from;
    c.end = to;
    c.radius = radius;
    c.friction = friction;
    return c;
}

Collider box(const glm::dvec3& centre, const glm::dvec3& half, double friction)
{
    Collider c;
    c.kind = ColliderKind::cuboid;
    c.point = centre;
    c.half_size = half;
    c.friction = friction;
    return c;
}

/// Lying at a height above y = 0: a square metre of soft cloth, or a flat block 1 x 0.25 x 1 m.
Scene lying(bool solid, double height, double modulus = 1e5)
{
    Scene scene;
    if (solid)
    {
        Body body = solid_box({4, 1, 4}, {1, 0.25, 1}, modulus);
        body.transform.translate = {0, height + 0.125, 0};
        scene = scene_of(body, 0);
    }
    else
    {
        scene = free_cloth(4, 500, 1e-5);
        for (glm::dvec3& x : scene.bodies[0].mesh.positions)
            x = {x.x, height, -x.y};
    }
    scene.gravity = {0, -9.81, 0};
    return scene;
}

double gap(const Scene& scene) { return scene.bodies[0].material.thickness; }
double diagonal(const Journey& j) { return make_model(j.world.scene()).diameter; }

struct Slide
{
    double way = 0, speed = 0; ///< m, m/s, along x
    double time = 0;           ///< s
};

/// How far the body slides. A soft body has first settled where it lies, for what still swings up and down
/// touches the floor by turns only.
Slide slid(const Scene& scene, const std::shared_ptr<Device>& device, int steps, bool settle)
{
    Scene s = scene;
    if (settle &&
        s.method.type !=
            MethodKind::pbd) // which has no dampers; springs that swing for ever slip where they should
        s.bodies[0].material.stretch_damping = 1e-3; // hold
    if (settle)
    {
        Scene still = s;
        still.damping = 5;
        still.bodies[0].velocity = {0, 0, 0};
        still.colliders[0].friction = 2;
        World rest(still, device);
        run(rest, std::min(steps, 120));
        s.bodies[0].start_positions = rest.positions();
    }
    World world(s, device);
    const double from = mean(world.positions()).x;
    run(world, steps);
    return {mean(world.positions()).x - from, mean(world.velocities()).x, world.time()};
}

void add_slope(std::vector<MapCase>& out, bool solid, double mu)
{
    Scene s = lying(solid, 0.001, 1e6);
    const double slope = std::atan(0.5);
    s.gravity = {9.81 * std::sin(slope), -9.81 * std::cos(slope), 0};
    s.colliders = {flat_floor(0, mu)};
    const int wanted = 120;
    const auto check = [=](const Scene& scene, const std::shared_ptr<Device>& device, int steps) -> Findings {
        const Slide end = slid(scene, device, steps, solid);
        const Findings found = mu >= 0.5 ? above("creep, m/s", std::abs(end.speed), 1e-3)
                                         : above("error of the acceleration",
                                                 std::abs(end.speed / (0.087743307437 * end.time) - 1), 0.2);
        return steps < wanted ? so_far(found) : found;
    };
    out.push_back({"E06",
                   (solid ? "solid" : "cloth") + std::string(" on a slope of tan 0.5, friction ") + shown(mu),
                   s,
                   wanted,
                   {},
                   mu < 0.5 ? only(MethodKind::vbd) : 0,
                   {},
                   0,
                   check});
}

void add_friction(std::vector<MapCase>& out, bool solid)
{
    add_slope(out, solid, 0.49);
    add_slope(out, solid,
              solid ? 0.6 : 0.5); // corners of a soft block slip alone below the friction of the whole
    for (const double mu : {0.1, 0.5, 1.0})
    {
        Scene s = lying(solid, 0.001, 1e6);
        s.bodies[0].velocity = {10, 0, 0};
        s.colliders = {flat_floor(0, mu)};
        const double exact = 100 / (2 * mu * 9.81);
        const int wanted = int(60 * (10 / (mu * 9.81) + 0.5));
        const auto check = [=](const Scene& scene, const std::shared_ptr<Device>& device,
                               int steps) -> Findings {
            const Slide end = slid(scene, device, steps, solid);
            const Findings found = above("error of the way / way", std::abs(end.way / exact - 1),
                                         std::max(0.02, 10 * scene.timestep / exact));
            return steps < wanted ? so_far(found) : found;
        };
        out.push_back(
            {"E07",
             (solid ? "solid" : "cloth") + std::string(" slides with 10 m/s, friction ") + shown(mu),
             s,
             wanted,
             {},
             0,
             {},
             solid && mu < 0.5 ? -1 : 0,
             check});
    }
}

void add_gaps(std::vector<MapCase>& out, bool solid)
{
    const std::string of = solid ? "solid " : "cloth ";
    Scene between = lying(solid, solid ? -0.125 : 0);
    between.gravity = {0, 0, 0};
    between.bodies[0].velocity = {10, 1, 0}; // sideways too: what met neither would leave by a metre
    const double half = (solid ? 0.125 : 0) + gap(between) + 0.5e-4; // of the space between them
    between.colliders = {box({0, -half - 1, 0}, {100, 1, 2}, 0), box({0, half + 1, 0}, {100, 1, 2}, 0)};
    out.push_back({"E02", of + "slides between two boxes 0.1 mm wider", between, 60, [](const Journey& j) {
                       return each_of(
                           above("penetration", j.deepest, 1e-3),
                           above("loss of speed", std::abs(mean(j.world.velocities()).x / 10 - 1), 0.01));
                   }});
    Scene inside = lying(solid, 0);
    const double deep = 0.1 * (solid ? std::sqrt(2.0625) : std::sqrt(2.0));
    inside.colliders = {flat_floor(deep, 0)};
    out.push_back({"E04", of + "starts a tenth of its size below a floor", inside, 60,
                   [deep](const Journey& j) {
                       return each_of(above("depth / D", j.last.penetration / diagonal(j), 0.01),
                                      above("speed / speed of a fall so deep",
                                            j.fastest / std::sqrt(2 * 9.81 * deep), 1));
                   },
                   solid ? kForces : 0});
    out.back().work = [deep](const Journey& j) {
        return free_mass(j) * 9.81 * (deep + gap(j.world.scene()));
    }; // it is lifted out
}

/// Held by a face or a corner that lies inside a ball.
void add_held(std::vector<MapCase>& out)
{
    Body body = block(3, 1e5);
    body.pins = {hold_face("top")};
    Scene s = scene_of(body, 3, {0, -9.81, 0});
    Collider ball;
    ball.point = s.bodies[0].mesh.positions[s.bodies[0].pins[0].vertices[0]] + glm::dvec3(0.02, 0.02, 0);
    ball.radius = 0.1;
    ball.friction = 0.3;
    s.colliders = {ball};
    out.push_back(
        {"E10", "solid, a pinned corner inside a ball", s, 300, [](const Journey& j) {
             const std::uint32_t held = j.world.scene().bodies[0].pins[0].vertices[0];
             const auto conflicts = j.last.warnings.find("conflict");
             return each_of(
                 above("movement of the pin", glm::distance(j.start[held], j.world.positions()[held]), 0),
                 never("no conflict is said", conflicts == j.last.warnings.end()),
                 above("speed / sqrt(g D)", j.last.max_speed / std::sqrt(9.81 * diagonal(j)), 1e-3),
                 above("depth", j.last.penetration, 1e-6));
         }});
}

void add_sharp(std::vector<MapCase>& out, bool solid)
{
    const std::string of = solid ? "solid " : "cloth ";
    // What hangs over it sinks by half its length; without contact it is 4.9 m down.
    const auto held_up = [](const Journey& j) {
        return each_of(above("depth / D", j.deepest / diagonal(j), 0.01),
                       above("fall of the centre, m", fallen(j), 0.7));
    };
    const double pressed = 0.15; // of its volume, for a moment
    Scene s = lying(solid, 0.1);
    Collider corner = box({0, -0.44, 0}, {0.25, 0.25, 0.25}, 0.3);
    corner.rotate_axis = {1, 0, -1};
    corner.rotate_degrees = 54.7356;
    s.colliders = {corner};
    out.push_back({"E11", of + "falls on a corner of a box", s, 60, held_up});
    out.back().most_volume = pressed;
    s.colliders = {capsule({0.013, -1, 0.007}, {0.013, 0, 0.007}, 1e-3, 0.3)};
    s.colliders[0].meets = ColliderMeets::surface; // it stands between the vertices
    out.push_back({"E11", of + "falls on a spike of 1 mm", s, 60, held_up});
    out.back().most_volume = pressed;
}

void add_spinning(std::vector<MapCase>& out, bool solid)
{
    const std::string of = solid ? "solid " : "cloth ";
    for (const bool round : {true, false})
    {
        Scene s = lying(solid, 0.32);
        Collider c =
            round ? capsule({-0.2, 0, 0}, {0.2, 0, 0}, 0.1, 0.5) : box({0, 0, 0}, {0.2, 0.1, 0.1}, 0.5);
        c.motion = {{0, {0, 0, 0}, {0, 0, 1}, 0}, {1, {0, 0, 0}, {0, 0, 1}, 50 * 57.29577951308232}};
        s.colliders = {c};
        // No point of a body is thrown faster than the tip pushes and a second's fall adds.
        const double tip = 50 * (round ? 0.301 : std::hypot(0.201, 0.101));
        out.push_back({"E13", of + "on a " + (round ? "capsule" : "box") + " that spins with 50 rad/s", s, 60,
                       [tip](const Journey& j) {
                           const glm::dvec3 way = mean(j.world.positions()) - mean(j.start);
                           // What is wound round it stays there, and goes round; without contact it falls
                           // 4.9 m, and on a collider whose surface does not move it rests.
                           const double thrown = std::hypot(way.x, way.z) / 0.05;
                           const double wound = way.y > -1 ? j.last.max_speed : 0;
                           return each_of(above("missing of 5 cm sideways, or of 1 m/s where it stays",
                                                1 - std::max(thrown, wound), 0),
                                          above("speed / that of the tip and of the fall",
                                                glm::length(mean(j.world.velocities())) / (tip + 9.81), 1));
                       },
                       solid ? kForces : 0});
        out.back().work = pushed_by(tip);
    }
}

} // namespace

void add_slides(std::vector<MapCase>& out)
{
    for (const bool solid : {false, true})
    {
        add_friction(out, solid);
        add_gaps(out, solid);
        add_sharp(out, solid);
        add_spinning(out, solid);
    }
    add_held(out);
}

} // namespace taut::hard
