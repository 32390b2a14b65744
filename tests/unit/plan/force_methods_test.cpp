// What mass-spring and vertex block descent put into a plan: passes by formula, and nothing without need.

#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "taut/plan/effect_names.hpp"
#include "taut/plan/plan.hpp"
#include "taut/plan/vbd.hpp"

#include <algorithm>

using namespace taut;

namespace {

Scene by(Scene scene, const char* method, std::uint32_t substeps, std::uint32_t iterations = 1)
{
    scene.method.type = option_named<MethodKind>(method);
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return scene;
}

std::vector<std::string> effects(const Plan& plan)
{
    std::vector<std::string> out;
    for (const EffectCost& effect : plan.effects)
        out.push_back(effect.name);
    std::sort(out.begin(), out.end());
    return out;
}

std::uint64_t dispatches(const Plan& plan, std::string_view effect)
{
    for (const EffectCost& cost : plan.effects)
        if (cost.name == effect)
            return cost.dispatches_per_step;
    return 0;
}

using Words = std::vector<std::string>;

} // namespace

TEST_CASE("mass-spring is one gather, one kick and the two passes of motion in a substep")
{
    Scene scene = by(test::hanging(8), "mass_spring", 20);
    Plan plan = make_plan(scene);
    CHECK(effects(plan) == Words{"force_kick", "motion", "spring_force"});
    CHECK(plan.passes.size() == 20 * 4 + 1); // the last: where a step would coast to
    CHECK(plan.largest_substep > 0);
    scene.bodies[0].material.bending_stiffness = 1e-5;
    plan = make_plan(scene);
    CHECK(effects(plan) == Words{"corner_sum", "force_kick", "hinge_force", "motion", "spring_force"});
    CHECK(plan.passes.size() == 20 * 6 + 1); // hinges into slots, and their sum
    scene.method.iterations = 7; // means nothing here
    CHECK(make_plan(scene).passes.size() == 20 * 6 + 1);
    scene.method.integrator = Integrator::explicit_euler;
    CHECK(make_plan(scene).passes.size() == 20 * 7);
    scene.method.integrator = Integrator::verlet;
    CHECK(make_plan(scene).passes.size() == 20 * 10);
    scene.bodies[0].material.stretch_stiffness = 0;
    scene.bodies[0].material.bending_stiffness = 0;
    CHECK(make_plan(scene).passes.size() == 20 * 4); // Verlet's own gravity
    scene.method.integrator = Integrator::semi_implicit;
    CHECK(effects(make_plan(scene)) == Words{"motion"});
}

TEST_CASE("vertex block descent is a start, colours times iterations and what the start remembers")
{
    PlanOptions options;
    DeviceTraits apart; // dispatches that cost nothing: no colours share a group
    apart.dispatch_ns = 0;
    Scene scene = by(test::hanging(8), "vbd", 3, 4);
    Plan plan = make_plan(scene, apart);
    const std::uint64_t colours = plan.colour_counts().at("vbd_solve");
    CHECK(effects(plan) == Words{"motion", "vbd_solve", "vbd_start"});
    CHECK(dispatches(plan, "vbd_solve") == 3 * 4 * colours);
    CHECK(dispatches(plan, "vbd_start") == 3 * (2 + 4)); // the guard and the limit are two each
    CHECK(plan.passes.size() == 3 * (2 + 6 + 4 * colours));
    CHECK(plan.constraint_counts().at("vbd_solve") == 81 - 2);
    CHECK(plan.kept.size() == 2); // shares of gravity, lost energy

    scene.method.start = SweepStart::inertial;
    plan = make_plan(scene, apart);
    CHECK(plan.passes.size() == 3 * (2 + 1 + 4 * colours));
    CHECK(plan.kept.empty());

    scene.method.start = SweepStart::adaptive;
    Collider floor;
    floor.kind = ColliderKind::plane;
    floor.friction = 0.3;
    scene.colliders = {floor};
    plan = make_plan(scene, apart);
    CHECK(dispatches(plan, "vbd_start") == 3 * (3 + 4 + 3)); // what is in the way, and what carries bodies
    CHECK(dispatches(plan, "plane") == 3); // once a substep
    CHECK(plan.passes.size() == 3 * (2 + 7 + 3 + 4 * colours + 1));
    CHECK(plan.kept.size() == 4);
    PlanOptions without; // colliders that are left out are not in the way either
    without.available_effects = effect_names(scene);
    std::erase(without.available_effects, "plane");
    plan = make_plan(scene, apart, without);
    CHECK(dispatches(plan, "vbd_start") == 3 * (2 + 4));
    CHECK(dispatches(plan, "plane") == 0);
    Scene loose = scene; // momentum is for what nothing holds: two passes, and what contacts pushed
    loose.bodies[0].pins.clear();
    plan = make_plan(loose, apart);
    CHECK(dispatches(plan, "vbd_start") == 3 * (3 + 4 + 3 + 2));
    CHECK(plan.kept.size() == 5);

    DeviceTraits dear; // dispatches that cost much: all colours in one group
    dear.dispatch_ns = 1e9;
    scene.colliders.clear();
    CHECK(make_plan(scene, dear).passes.size() == 3 * (2 + 6 + 4));
}

TEST_CASE("Chebyshev adds two passes an iteration from 8 iterations on, and no factor leaves [1, 2)")
{
    DeviceTraits apart;
    apart.dispatch_ns = 0;
    Scene scene = by(test::hanging(8), "vbd", 2, 10);
    const std::uint64_t plain = make_plan(scene, apart).passes.size();
    scene.method.spectral_radius = 0.95;
    CHECK(make_plan(scene, apart).passes.size() == plain + 2 * (2 * 10 - 1));
    scene.method.iterations = 7;
    CHECK(dispatches(make_plan(scene, apart), "vbd_accelerate") == 0);

    CHECK(chebyshev_factors(0.9, 7).empty());
    CHECK(chebyshev_factors(0, 100).empty());
    for (const double radius : {0.1, 0.5, 0.9, 0.99, 0.999999})
        for (const std::uint32_t iterations : {8u, 16u, 64u, 1000u})
        {
            const auto factors = chebyshev_factors(radius, iterations);
            REQUIRE(factors.size() == iterations);
            for (std::uint32_t i = 0; i < iterations; ++i)
                CHECK((factors[i] >= 1 && factors[i] < 2));
            CHECK(factors[3] == 1);
            CHECK(factors[4] > 1);
        }
    // Wang 2015, equation 6: 2 / (2 - rho^2), then 4 / (4 - rho^2 omega).
    const auto factors = chebyshev_factors(0.5, 20);
    CHECK(factors[4] == Approx(2 / 1.75));
    CHECK(factors[5] == Approx(4 / (4 - 0.25 * 2 / 1.75)));
}
