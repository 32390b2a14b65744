// Soundness: what is called diverged and unconverged, and what is not.

#include "support/catch.hpp"
#include "support/devices.hpp"
#include "support/scenes.hpp"

#include "taut/report/report.hpp"
#include "taut/report/soundness_watch.hpp"

namespace taut {
namespace {

/// A square of cloth, 0.2 kg, free.
Scene sheet(std::uint32_t cells = 4)
{
    Scene scene;
    Body body;
    body.shape.cells = {cells, cells};
    scene.bodies = {body};
    return resolve(scene);
}

RunState state_of(const Scene& scene, std::span<const glm::dvec3> x, std::span<const glm::dvec3> v,
                  double time)
{
    return {scene, x, v, {time, 1.0 / 600, 9.81 * time, true, 0}, Precision::float32, {}, 0};
}

} // namespace

TEST_CASE("a fall has the energy of its height, and no more")
{
    const Scene scene = sheet();
    const EnergyBudget budget(scene);
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), {0, -9.81, 0});
    for (glm::dvec3& p : x)
        p.y -= 0.5 * 9.81; // one second
    const Soundness fall = judge_state(budget, state_of(scene, x, v, 1));
    CHECK(fall.sound());
    CHECK(fall.energy == Approx(0.5 * 0.2 * 9.81 * 9.81));
    CHECK(fall.energy_most == Approx(fall.energy));
    for (glm::dvec3& w : v)
        w *= 1.5; // 2.25 times the energy
    const Soundness faster = judge_state(budget, state_of(scene, x, v, 1));
    CHECK(faster.status == Status::diverged);
    CHECK_THAT(faster.reason, Contains("kinetic energy"));
}

TEST_CASE("without gravity or motion there is no energy to have")
{
    Scene scene = sheet();
    scene.gravity = glm::dvec3(0);
    const EnergyBudget budget(scene);
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    CHECK(judge_state(budget, state_of(scene, x, std::vector(x.size(), glm::dvec3(0)), 1)).sound());
    const std::vector<glm::dvec3> drift(x.size(), {0.1, 0, 0});
    CHECK(judge_state(budget, state_of(scene, x, drift, 1)).status == Status::diverged);
}

TEST_CASE("what moves passes on its speed; what is pushed, its impulse")
{
    Scene scene = sheet();
    scene.gravity = glm::dvec3(0);
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), {3, 0, 0});
    Collider ball;
    ball.point = {-1.5, 0, 0};
    ball.motion = {{0, {0, 0, 0}}, {2, {2, 0, 0}}};
    Scene hit = scene;
    hit.colliders = {ball};
    CHECK(judge_state(EnergyBudget(hit), state_of(hit, x, v, 1)).sound()); // 1 m/s
    hit.colliders[0].motion.back().time = 20;                              // 0.1 m/s
    CHECK(judge_state(EnergyBudget(hit), state_of(hit, x, v, 1)).status == Status::diverged);
    hit.colliders[0].motion = {{0, {}, {0, 0, 1}, 0}, {1, {}, {0, 0, 1}, 8 * 360, {-1.5, 0, 0}}};
    CHECK(judge_state(EnergyBudget(hit), state_of(hit, x, v, 1)).sound()); // eight turns a second
    hit.colliders[0].point = {-5, 0, 0}; // further away than the sheet can have been
    hit.colliders[0].motion = {{0, {0, 0, 0}}, {2, {2, 0, 0}}};
    CHECK(judge_state(EnergyBudget(hit), state_of(hit, x, v, 1)).status == Status::diverged);
    RunState pushed = state_of(scene, x, v, 1);
    pushed.drive.push = 1; // N s, to a sheet of 0.2 kg
    CHECK(judge_state(EnergyBudget(scene), pushed).sound());
}

namespace {

/// Drawn by one edge, away from the other.
Scene drawn_sheet(const std::vector<Keyframe>& motion = {{0, {0, 0, 0}}, {10, {1, 0, 0}}})
{
    Scene scene = sheet();
    scene.gravity = glm::dvec3(0);
    Pin still, drawn;
    still.vertices = {0, 5, 10, 15, 20};
    drawn.vertices = {4, 9, 14, 19, 24};
    drawn.motion = motion;
    scene.bodies[0].pins = {still, drawn};
    return scene;
}

} // namespace

TEST_CASE("pins that draw a body put in what stretches it")
{
    const Scene scene = drawn_sheet();
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), glm::dvec3(0));
    for (glm::dvec3& p : x)
        p.x *= 2;
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 10)).sound());
    for (glm::dvec3& p : x)
        p.x *= 4;
    CHECK_FALSE(judge_state(EnergyBudget(scene), state_of(scene, x, v, 10)).sound());
}

TEST_CASE("what pins hold drawn moves nothing until they let it go")
{
    const std::vector<glm::dvec3> x = sheet().bodies[0].mesh.positions;
    const std::vector<glm::dvec3> v(x.size(), glm::dvec3(0, 0, 100)); // less than is held
    const auto judged = [&](const Scene& scene) {
        return judge_motion(EnergyBudget(scene), state_of(scene, x, v, 10)).status;
    };
    Scene scene = drawn_sheet();
    CHECK(judged(scene) == Status::diverged);
    scene.bodies[0].material.tear_strain = 0.2;
    CHECK(judged(scene) == Status::completed);
    CHECK(judged(drawn_sheet({{0, {0, 0, 0}}, {5, {2, 0, 0}}, {10, {1, 0, 0}}})) == Status::completed);
    // Pushed together, it may buckle.
    CHECK(judged(drawn_sheet({{0, {0, 0, 0}}, {10, {-0.5, 0, 0}}})) == Status::completed);
}

TEST_CASE("sweeps may leave a thousandth of all energy as motion in what pins hold drawn")
{
    const Scene scene = drawn_sheet();
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    const EnergyBudget budget(scene);
    const auto judged = [&](double speed) {
        const std::vector<glm::dvec3> v(x.size(), glm::dvec3(0, 0, speed));
        return judge_motion(budget, state_of(scene, x, v, 10));
    };
    const Soundness still = judged(0);
    const double speed = std::sqrt(2 * still.energy_most / budget.mass());
    CHECK(judged(speed * std::sqrt(0.5e-3)).sound());
    CHECK(judged(speed * std::sqrt(1e-2)).status == Status::diverged);
}

TEST_CASE("constraint enforcement that leaves springs changing their length has not solved them")
{
    Scene scene = sheet();
    scene.method.type = MethodKind::implicit_constraints;
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    const double substep = state_of(scene, x, x, 1).drive.substep;
    std::vector<glm::dvec3> v;
    const auto judged = [&](double rate) { // of strain, a substep
        v.clear();
        for (const glm::dvec3& p : x)
            v.push_back(p * (rate / substep));
        RunState state = state_of(scene, x, v, 1);
        state.drive.push = 1e6; // energy enough
        return judge_state(EnergyBudget(scene), state);
    };
    CHECK(judged(0.09).sound());
    const Soundness found = judged(0.2);
    CHECK(found.status == Status::unconverged);
    CHECK_THAT(found.reason, Contains("change their length by 20 %"));
    scene.method.type = MethodKind::xpbd;
    CHECK(judged(0.2).sound());
}

TEST_CASE("a body goes faster than the pins that carry it where they turn back often")
{
    Scene scene = sheet();
    scene.gravity = glm::dvec3(0);
    Pin carried; // at 1 m/s
    carried.vertices = {0, 1, 2, 3, 4};
    carried.motion = {{0, {0, 0, 0}}, {10, {10, 0, 0}}};
    scene.bodies[0].pins = {carried};
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    const std::vector<glm::dvec3> v(x.size(), glm::dvec3(0, 0, 6));
    const auto judged = [&] { return judge_motion(EnergyBudget(scene), state_of(scene, x, v, 10)).status; };
    CHECK(judged() == Status::diverged);
    carried.motion.clear();
    for (int k = 0; k <= 10; ++k)
        carried.motion.push_back({double(k), {k % 2, 0, 0}});
    scene.bodies[0].pins = {carried};
    CHECK(judged() == Status::completed);
}

TEST_CASE("strain without the energy for it is unconverged, with it sound")
{
    Scene scene = sheet();
    scene.bodies[0].material.stretch_stiffness = 1e6;
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), glm::dvec3(0));
    for (glm::dvec3& p : x)
        p.x *= 1.2;
    const Soundness stretched = judge_state(EnergyBudget(scene), state_of(scene, x, v, 1));
    CHECK(stretched.status == Status::diverged); // 2e4 J
    scene.bodies[0].material.stretch_stiffness = 30;
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).status == Status::unconverged);
    scene.accept.stretch = 0.3;
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).sound());
    scene.accept.stretch = 0.1;
    scene.bodies[0].start_positions = x; // it began so
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).sound());
}

TEST_CASE("cloth that is bent without the energy for it is unconverged, under pbd it has no stiffness")
{
    Scene scene = sheet();
    scene.gravity = glm::dvec3(0);
    scene.bodies[0].material.bending_stiffness = 1;
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    double middle = 0;
    for (const glm::dvec3& p : x)
        middle += p.x / static_cast<double>(x.size());
    for (glm::dvec3& p : x) // folded along the middle: every spring as long as it was but those across it
        if (p.x > middle + 1e-9)
            p = {middle, p.y, p.z + p.x - middle};
    const std::vector<glm::dvec3> still(x.size(), glm::dvec3(0));
    scene.bodies[0].material.stretch_stiffness = 1e-3;
    const auto judged = [&](const char* method) {
        scene.method.type = option_named<MethodKind>(method);
        return judge_state(EnergyBudget(scene), state_of(scene, x, still, 1));
    };
    CHECK_FALSE(judged("xpbd").sound());
    CHECK(judged("xpbd").energy > 1); // (pi/2)^2 / 2 times some hinges
    CHECK(judged("pbd").energy < 1e-3);
    scene.bodies[0].material.bending_stiffness = 0;
    CHECK(judged("xpbd").sound());
}

TEST_CASE("a body that flows is left out of strained energy, not those beside it")
{
    Scene scene = sheet();
    scene.bodies[0].material.stretch_stiffness = 1e6;
    scene.bodies.push_back(scene.bodies[0]);
    scene.bodies[1].material.plastic_yield = 0.05;
    const std::vector<glm::dvec3> rest = scene.bodies[0].mesh.positions;
    std::vector<glm::dvec3> x = rest, v(2 * rest.size(), glm::dvec3(0));
    x.insert(x.end(), rest.begin(), rest.end());
    for (std::size_t i = 0; i < rest.size(); ++i)
        x[i].x *= 1.2;
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).status == Status::diverged);
    for (std::size_t i = 0; i < rest.size(); ++i)
        std::swap(x[i], x[rest.size() + i]); // now the plastic one is longer: it may rest there
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).sound());
}

TEST_CASE("pbd answers for its springs, and tetrahedra for their inside")
{
    Scene scene = sheet();
    scene.method.type = MethodKind::pbd;
    std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), glm::dvec3(0));
    for (glm::dvec3& p : x)
        p.x *= 1.2;
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).status == Status::unconverged);
    scene.method.stretch = 0.4; // soft on purpose
    CHECK(judge_state(EnergyBudget(scene), state_of(scene, x, v, 1)).sound());

    Scene solid;
    Body box;
    box.shape.kind = ShapeKind::box;
    box.shape.box_cells = {2, 2, 2};
    box.material = solid_material();
    solid.bodies = {box};
    solid = resolve(solid);
    std::vector<glm::dvec3> y = solid.bodies[0].mesh.positions;
    const std::vector<glm::dvec3> still(y.size(), glm::dvec3(0));
    CHECK(judge_state(EnergyBudget(solid), state_of(solid, y, still, 1)).sound());
    for (glm::dvec3& p : y)
        p.x = -p.x;
    solid.bodies[0].start_positions = y;
    const Soundness inside_out = judge_state(EnergyBudget(solid), state_of(solid, y, still, 1));
    CHECK(inside_out.status == Status::unconverged);
    CHECK_THAT(inside_out.reason, Contains("40 tetrahedra are inverted"));
}

TEST_CASE("a volume that is rigid, or that pbd keeps, is as large as at rest")
{
    const auto judged = [](const char* volume, const char* method, double stiffness, double height) {
        Scene scene;
        Body box;
        box.shape.kind = ShapeKind::box;
        box.shape.box_cells = {2, 2, 2};
        box.material = solid_material();
        box.material.model = SolidModel::springs;
        box.material.volume = option_named<HeldVolume>(volume);
        box.material.volume_stiffness = stiffness;
        box.material.youngs_modulus = 1e-3; // next to no energy
        scene.bodies = {box};
        scene.method.type = option_named<MethodKind>(method);
        scene.method.stretch = 0; // only the volume is judged
        scene = resolve(scene);
        std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
        for (glm::dvec3& p : x)
            p.y *= height;
        const std::vector<glm::dvec3> still(x.size(), glm::dvec3(0));
        return judge_state(EnergyBudget(scene), state_of(scene, x, still, 1));
    };
    const double rigid = std::numeric_limits<double>::infinity();
    for (const char* volume : {"tetrahedra", "surface"})
    {
        INFO(volume);
        const Soundness squeezed = judged(volume, "xpbd", rigid, 0.8);
        CHECK(squeezed.status == Status::unconverged);
        CHECK_THAT(squeezed.reason, Contains("volume") && Contains("off by 20 %"));
        CHECK(judged(volume, "xpbd", rigid, 1.2).status == Status::unconverged);
        CHECK(judged(volume, "xpbd", rigid, 0.95).sound());
        CHECK(judged(volume, "xpbd", 1, 0.8).sound()); // soft: it may give way
        CHECK(judged(volume, "pbd", 1, 0.8).status == Status::unconverged);
        CHECK(judged(volume, "pbd", 1, 0.95).sound());
    }
}

TEST_CASE("a start within a collider throws a body out at twice the speed of the way out, no faster")
{
    Scene scene;
    Body box;
    box.shape.kind = ShapeKind::box;
    box.material = solid_material();
    scene.bodies = {box};
    scene = resolve(scene);
    scene.depenetration_speed = 0.5;
    scene.colliders.resize(1);
    scene.colliders[0].kind = ColliderKind::plane;
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions;
    for (const glm::dvec3& p : x)
        scene.colliders[0].point.y =
            std::min(scene.colliders[0].point.y, p.y + 1e-9); // flush, but for a digit
    const auto judged = [&](double speed) {
        const std::vector<glm::dvec3> v(x.size(), {0, speed, 0});
        return judge_motion(EnergyBudget(scene), state_of(scene, x, v, 1)).status;
    };
    CHECK(judged(1) == Status::completed);
    CHECK(judged(2) == Status::diverged);
}

TEST_CASE("a clamp that the scene did not ask for is a blow-up")
{
    Scene scene = sheet();
    const std::vector<glm::dvec3> x = scene.bodies[0].mesh.positions, v(x.size(), glm::dvec3(0));
    RunState state = state_of(scene, x, v, 1);
    state.vertex_substeps = 1e4;
    state.events.speed_clamped = 50;
    CHECK(judge_motion(EnergyBudget(scene), state).status == Status::diverged);
    scene.max_speed = 10;
    CHECK(judge_motion(EnergyBudget(scene), state).sound());
    state.events.speed_clamped = 500;
    CHECK(judge_motion(EnergyBudget(scene), state).status == Status::unconverged);
}

TEST_CASE("constraint enforcement whose springs turn too far again and again is not solved")
{
    Scene scene = sheet();
    scene.method.type = MethodKind::implicit_constraints;
    const auto springs = static_cast<double>(stretch_elements(scene.bodies[0]).size());
    const auto vertices = static_cast<double>(scene.bodies[0].mesh.positions.size());
    const auto judged = [&](double share) { // of all springs, in each of 100 substeps
        Events events;
        events.speed_clamped = static_cast<std::uint64_t>(share * springs * 100);
        return judge_clamps(scene, events, vertices * 100);
    };
    CHECK(judged(0).sound());
    CHECK(judged(0.04).sound());
    const Soundness turned = judged(0.06);
    CHECK(turned.status == Status::unconverged);
    CHECK_THAT(turned.reason, Contains("of all springs turned too far"));
}

TEST_CASE("explicit springs beyond their stable step are diverged, long before 1e12 m")
{
    Scene scene = test::hanging(8);
    scene.method.type = MethodKind::mass_spring;
    scene.method.substeps = 1;
    scene.method.stability = StabilityRule::ignore;
    World world(scene, Device::open("cpu:serial"));
    for (int k = 0; k < 30; ++k)
        world.step();
    const StepReport report = measure(world);
    CHECK(rank(report.status) >= rank(Status::diverged));
    CHECK_FALSE(report.reason.empty());
}

TEST_CASE("dear steps are looked at often, cheap ones eight times a run")
{
    Scene scene = test::hanging(16);
    scene.method.substeps = 10;
    const auto every = [&](const char* method, std::uint64_t frames) {
        scene.method.type = option_named<MethodKind>(method);
        return frames_between_looks(make_plan(scene), frames);
    };
    CHECK(every("xpbd", 80) == 10);
    CHECK(every("implicit_euler", 80) <= 2);
    CHECK(every("implicit_euler", 3) <= 2); // shorter than the looks that any run has
    const std::uint64_t paid = every("xpbd", 1000000);
    CHECK(paid > 10);
    CHECK(paid < 1000); // also of a long run
    CHECK(every("vbd", 1000000) < paid);
}

} // namespace taut
