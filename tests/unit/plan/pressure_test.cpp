#include "support/catch.hpp"
#include "support/sphere.hpp"

#include "taut/plan/plan.hpp"
#include "taut/plan/pressure.hpp"
#include "taut/runtime/base/error.hpp"

using namespace taut;

namespace {

Scene ball(double pressure)
{
    Scene scene = test::ball_of_springs(3, 0.5, 100, 0);
    scene.method.type = MethodKind::xpbd;
    scene.bodies[0].material.pressure = pressure;
    return scene;
}

const EffectCost* effect_of(const Plan& plan)
{
    for (const EffectCost& cost : plan.effects)
        if (cost.name == "pressure")
            return &cost;
    return nullptr;
}

} // namespace

TEST_CASE("pressure costs two dispatches a substep where a body has it, and nothing elsewhere", "[pressure]")
{
    for (const std::string_view method : kWords<MethodKind>)
    {
        CAPTURE(method);
        Scene scene = ball(5);
        scene.method.type = option_named<MethodKind>(std::string(method));
        scene.method.substeps = 3;
        Scene without = scene;
        without.bodies[0].material.pressure = 0;
        const Plan gas = make_plan(scene), none = make_plan(without);
        REQUIRE(effect_of(gas) != nullptr);
        CHECK(effect_of(none) == nullptr);
        CHECK(effect_of(gas)->dispatches_per_step == 6);
        CHECK(gas.passes.size() == none.passes.size() + 6);
        CHECK(gas.bytes_allocated() == none.bytes_allocated() + effect_of(gas)->bytes_allocated);
        CHECK(gas.warnings.size() == none.warnings.size());
    }
}

TEST_CASE("a gas in a surface that is open, turned in part or flat is refused by name", "[pressure]")
{
    Scene open = ball(5);
    open.bodies[0].mesh.triangles.pop_back();
    CHECK_THROWS_WITH(make_plan(open), Contains("bodies[0].material.pressure") &&
                                           Contains("open at the edge") && Contains("set pressure to 0"));
    Scene turned = ball(5);
    std::swap(turned.bodies[0].mesh.triangles[5][0], turned.bodies[0].mesh.triangles[5][1]);
    CHECK_THROWS_WITH(make_plan(turned), Contains("different sides"));
    Scene chain;
    chain.bodies.resize(1);
    chain.bodies[0].shape.kind = ShapeKind::chain;
    chain.bodies[0].material.pressure = 5;
    CHECK_THROWS_WITH(make_plan(resolve(chain)), Contains("encloses no volume"));
}

TEST_CASE("the plan warns of a gas that substeps cannot follow, with a number that suffices", "[pressure]")
{
    Scene scene = ball(5);
    scene.timestep = 1.0 / 60;
    const auto warns = [](const Plan& plan) {
        for (const PlanWarning& w : plan.warnings)
            if (w.word == "energy_growth" && w.text.find("bodies[0].material.pressure") == 0)
                return true;
        return false;
    };
    const double rate = pressure_rate(scene.bodies[0]); // proportional to the pressure
    const double h = scene.timestep;
    scene.bodies[0].material.pressure = 5 * 3.9 / (rate * h * h);
    CHECK(!warns(make_plan(scene)));
    scene.bodies[0].material.pressure = 5 * 16.1 / (rate * h * h);
    const Plan plan = make_plan(scene);
    CHECK(warns(plan));
    CHECK_THAT(plan.warnings.back().text, Contains("3 substeps would be safe"));
    scene.method.substeps = 3;
    CHECK(!warns(make_plan(scene)));
    // An isothermal gas is stiffer.
    Scene isothermal = ball(5);
    isothermal.bodies[0].material.pressure_law = PressureLaw::isothermal;
    CHECK(pressure_rate(isothermal.bodies[0]) > rate);
}
