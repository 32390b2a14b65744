// The cases of the robustness map that compare runs bit by bit, and the hour of hanging cloth (methods 2.G,
// C04, C10).

#include "hard/map_parts.hpp"

#include "taut/world/sleep.hpp"

namespace taut::hard {
namespace {

using Check = Findings (*)(const Scene&, const std::shared_ptr<Device>&, int);

/// Methods that solve one linear system for all bodies: its sums join them.
constexpr MethodSet kOneSystem = only(MethodKind::implicit_euler) | kLinearised;

/// Two bodies, a corner that is drawn away, a ball, a floor, friction, wind, forces: whatever could remember.
Scene lively_cloth()
{
    Scene scene = hanging(4, 0.1);
    Body& body = scene.bodies[0];
    body.material.stretch_stiffness = 500;
    body.material.drag = 1.2;
    body.pins[0] = hold({0});
    body.pins.push_back(hold({4}));
    body.pins[1].motion = {{0, {0, 0, 0}}, {0.15, {0.3, 0, 0}}, {2, {0.3, 0, 0.5}}};
    scene.bodies.push_back(test::chain(7, 100, 0.01, 0.5).bodies[0]);
    Collider ball;
    ball.point = {0, -0.2, -0.27};
    ball.radius = 0.25;
    ball.friction = 0.3;
    scene.colliders = {ball, flat_floor(-0.52)};
    scene.wind.density = 1.2;
    scene.wind.velocity = {1, 0, -3};
    scene.external_forces = true;
    scene.method.linear_iterations = 12; // bits are compared, not answers
    scene.accept.stretch = 1;
    return scene;
}

/// A block whose upper face is drawn aside and that lies on a floor.
Scene lively_solid()
{
    Body body = block(2, 2e4);
    body.pins = {hold_face("top")};
    body.pins[0].motion = {{0, {0, 0, 0}}, {0.2, {0.2, -0.1, 0}}};
    Scene scene = scene_of(body, 0.1, {0, -9.81, 0});
    scene.colliders = {flat_floor(-0.51)};
    scene.external_forces = true;
    scene.method.linear_iterations = 12;
    return scene;
}

bool same(const World& a, const World& b)
{
    const WorldState x = a.state(), y = b.state();
    return same_state(x, y) && x.kept == y.kept && x.force == y.force;
}

/// Bits of what stands still are no witness.
Measured still(const World& world, const Scene& scene)
{
    double moved = 0;
    std::size_t v = 0;
    const std::vector<glm::dvec3> x = world.positions();
    for (const Body& body : scene.bodies)
        for (const glm::dvec3& rest : body.mesh.positions)
            moved = std::max(moved, glm::distance(rest, x[v++]));
    return never("nothing has moved", moved < 1e-3);
}

/// G05: a force that is no number is refused, and nothing of the world has changed.
Findings refused_force(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World world(scene, device), straight(scene, device);
    for (World* w : {&world, &straight})
    {
        w->set_force(7, {0.1, 0, 0});
        run(*w, steps - 1);
    }
    const std::string word = refusal_of([&] { world.set_force(7, {0, kNaN, 0}); });
    const bool kept = same(world, straight);
    run(world, 3);
    run(straight, 3);
    return each_of(never("a force that is no number is not refused", word != "bad_input"),
                   never("the refused force has changed the state", !kept),
                   never("the refused force has changed what follows", !same(world, straight)),
                   still(world, scene));
}

/// G06.
Findings repeats(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World once(scene, device), twice(scene, device);
    run(once, steps);
    run(twice, steps);
    return each_of(never("two runs end in different bits", !same(once, twice)), still(once, scene));
}

/// G09: with what the method keeps, among it flags and multipliers of constraints.
Findings continues(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World whole(scene, device), half(scene, device), rest(scene, device);
    run(whole, steps);
    run(half, steps / 2);
    const double active = half.active_share();
    rest.restore(half.state());
    run(rest, steps - steps / 2);
    return each_of(never("a restored run ends in different bits", !same(whole, rest)),
                   // Cloth of acad is there with springs of both kinds, or nothing was tested.
                   never("no spring or every spring is active when the state is saved",
                         active >= 0 && scene.bodies.size() > 1 && !(active > 0 && active < 1)),
                   still(whole, scene));
}

/// G08: with all effects that there are, and with those alone that the scene calls for.
Findings unused(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    World with(scene, device);
    WorldOptions only_those;
    only_those.plan.available_effects = {
        "friction"}; // has no passes of its own, so most plans do not list it
    for (const EffectCost& effect : with.plan().effects)
        only_those.plan.available_effects.push_back(effect.name);
    World without(scene, device, only_those);
    run(with, steps);
    run(without, steps);
    return each_of(never("effects that nobody called for change bits", !same(with, without)),
                   never("effects that nobody called for cost bytes",
                         with.plan().bytes_allocated() != without.plan().bytes_allocated()),
                   still(with, scene));
}

/// The first body alone, and three of it beside the others: the largest difference of copies, m.
struct Crowd
{
    double copies = 0, solo = 0;
};

Crowd crowded(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    Scene alone_scene = scene, crowd = scene;
    alone_scene.bodies.resize(1);
    crowd.bodies.insert(crowd.bodies.begin(), 2, scene.bodies[0]);
    World single(alone_scene, device), all(crowd, device);
    run(single, steps);
    run(all, steps);
    const auto x = single.positions(), y = all.positions();
    Crowd out;
    for (std::size_t v = 0; v < 3 * x.size(); ++v)
    {
        out.copies = std::max(out.copies, glm::distance(y[v], y[v % x.size()]));
        out.solo = std::max(out.solo, glm::distance(y[v], x[v % x.size()]));
    }
    return out;
}

Findings copies(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    return above("difference of copies", crowded(scene, device, steps).copies, 0);
}

Findings as_alone(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    Scene solved = scene;
    if (steps >= 60) // this one is about answers where a system joins the bodies
        solved.method.linear_iterations = 100;
    // The sums of a solve join the bodies: a rounding. Under acad the corners that are drawn apart make
    // constraints that cannot all hold, whose answer hangs by that rounding; it stays within the body.
    return above("difference to the body alone", crowded(solved, device, steps).solo, 0);
}

/// C10: hung blocks fall asleep, cost nothing, and the one that a ball comes near wakes.
Findings sleeps(const Scene& scene, const std::shared_ptr<Device>& device, int steps)
{
    SleepWorld world(scene, device);
    for (int k = 0; k < steps; ++k)
        world.step();
    if (steps < 300)
        return so_far({});
    const bool asleep = world.asleep() == scene.bodies.size(), free = world.awake().plan().passes.empty();
    while (world.time() < 9)
        world.step();
    return each_of(never("a body at rest does not sleep", !asleep), never("sleep costs passes", !free),
                   never("a ball comes and the body sleeps on", world.asleep(0)),
                   never("a body that nothing comes near has woken", !world.asleep(1) || !world.asleep(2)));
}

Scene hung_islands()
{
    Scene scene;
    for (int k = 0; k < 3; ++k)
    {
        Body body = block(1, 2e4);
        body.transform.translate = {3.0 * k, 0, 0};
        body.pins = {hold_face("top")};
        scene.bodies.push_back(body);
    }
    Collider ball;
    ball.point = {0, 0, 9};
    ball.radius = 0.3;
    ball.motion = {{7, {0, 0, 0}}, {9, {0, 0, -8.4}}};
    scene.colliders = {ball};
    scene.damping = 4;
    return resolve(scene);
}

} // namespace

void add_repeats(std::vector<MapCase>& out)
{
    const Scene cloth = lively_cloth(), solid = lively_solid();
    const auto add = [&](const char* id, const std::string& what, const Scene& scene, Check check,
                         MethodSet may_report = 0) {
        out.push_back({id, what, scene, 60, {}, may_report, {}, 0, check});
        out.back().compares_bits = true;
        out.back().most_volume = 0.15; // of soft rubber that is drawn aside

        // Springs of 500 N/m whose ends the pins draw 0.6 m apart, wind, a ball: what they may put in.
        out.back().work = [](const Journey& j) { return 0.5 * 500 * 0.36 * 3 + pushed_by(5)(j); };
    };
    for (const bool soft : {false, true})
    {
        const Scene& scene = soft ? solid : cloth;
        const std::string of = soft ? "solid: " : "cloth: ";
        add("G05", of + "a force that is no number", scene, refused_force);
        add("G06", of + "run twice, the same bits", scene, repeats);
        add("G07", of + "three copies, the same bits", scene, copies);
        add("C04", of + "beside others the bits of a body alone", scene, as_alone, kOneSystem);
        add("G08", of + "effects that nobody calls for change no bit", scene, unused);
        add("G09", of + "saved and restored, the same bits", scene, continues);
    }
    out.push_back(
        {"C10", "three hung solids sleep, one wakes for a ball", hung_islands(), 400, {}, 0, {}, 0, sleeps});
    out.back().most_volume = 0.2; // of soft rubber that hangs
    Scene hour = hanging(3, 1);
    hour.method.linear_iterations = 20;
    out.push_back({"G02",
                   "an hour of hanging cloth, 216,000 steps",
                   hour,
                   216000,
                   [](const Journey& j) {
                       return each_of(hangs(j, kHang3),
                                      above("speed / sqrt(g D)",
                                            j.last.max_speed / std::sqrt(9.81 * std::sqrt(2.0)), 1e-4),
                                      above("movement of the pins",
                                            std::max(glm::distance(j.start[0], j.world.positions()[0]),
                                                     glm::distance(j.start[3], j.world.positions()[3])),
                                            0));
                   },
                   kOwnStiffness,
                   {},
                   1200});
}

} // namespace taut::hard
