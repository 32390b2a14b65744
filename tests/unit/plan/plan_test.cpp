#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/plan/plan.hpp"
#include "taut/runtime/base/error.hpp"
#include "taut/runtime/base/registry.hpp"

#include <algorithm>

using namespace taut;

namespace {

std::vector<std::string> effect_names(const Plan& plan)
{
    std::vector<std::string> names;
    for (const EffectCost& effect : plan.effects)
        names.push_back(effect.name);
    return names;
}

bool same_pass(const Dispatch& a, const Dispatch& b)
{
    const auto same_range = [](const BufferRange& x, const BufferRange& y) {
        return x.buffer == y.buffer && x.offset == y.offset && x.bytes == y.bytes;
    };
    return a.kernel == b.kernel && a.params == b.params && a.count == b.count && a.label == b.label &&
           std::equal(a.bindings.begin(), a.bindings.end(), b.bindings.begin(), b.bindings.end(), same_range);
}

PlanOptions without_groups()
{
    PlanOptions options;
    options.small_bodies = PlanOptions::SmallBodies::never;
    return options;
}

/// Costs under which no two colours are worth merging.
DeviceTraits wide_device()
{
    DeviceTraits traits;
    traits.dispatch_ns = 1;
    traits.group_barrier_ns = 1000;
    return traits;
}

} // namespace

TEST_CASE("a scene gets the effects that it calls for and no others")
{
    CHECK(effect_names(make_plan(test::hanging())) == std::vector<std::string>{"motion", "distance"});
    const auto all = effect_names(make_plan(test::everything()));
    for (const char* name : {"damping", "external_force", "motion", "pin_motion", "distance", "bending",
                             "plane", "sphere", "friction"})
        CHECK(std::count(all.begin(), all.end(), name) == 1);
    const Scene still = resolve(Scene{});
    CHECK(make_plan(still).passes.empty());
    CHECK(make_plan(still).buffers.empty());
}

TEST_CASE("an absent effect has no kernel, no buffer and no dispatch")
{
    const Plan plan = make_plan(test::hanging());
    for (const Dispatch& pass : plan.passes)
        CHECK((pass.kernel->name == "predict" || pass.kernel->name == "finish" ||
               pass.kernel->name == "xpbd_spring"));
    for (const PlanBuffer& buffer : plan.buffers)
        CHECK((buffer.effect == "motion" || buffer.effect == "distance"));
}

TEST_CASE("dispatches follow the formula: substeps (1 + iterations colours + 1)")
{
    Scene scene = test::hanging(16);
    for (const std::uint32_t substeps : {1u, 7u})
        for (const std::uint32_t iterations : {1u, 3u})
        {
            scene.method.substeps = substeps;
            scene.method.iterations = iterations;
            const Plan plan = make_plan(scene, wide_device(), without_groups());
            const std::uint64_t colours = plan.colour_counts().at("distance");
            CHECK(colours == 8);
            CHECK(plan.passes.size() == substeps * (1 + iterations * colours + 1));
            std::uint64_t sum = 0;
            for (const EffectCost& effect : plan.effects)
                sum += effect.dispatches_per_step;
            CHECK(sum == plan.passes.size());
        }
}

TEST_CASE("what an effect costs is the sum of what its kernels do")
{
    Scene implicit = test::everything();
    implicit.method.type = MethodKind::implicit_euler; // its solves are recorded, not dispatched one by one
    for (const Scene& scene : {test::everything(), implicit})
    {
        const Plan plan = make_plan(scene);
        for (const EffectCost& effect : plan.effects)
        {
            CAPTURE(effect.name);
            std::uint64_t dispatches = 0, bytes = 0;
            for (const KernelCost& kernel : effect.kernels)
            {
                const auto own =
                    std::count_if(plan.passes.begin(), plan.passes.end(), [&](const Dispatch& pass) {
                        return pass.label == effect.name && full_name(*pass.kernel) == kernel.name;
                    });
                CHECK(own == static_cast<long>(kernel.dispatches_per_step));
                CHECK(kernel.bytes_per_step > 0);
                dispatches += kernel.dispatches_per_step;
                bytes += kernel.bytes_per_step;
            }
            CHECK(dispatches == effect.dispatches_per_step);
            CHECK(bytes == effect.bytes_per_step);
        }
    }
}

TEST_CASE("no barrier is missing, and one taken away is found")
{
    const Plan plan = make_plan(test::everything());
    CHECK(find_hazards(plan.passes, plan.barrier_before).empty());
    std::vector<bool> without = plan.barrier_before;
    const auto barrier =
        std::find(without.begin() + static_cast<long>(without.size() / 2), without.end(), true);
    REQUIRE(barrier != without.end());
    *barrier = false;
    CHECK_FALSE(find_hazards(plan.passes, without).empty());
}

TEST_CASE("a plan in which further effects exist equals one in which they do not (G08)")
{
    PlanOptions only;
    only.available_effects = {"motion", "distance"};
    const Plan a = make_plan(test::hanging()), b = make_plan(test::hanging(), {}, only);
    REQUIRE(a.passes.size() == b.passes.size());
    for (std::size_t i = 0; i < a.passes.size(); ++i)
        REQUIRE(same_pass(a.passes[i], b.passes[i]));
    CHECK(a.barrier_before == b.barrier_before);
    CHECK(a.bytes_allocated() == b.bytes_allocated());
}

TEST_CASE("a body whose vertices are all held has no constraint to solve (A13)")
{
    Scene scene = test::hanging(2);
    for (std::uint32_t v = 0; v < 9; ++v)
        scene.bodies[0].pins[0].vertices.push_back(v);
    scene.bodies[0].start_positions = scene.bodies[0].mesh.positions;
    scene.bodies[0].start_positions[0].x -= 0.5;
    const Plan plan = make_plan(scene);
    CHECK(plan.constraints.empty());
    REQUIRE(plan.warnings.size() == 1);
    CHECK(plan.warnings[0].word == "conflict");
}

TEST_CASE("pins that have their vertices elsewhere at time 0 are a conflict, with how far")
{
    Scene scene = test::hanging(2);
    scene.bodies[0].pins[0].motion = {{0, {0.25, 0, 0}}, {1, {0, 0, 0}}};
    const Plan plan = make_plan(scene);
    REQUIRE(plan.warnings.size() == 1);
    CHECK(plan.warnings[0].word == "conflict");
    CHECK(plan.warnings[0].count == scene.bodies[0].pins[0].vertices.size());
    CHECK_THAT(plan.warnings[0].text, Contains("0.25 m"));
    scene.bodies[0].pins[0].motion[0].translate = {0, 0, 0};
    CHECK(make_plan(scene).warnings.empty());
}

TEST_CASE("a scene that asks for more substeps than there may be is told, with the step that would do")
{
    Scene scene = test::hanging(16);
    scene.method.substeps = 0;
    scene.method.type = MethodKind::vbd;
    scene.bodies[0].material.stretch_stiffness = 1e8;
    const auto warned = [](const Scene& s) {
        const Plan plan = make_plan(s);
        return std::any_of(plan.warnings.begin(), plan.warnings.end(), [](const PlanWarning& w) {
            return w.word == "few_substeps" && w.text.find("implicit_euler") != std::string::npos;
        });
    };
    CHECK(wanted_substeps(scene) > kMostSubsteps);
    CHECK(automatic_substeps(scene) == kMostSubsteps);
    CHECK(warned(scene));
    scene.timestep *= 0.9 * kMostSubsteps / wanted_substeps(scene);
    CHECK_FALSE(warned(scene));
    scene.timestep = 1.0 / 60;
    scene.method.substeps = 20; // what a scene names is its own affair; load_residual judges it
    CHECK_FALSE(warned(scene));
    scene.method.substeps = kMostSubsteps;
    scene.bodies[0].material.stretch_stiffness = 1e3;
    CHECK_FALSE(warned(scene));
}

TEST_CASE("constraint enforcement and ACAD take no integrator but their own")
{
    Scene scene = test::hanging(2);
    for (const std::string method : {"implicit_constraints", "acad"})
        for (const std::string integrator : {"explicit", "verlet"})
        {
            scene.method.type = option_named<MethodKind>(method);
            scene.method.substeps = 100;
            scene.method.integrator = option_named<Integrator>(integrator);
            CAPTURE(method, integrator);
            CHECK_THROWS_WITH(make_plan(scene), Contains("\"semi_implicit\" only"));
            scene.method.integrator = Integrator::semi_implicit;
            CHECK_NOTHROW(make_plan(scene));
        }
}

TEST_CASE("a star of 10,000 springs is a hub and not 10,000 dispatches (C03)")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 10000;
    body.material.stretch_stiffness = 0;
    for (std::uint32_t v = 1; v <= 10000; ++v)
        body.springs.push_back({0, v, 1.0, 0.0});
    scene.bodies = {body};
    scene.method.substeps = 1;
    const Plan plan = make_plan(resolve(scene));
    CHECK(plan.passes.size() == 3);
    CHECK(plan.passes[1].kernel->name == "xpbd_hub_spring");
    CHECK(plan.constraint_counts().at("distance") == 10000);
}

TEST_CASE("a doubled spring at a hub is not solved twice at once")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 200;
    body.material.stretch_stiffness = 0;
    for (std::uint32_t v = 1; v <= 200; ++v)
        body.springs.push_back({0, v, 1.0, 0.0});
    body.springs.push_back({7, 0, 1.0, 0.0});
    scene.bodies = {body};
    scene.method.substeps = 1;
    const Plan plan = make_plan(resolve(scene));
    CHECK(std::count_if(plan.passes.begin(), plan.passes.end(),
                        [](const Dispatch& d) { return d.kernel->name == "xpbd_hub_spring"; }) == 2);
}

TEST_CASE("many small bodies share one dispatch a sweep when the device's costs say so")
{
    Scene scene = test::hanging(3);
    scene.bodies.resize(50, scene.bodies[0]);
    scene.method.substeps = 1;
    DeviceTraits costly;
    costly.dispatch_ns = 5000;
    costly.group_barrier_ns = 50;
    costly.element_ns = 0.1;
    costly.lane_element_ns = 10;
    CHECK(make_plan(scene, costly).passes.size() == 3);
    CHECK(make_plan(scene, wide_device()).passes.size() == 2 + 8);
    PlanOptions always;
    always.small_bodies = PlanOptions::SmallBodies::always;
    CHECK(make_plan(scene, wide_device(), always).passes.size() == 3);
}

TEST_CASE("limits and wrong settings are refused in words")
{
    Scene scene = test::hanging();
    const auto code_of = [](const Scene& s, const DeviceTraits& traits) {
        try
        {
            make_plan(s, traits);
        }
        catch (const Error& error)
        {
            return std::string(to_string(error.code()));
        }
        return std::string("none");
    };
    DeviceTraits tiny;
    tiny.max_buffer_bytes = 100;
    CHECK(code_of(scene, tiny) == "limit");
    DeviceTraits single;
    single.float64 = false;
    scene.method.precision = Precision::float64;
    CHECK(code_of(scene, single) == "unsupported");
    scene.method.precision = Precision::float32;
    scene.method.type = static_cast<MethodKind>(7);
    CHECK(code_of(scene, {}) == "unsupported");
    scene.method.type = MethodKind::xpbd;
    for (const double h : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e30})
    {
        scene.timestep = h;
        CHECK(code_of(scene, {}) == "bad_timestep");
    }
}

TEST_CASE("constraints stay within their body and colours of bodies are merged")
{
    Scene one = test::hanging(4), two = one;
    two.bodies.push_back(one.bodies[0]);
    const Plan a = make_plan(one, wide_device(), without_groups()),
               b = make_plan(two, wide_device(), without_groups());
    CHECK(b.passes.size() == a.passes.size());
    CHECK(b.constraint_counts().at("distance") == 2 * a.constraint_counts().at("distance"));
}

TEST_CASE("a time step that is refused is shown as it is, however small")
{
    try
    {
        check_timestep(1e-20, 1);
        FAIL("1e-20 s was taken");
    }
    catch (const Error& error)
    {
        CHECK(error.code() == ErrorCode::bad_timestep);
        CHECK(std::string(error.what()).find("1e-20 s") != std::string::npos);
    }
}
