// What each effect adds to a plan, by formula, and that without it nothing is there.

#include "support/catch.hpp"
#include "support/methods.hpp"
#include "support/scenes.hpp"

#include "taut/plan/plan.hpp"

#include <functional>

using namespace taut;

namespace {

const EffectCost* find_effect(const Plan& plan, std::string_view name)
{
    for (const EffectCost& effect : plan.effects)
        if (effect.name == name)
            return &effect;
    return nullptr;
}

/// A method whose plan can be made of a scene that has no more than springs.
Scene base(const std::string& method)
{
    Scene scene = test::under(test::hanging(6), method);
    scene.method.substeps = 3;
    scene.method.iterations = 2;
    // The other start remembers contacts (force_methods_test.cpp counts).
    scene.method.start = SweepStart::inertial;
    return scene;
}

struct Row
{
    std::string effect;
    std::function<void(Scene&)> call_for;
    std::uint64_t each_contact = 0, each_substep = 0, each_step = 0; ///< dispatches
};

void add_collider(Scene& scene, ColliderKind kind, double friction = 0, const std::string& meets = "vertices")
{
    Collider c;
    c.kind = kind;
    c.meets = option_named<ColliderMeets>(meets);
    c.friction = friction;
    c.point = {0, -3, 0};
    c.end = {0, -4, 0};
    scene.colliders.push_back(c);
}

std::vector<Row> rows()
{
    return {
        {"capsule", [](Scene& s) { add_collider(s, ColliderKind::capsule); }, 1, 0, 0},
        {"cuboid", [](Scene& s) { add_collider(s, ColliderKind::cuboid); }, 1, 0, 0},
        {"cuboid", [](Scene& s) { add_collider(s, ColliderKind::cuboid, 0, "surface"); }, 9, 0, 0},
        {"attachment", [](Scene& s) { s.bodies[0].material.attachment_slack = 0.1; }, 1, 0, 0},
        {"wind",
         [](Scene& s) {
             s.wind.density = 1.2;
             s.bodies[0].material.drag = 1;
         },
         0, 2, 0},
        {"tearing", [](Scene& s) { s.bodies[0].material.tear_strain = 0.5; }, 0, 0, 1},
    };
}

} // namespace

TEST_CASE("each effect adds its passes and nothing else, under every method", "[effects]")
{
    for (const std::string& method : test::methods())
        for (const Row& row : rows())
        {
            CAPTURE(method, row.effect);
            const Scene plain = base(method);
            Scene with = plain;
            row.call_for(with);
            const Plan before = make_plan(plain), after = make_plan(with);
            CHECK(find_effect(before, row.effect) == nullptr);
            const EffectCost* cost = find_effect(after, row.effect);
            REQUIRE(cost != nullptr);
            const bool every = find_method(plain.method.type).contact_each_iteration;
            const std::uint64_t contacts = before.substeps * (every ? before.iterations : 1u);
            CHECK(cost->dispatches_per_step == row.each_contact * contacts +
                                                   row.each_substep * before.substeps + row.each_step);
            // What pushes before the guess is made has the guess without it formed first, once a step.
            const EffectCost *motion = find_effect(before, "motion"), *moved = find_effect(after, "motion");
            const std::uint64_t coasts = moved->dispatches_per_step - motion->dispatches_per_step;
            CHECK(coasts <= (row.effect == std::string("wind") ? 1u : 0u));
            CHECK(after.passes.size() == before.passes.size() + cost->dispatches_per_step + coasts);
            CHECK(after.bytes_allocated() == before.bytes_allocated() + cost->bytes_allocated +
                                                 moved->bytes_allocated - motion->bytes_allocated);
            // What is left without the effect's passes is the plan without it.
            std::size_t k = 0;
            for (const Dispatch& pass : after.passes)
                if (pass.label != row.effect && !(coasts > 0 && pass.kernel->name == "coast"))
                {
                    REQUIRE(k < before.passes.size());
                    if (coasts > 0 && pass.kernel->name == "predict") // without keeping what coast forms
                        CHECK(before.passes[k].kernel->name == "predict");
                    else
                        CHECK(pass.kernel == before.passes[k].kernel);
                    CHECK(pass.count == before.passes[k].count);
                    CHECK(pass.params == before.passes[k].params);
                    ++k;
                }
            CHECK(k == before.passes.size());
        }
}

TEST_CASE("a strain limit adds a sweep of colours to each visit of contacts", "[effects]")
{
    DeviceTraits traits; // under which no two colours are worth merging
    traits.dispatch_ns = 1;
    traits.group_barrier_ns = 1000;
    PlanOptions options;
    options.small_bodies = PlanOptions::SmallBodies::never;
    for (const std::string& method : test::methods())
    {
        CAPTURE(method);
        const Scene plain = base(method);
        Scene with = plain;
        with.bodies[0].material.strain_limit = 0.1;
        const Plan before = make_plan(plain, traits, options), after = make_plan(with, traits, options);
        CHECK(find_effect(before, "strain_limit") == nullptr);
        const EffectCost* cost = find_effect(after, "strain_limit");
        REQUIRE(cost != nullptr);
        const bool every = find_method(plain.method.type).contact_each_iteration;
        const std::uint64_t sweeps = before.substeps * (every ? before.iterations : 1u);
        CHECK(cost->dispatches_per_step % sweeps == 0);
        const std::uint64_t colours = cost->dispatches_per_step / sweeps;
        CHECK(colours >= 8); // the degree of an inner vertex with both diagonals
        CHECK(colours <= 10);
        CHECK(after.passes.size() == before.passes.size() + cost->dispatches_per_step);
        CHECK(after.bytes_allocated() == before.bytes_allocated() + cost->bytes_allocated);
    }
}

TEST_CASE("settings that cannot act call for nothing", "[effects]")
{
    const Plan plain = make_plan(test::hanging(4));
    const auto same = [&](const std::function<void(Scene&)>& change) {
        Scene scene = test::hanging(4);
        change(scene);
        const Plan plan = make_plan(scene);
        CHECK(plan.passes.size() == plain.passes.size());
        CHECK(plan.bytes_allocated() == plain.bytes_allocated());
    };
    same([](Scene& s) { s.wind.density = 1.2; });          // no drag
    same([](Scene& s) { s.bodies[0].material.drag = 1; }); // no air
    Scene loose = test::hanging(4);
    loose.bodies[0].pins.clear();
    const std::size_t passes = make_plan(loose).passes.size();
    loose.bodies[0].material.attachment_slack = 0;
    CHECK(make_plan(loose).passes.size() == passes);
    loose.bodies[0].material.stretch_stiffness = 0; // no springs
    const std::size_t without = make_plan(loose).passes.size();
    loose.bodies[0].material.strain_limit = loose.bodies[0].material.tear_strain = 0.1;
    CHECK(make_plan(loose).passes.size() == without);
}

TEST_CASE("friction of a shape is a variant of its pass, with a buffer only where iterations share it",
          "[effects]")
{
    for (const ColliderKind kind : {ColliderKind::capsule, ColliderKind::cuboid})
    {
        Scene scene = base("xpbd");
        add_collider(scene, kind);
        const Plan smooth = make_plan(scene);
        scene.colliders[0].friction = 0.3;
        const Plan rough = make_plan(scene);
        CHECK(rough.passes.size() == smooth.passes.size());
        CHECK(find_effect(smooth, "friction") == nullptr);
        REQUIRE(find_effect(rough, "friction") != nullptr);
        CHECK(find_effect(rough, "friction")->bytes_allocated == 16u * rough.vertex_count);
        scene.method.iterations = 1;
        CHECK(find_effect(make_plan(scene), "friction") == nullptr);
    }
}
