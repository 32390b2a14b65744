// Time steps, masses and stiffnesses at their ends (methods 2.A).

#include "hard/cases.hpp"

using namespace taut;
using namespace taut::hard;

TEST_CASE("A10: a time step that is no time step is refused and changes nothing [hard]")
{
    const double denormal = std::numeric_limits<double>::denorm_min();
    on_every_device([&](const auto& device) {
        World world(test::hanging(3), device);
        run(world, 3);
        const WorldState before = world.state();
        for (const double bad :
             {0.0, -0.0, -1.0 / 60, kNaN, 1e30, kInfinity, -kInfinity, 1.0000001, 1e-16, denormal})
        {
            INFO(bad);
            Scene scene = test::hanging(3);
            scene.timestep = bad;
            CHECK(refusal_of([&] { World refused(scene, device); }) == "bad_timestep");
            CHECK(refusal_of([&] { world.set_timestep(bad); }) == "bad_timestep");
        }
        CHECK(same_state(world.state(), before));
        CHECK(world.plan().timestep == 1.0 / 60);
        run(world, 2);
        World straight(test::hanging(3), device);
        run(straight, 5);
        CHECK(same_state(world.state(), straight.state()));
        check_sound(world);
    });
}

namespace {

/// A metre of rigid link from its rest angle of 30 degrees.
Scene pendulum(double timestep)
{
    Scene scene = test::chain(1, 1, 1);
    scene.bodies[0].material.stretch_stiffness = kInfinity;
    scene.bodies[0].start_positions = {{0, 0, 0}, {0.5, -std::sqrt(0.75), 0}};
    scene.timestep = timestep;
    return scene;
}

/// Time of the third passage through the lowest point over 1.25 periods' share of it, s. Lengths of the
/// steps are `step(time)`.
template <typename Step>
double measured_period(World& world, Step step)
{
    double before = world.positions()[1].x;
    int passages = 0;
    while (world.time() < 10)
    {
        step(world);
        const double from = world.time(), now = world.positions()[1].x;
        if ((before > 0) != (now > 0) && ++passages == 3)
            return (from - world.plan().timestep * std::abs(now) / std::abs(now - before)) / 1.25;
        before = now;
    }
    return 0;
}

constexpr double kPeriod = 2.040989889519130; // of 30 degrees, methods A3

} // namespace

TEST_CASE("A12: a pendulum swings on through changes of the time step [hard]")
{
    on_every_device([](const auto& device) {
        double fixed = 0, jump = 0;
        for (const double h : {1.0 / 60, 1.0 / 240, 1.0 / 30})
        {
            World world(pendulum(h), device);
            fixed =
                std::max(fixed, std::abs(measured_period(world, [](World& w) { w.step(); }) / kPeriod - 1));
        }
        const auto change = [&](World& w) {
            const double h = w.time() < 0.6 ? 1.0 / 60 : w.time() < 1.2 ? 1.0 / 240 : 1.0 / 30;
            const glm::dvec3 velocity = w.velocities()[1];
            if (h != w.plan().timestep)
                w.set_timestep(h);
            w.step();
            jump = std::max(jump, glm::length(w.velocities()[1] - velocity) / (9.81 * h));
        };
        World world(pendulum(1.0 / 60), device);
        const std::size_t passes = world.plan().passes.size();
        const double changed = std::abs(measured_period(world, change) / kPeriod - 1);
        note("A12", *device, "period error, fixed step", fixed);
        note("A12", *device, "period error, changed step", changed);
        note("A12", *device, "velocity jump / (g h)", jump);
        CHECK(fixed < 1e-4);
        CHECK(changed < 5e-4);
        CHECK(jump < 2);
        CHECK(world.plan().passes.size() == passes);
        check_sound(world);
    });
}

TEST_CASE("A12: a state goes on in a world of another time step as after set_timestep [hard]")
{
    on_every_device([](const auto& device) {
        World first(pendulum(1.0 / 60), device), second(pendulum(1.0 / 240), device);
        run(first, 20);
        second.restore(first.state());
        CHECK(second.time() == Approx(first.time()));
        first.set_timestep(1.0 / 240);
        run(first, 30);
        run(second, 30);
        CHECK(same_state(first.state(), second.state()));
        CHECK(first.time() == Approx(20.0 / 60 + 30.0 / 240));
        CHECK(second.time() == first.time());
    });
}

TEST_CASE("A11: steps of a microsecond fall as far as they should, 100 m from the origin [hard]")
{
    Body body = particles({{100, 100, 100}});
    Scene scene = alone(body);
    scene.gravity = {0, -9.81, 0};
    scene.timestep = 1e-6;
    scene.method.substeps = 1;
    const auto error_after = [](const Scene& s, const std::shared_ptr<Device>& device, int steps) {
        World world(s, device);
        run(world, steps);
        check_sound(world, world.plan().warnings.empty() ? Words{} : Words{"precision"});
        const double n = steps, fall = 9.81 * 1e-12 * n * n / 2;
        return std::abs(s.bodies[0].mesh.positions[0].y - world.positions()[0].y - fall) / fall;
    };
    on_every_device([&](const auto& device) {
        const int steps = steps_for(*device, 100000, 5000);
        const double error = error_after(scene, device, steps);
        note("A11", *device, "fall, error at 100 m", error);
        CHECK(error < 0.01);
        CHECK(make_plan(scene).warnings.empty());
    });
    Scene far = scene; // where float cannot, the plan says so, and double can
    far.bodies[0].mesh.positions[0] *= 1000;
    const auto device = test_device("cpu:serial");
    note("A11", *device, "fall, error at 100 km", error_after(far, device, 20000));
    REQUIRE(make_plan(far).warnings.size() == 1);
    CHECK(make_plan(far).warnings[0].word == "precision");
    far.method.precision = Precision::float64;
    CHECK(make_plan(far, measure_traits(*device)).warnings.empty());
    CHECK(error_after(far, device, 20000) < 0.01);
}

TEST_CASE(
    "A13: what is all held stays bit by bit, costs no solver pass, and violated springs are named [hard]")
{
    Scene scene = test::hanging(4);
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    scene.bodies[0].start_positions[7] += glm::dvec3(0.1, 0.2, 0.3);
    scene.bodies[0].material.bending_stiffness = 1e-3;
    for (std::uint32_t v = 0; v < 25; ++v)
        scene.bodies[0].pins[0].vertices.push_back(v);
    on_every_device([&](const auto& device) {
        World world(scene, device);
        CHECK(world.plan().constraints.empty());
        CHECK(world.plan().passes.size() == 2 * world.plan().substeps);
        REQUIRE(world.plan().warnings.size() == 1);
        CHECK(world.plan().warnings[0].word == "conflict");
        const WorldState before = world.state();
        run(world, 100);
        CHECK(same_state(world.state(), before));
        check_sound(world, {"conflict"});
    });
}

TEST_CASE("A15: a spring without stiffness leaves a free particle, bit by bit [hard]")
{
    Scene soft = test::hanging(4);
    soft.bodies[0].material.stretch_stiffness = 0;
    soft.bodies[0].velocity = {0.3, 1, -0.2};
    Scene loose = soft;
    loose.bodies[0].springs = {{7, 8, 0.1, 1e30}, {8, 9, 0, 1e30}};
    WorldOptions only;
    only.plan.available_effects = {"motion"};
    for (const std::uint32_t iterations : {1u, 3u})
        on_every_device([&](const auto& device) {
            soft.method.iterations = loose.method.iterations = iterations;
            World none(soft, device, only), zero(soft, device), limp(loose, device);
            for (World* world : {&none, &zero, &limp})
                run(*world, 60);
            CHECK(same_state(none.state(), zero.state()));
            CHECK(same_state(none.state(), limp.state()));
            check_sound(limp);
        });
}

TEST_CASE("A15: masses of 1e12 and 1e-12 kg keep the state finite and the momentum [hard]")
{
    on_every_device([](const auto& device) {
        double worst = 0;
        for (const double heavy : {1.0, 1e12})
            for (const double light : {1.0, 1e-12})
                for (const double compliance : {0.0, 1e-3})
                {
                    Body body = particles({{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}});
                    body.vertex_masses = {heavy, light, heavy};
                    body.springs = {{0, 1, 0.9, compliance}, {1, 2, 1.2, compliance}};
                    body.velocity = {1, 2, 0};
                    World world(alone(body), device);
                    run(world, 120);
                    const StepReport report = check_sound(world);
                    worst = std::max(worst, report.momentum_error);
                    CHECK(report.momentum_error < 1e-5);
                }
        note("A15", *device, "momentum error", worst);
    });
}

TEST_CASE("a bob of 1e6 times the mass stretches its chain but breaks nothing [hard]")
{
    // Methods 2.A A06: XPBD reports a large stretch at such ratios; it has to stay finite. The springs alone
    // would stretch by m g / (k L) = 0.0981.
    on_every_device([](const auto& device) {
        Scene scene = test::chain(10, 1e7, 0.01);
        scene.bodies[0].vertex_masses[10] = 1e4;
        scene.damping = 1;
        World world(scene, device);
        run(world, 300);
        const StepReport report = measure(world);
        CHECK(finite(world.positions()));
        CHECK(report.status != Status::completed); // and it says so
        note("mass ratio 1e6", *device, "max stretch", report.max_stretch);
        CHECK(report.max_stretch > 0);
        CHECK(report.max_stretch < 200);
        CHECK(world.positions()[10].y < -1);
    });
}

TEST_CASE("stiffnesses from 1 to 1e12 N/m live in one scene [hard]")
{
    on_every_device([](const auto& device) {
        Scene scene;
        for (double stiffness = 1; stiffness < 2e12; stiffness *= 100)
            scene.bodies.push_back(test::chain(4, stiffness, 0.01).bodies[0]);
        Body mixed = particles({{0, 0, 0}, {0, -1, 0}, {0, -2, 0}, {0, -3, 0}, {0, -4, 0}}, 0.01);
        mixed.springs = {{0, 1, 1, 1}, {1, 2, 1, 1e-12}, {2, 3, 1, 1e-6}, {3, 4, 1, 1e-12}};
        mixed.pins = {hold({0})};
        scene.bodies.push_back(mixed);
        scene.damping = 2;
        World world(scene, device);
        run(world, 600);
        check_sound(world);
        const auto x = world.positions();
        double worst = 0;
        for (std::size_t body = 0; body < 7; ++body)
        {
            const double exact = 0.01 * 9.81 * 10 / std::pow(100.0, double(body));
            worst = std::max(worst, std::abs(-x[5 * body + 4].y - 1 - exact) / (1 + exact));
        }
        const double soft = 1 + 0.01 * 9.81 * 4; // the soft link carries all four
        worst = std::max(worst, std::abs(-x[36].y - soft) / soft);
        worst = std::max(worst, std::abs(-x[39].y - soft - 3) / (soft + 3));
        note("stiffness 1..1e12", *device, "worst error of a hanging length", worst);
        CHECK(worst < 1e-3);
    });
}

TEST_CASE("a time step of 1/10 s keeps cloth finite, above the floor and near its lengths [hard]")
{
    on_every_device([](const auto& device) {
        for (const std::uint32_t substeps : {1u, 10u})
        {
            Scene scene = test::everything(6);
            scene.timestep = 0.1;
            scene.method.substeps = substeps;
            scene.bodies[0].pins[0].motion.clear();
            World world(scene, device);
            double fastest = 0, stretch = 0;
            for (int i = 0; i < 100; ++i)
            {
                world.step();
                const StepReport report = measure(world);
                fastest = std::max(fastest, report.kinetic_energy);
                stretch = std::max(stretch, report.max_stretch);
            }
            const StepReport report = measure(world);
            CHECK(finite(world.positions()));
            INFO(substeps << " substeps: " << report.reason);
            CHECK((report.status == Status::completed) == (substeps == 10));
            const char* one = substeps == 1 ? "1 substep" : "10 substeps";
            note("time step 0.1", *device, (std::string("largest stretch on the way, ") + one).c_str(),
                 stretch);
            note("time step 0.1", *device, (std::string("stretch at the end, ") + one).c_str(),
                 report.max_stretch);
            note("time step 0.1", *device, (std::string("penetration at the end, m, ") + one).c_str(),
                 report.penetration);
            note("time step 0.1", *device, (std::string("kinetic energy at most, J, ") + one).c_str(),
                 fastest);
            CHECK(report.kinetic_energy < 0.2 * 9.81); // what a fall of 1 m gives
            if (substeps == 10)
            {
                CHECK(report.penetration < 0.01 * std::sqrt(2.0));
                CHECK(report.max_stretch < 0.1);
            }
        }
    });
}
