// Position-based dynamics and coloured networks in the plan: passes, colours, refusals.

#include "graphs.hpp"
#include "support/scenes.hpp"

#include "taut/plan/constraints.hpp"
#include "taut/plan/pbd.hpp"
#include "taut/runtime/base/error.hpp"

using namespace taut;

namespace {

/// Costs under which no two colours are worth merging.
DeviceTraits wide_device()
{
    DeviceTraits traits;
    traits.dispatch_ns = 1;
    traits.group_barrier_ns = 1000;
    return traits;
}

Plan wide_plan(const Scene& scene)
{
    PlanOptions options;
    options.small_bodies = PlanOptions::SmallBodies::never;
    return make_plan(scene, wide_device(), options);
}

Scene pbd(std::uint32_t n, const char* scheme, std::uint32_t substeps, std::uint32_t iterations, bool bending)
{
    Scene scene = test::hanging(n);
    scene.bodies[0].material.bending_stiffness = bending ? 1e-4 : 0;
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = option_named<ElementScheme>(scheme);
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return scene;
}

/// Cloth of a network of springs of all three kinds.
Scene network(std::uint32_t columns, std::uint32_t rows, const char* type = "xpbd")
{
    Scene scene;
    Body body;
    body.shape.cells = {columns, rows};
    body.shape.network = {true, 1000, 500, 100};
    scene.bodies = {body};
    scene.method.type = option_named<MethodKind>(type);
    return resolve(scene);
}

std::string refusal(const Scene& scene, std::string* text)
{
    try
    {
        make_plan(scene);
    }
    catch (const Error& error)
    {
        *text = error.what();
        return std::string(to_string(error.code()));
    }
    return "nothing";
}

} // namespace

TEST_CASE("the springs of a network have 12 colours by direction and parity, all valid", "[pbd]")
{
    for (const std::uint32_t columns : {1u, 2u, 3u, 16u, 65u})
        for (const std::uint32_t rows : {1u, 2u, 3u, 17u})
        {
            CAPTURE(columns, rows);
            const Scene scene = network(columns, rows);
            const Plan plan = wide_plan(scene);
            if (columns > 3 && rows > 3) // two springs of a direction in a row
                CHECK(plan.colour_counts().at("distance") == 12);
            ConstraintGraph graph{plan.vertex_count, 2, {}, {}};
            std::vector<std::array<std::uint32_t, 2>> edges;
            for (const Body::Spring& s : scene.bodies[0].springs)
            {
                edges.push_back({std::min(s.a, s.b), std::max(s.a, s.b)});
                graph.vertices.push_back(edges.back()[0]);
                graph.vertices.push_back(edges.back()[1]);
            }
            std::string why;
            const Colouring colouring = grid_edge_colouring(edges, columns + 1);
            CHECK(valid(colouring, graph, &why));
            CHECK(why.empty());
            CHECK(colouring.order.size() == edges.size());
            CHECK(colouring.colour_count() <= 12);
        }
}

TEST_CASE("kinds of a network that are not there need no colours; springs of the scene's own go by greed",
          "[pbd]")
{
    Scene scene = network(16, 16);
    const auto colours = [&](double structural, double shear, double bend) {
        Scene own;
        Body body;
        body.shape.cells = {16, 16};
        body.shape.network = {true, structural, shear, bend};
        own.bodies = {body};
        return wide_plan(resolve(own)).colour_counts().at("distance");
    };
    CHECK(colours(1, 0, 0) == 4);
    CHECK(colours(1, 1, 0) == 8);
    CHECK(colours(0, 0, 1) == 4);
    CHECK(colours(1, 0, 1) == 8);
    scene.bodies[0].springs.push_back({0, 100, 0.5, 1e-3});
    CHECK(wide_plan(scene).constraint_counts().at("distance") == scene.bodies[0].springs.size());
}

TEST_CASE("coloured PBD has substeps (2 + iterations colours) passes and keeps no multipliers", "[pbd]")
{
    for (const std::uint32_t substeps : {1u, 3u})
        for (const std::uint32_t iterations : {1u, 4u})
        {
            const Plan plan = wide_plan(pbd(16, "automatic", substeps, iterations, true));
            const auto colours = plan.colour_counts();
            CHECK(colours.at("pbd_stretch") == 8);
            CHECK(plan.passes.size() ==
                  substeps * (2 + iterations * (colours.at("pbd_stretch") + colours.at("pbd_bend"))));
            for (const ConstraintSet& set : plan.constraints)
                CHECK(set.multipliers == kNoBuffer);
            for (const PlanBuffer& buffer : plan.buffers)
                CHECK((buffer.effect == "motion" || buffer.effect == "pbd_stretch" ||
                       buffer.effect == "pbd_bend"));
        }
}

TEST_CASE("Jacobi has one pass an iteration at vertices, or one a kind of constraint and one to average",
          "[pbd]")
{
    for (const bool bending : {false, true})
        for (const std::uint32_t iterations : {1u, 5u})
        {
            const Plan node = wide_plan(pbd(8, "node_centric", 3, iterations, bending));
            CHECK(node.passes.size() == 3 * (2 + iterations));
            const Plan slots = wide_plan(pbd(8, "constraint_centric", 3, iterations, bending));
            CHECK(slots.passes.size() == 3 * (2 + iterations * (bending ? 3 : 2)));
            CHECK(find_hazards(node.passes, node.barrier_before).empty());
            CHECK(find_hazards(slots.passes, slots.barrier_before).empty());
        }
}

TEST_CASE("PBD without stiffness has no pass and no buffer for constraints", "[pbd]")
{
    for (const char* scheme : {"coloured", "node_centric", "constraint_centric"})
    {
        Scene scene = pbd(8, scheme, 1, 4, true);
        scene.method.stretch = scene.method.bend = 0;
        const Plan plan = wide_plan(scene);
        CHECK(plan.passes.size() == 2);
        for (const PlanBuffer& buffer : plan.buffers)
            CHECK(buffer.effect == "motion");
        scene.method.bend = 1;
        CHECK(wide_plan(scene).passes.size() > 2);
    }
}

namespace {

/// A block of tetrahedra of springs and volumes.
Scene soft_block(const char* scheme, std::uint32_t substeps, std::uint32_t iterations, double bending = 0)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {3, 3, 3};
    body.material = solid_material();
    body.material.model = SolidModel::springs;
    body.material.bending_stiffness = bending;
    scene.bodies = {body};
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = option_named<ElementScheme>(scheme);
    scene.method.substeps = substeps;
    scene.method.iterations = iterations;
    return resolve(scene);
}

bool names_volume(const Plan& plan)
{
    const auto named = [](const std::string& text) {
        return text.find("volume") != std::string::npos || text.find("tetrahedra") != std::string::npos;
    };
    for (const EffectCost& effect : plan.effects)
        if (named(effect.name))
            return true;
    for (const PlanBuffer& buffer : plan.buffers)
        if (named(buffer.name) || named(buffer.effect))
            return true;
    return false;
}

constexpr std::uint64_t kMomentumPasses = 3; ///< of an iteration of a solid that nothing holds

} // namespace

TEST_CASE("coloured PBD of a solid has a pass a colour of its tetrahedra and iteration, each of them once",
          "[pbd]")
{
    const Scene scene = soft_block("coloured", 2, 3);
    const Plan plan = wide_plan(scene);
    const auto colours = plan.colour_counts();
    CHECK(plan.constraint_counts().at("pbd_volume") == scene.bodies[0].mesh.tetrahedra.size());
    const std::uint64_t each = kMomentumPasses + colours.at("pbd_stretch") + colours.at("pbd_volume");
    CHECK(plan.passes.size() == 2 * (2 + 3 * each));
    CHECK(find_hazards(plan.passes, plan.barrier_before).empty());
    for (const ConstraintSet& set : plan.constraints)
        CHECK(set.multipliers == kNoBuffer);
}

TEST_CASE("Jacobi of a solid has one pass an iteration, or one a kind of constraint and one to average",
          "[pbd]")
{
    for (const double bending : {0.0, 1e-4})
        for (const std::uint32_t iterations : {1u, 5u})
        {
            const Plan node = wide_plan(soft_block("node_centric", 3, iterations, bending));
            CHECK(node.passes.size() == 3 * (2 + iterations * (kMomentumPasses + 1)));
            const Plan slots = wide_plan(soft_block("constraint_centric", 3, iterations, bending));
            CHECK(slots.passes.size() == 3 * (2 + iterations * (kMomentumPasses + (bending > 0 ? 4 : 3))));
            CHECK(find_hazards(node.passes, node.barrier_before).empty());
            CHECK(find_hazards(slots.passes, slots.barrier_before).empty());
        }
}

TEST_CASE("PBD has nothing of volumes where none are held", "[pbd]")
{
    for (const char* scheme : {"coloured", "node_centric", "constraint_centric"})
    {
        CHECK_FALSE(names_volume(wide_plan(pbd(8, scheme, 1, 4, true)))); // cloth
        Scene scene = soft_block(scheme, 1, 4, 1e-4);
        CHECK(names_volume(wide_plan(scene)));
        scene.method.volume = 0;
        const Plan by_method = wide_plan(scene);
        CHECK_FALSE(names_volume(by_method));
        scene.method.volume = 1;
        scene.bodies[0].material.volume_stiffness = 0;
        const Plan by_material = wide_plan(scene);
        CHECK_FALSE(names_volume(by_material));
        CHECK(by_method.passes.size() == by_material.passes.size());
    }
}

TEST_CASE("volumes alone are solved without springs", "[pbd]")
{
    for (const char* scheme : {"coloured", "node_centric", "constraint_centric"})
    {
        Scene scene = soft_block(scheme, 1, 4);
        scene.method.stretch = 0;
        const Plan plan = wide_plan(scene);
        CHECK(names_volume(plan));
        CHECK(plan.passes.size() > 2);
        CHECK(plan.constraint_counts().count("pbd_stretch") == 0);
    }
}

TEST_CASE("the iterations of a step together make the stiffness, whatever their number", "[pbd]")
{
    for (const double k : {0.0, 0.01, 0.5, 0.99, 1.0})
        for (const std::uint32_t n : {1u, 2u, 7u, 100u})
            CHECK(1 - std::pow(1 - pbd_share(k, n), n) == Approx(k).margin(1e-12));
    CHECK(pbd_share(0.9375, 4) == Approx(0.5));
}

TEST_CASE("Chebyshev's weights begin after four plain iterations and grow to their limit", "[pbd]")
{
    for (std::uint32_t i = 0; i < 4; ++i)
        CHECK(chebyshev_weight(0.9, i) == 1);
    CHECK(chebyshev_weight(0.9, 4) == Approx(2 / (2 - 0.81)));
    CHECK(chebyshev_weight(0.9, 5) == Approx(4 / (4 - 0.81 * 2 / (2 - 0.81))));
    CHECK(chebyshev_weight(0.9, 200) == Approx(2 / (1 + std::sqrt(1 - 0.81))));
    CHECK(chebyshev_weight(0, 10) == 1);
}

TEST_CASE("what PBD cannot do is refused in words", "[pbd]")
{
    std::string text;
    Scene damped = pbd(4, "coloured", 1, 4, false);
    damped.bodies[0].material.stretch_damping = 0.01;
    CHECK(refusal(damped, &text) == "unsupported");
    CHECK(text.find("bodies[0].material.stretch_damping is 0.01") != std::string::npos);
    Scene coloured = pbd(4, "coloured", 1, 20, false);
    coloured.method.spectral_radius = 0.9;
    CHECK(refusal(coloured, &text) == "unsupported");
    CHECK(text.find("node_centric") != std::string::npos);
    Scene few = pbd(4, "node_centric", 1, 7, false);
    few.method.spectral_radius = 0.9;
    CHECK(refusal(few, &text) == "unsupported");
    CHECK(text.find("7 iterations") != std::string::npos);
    few.method.iterations = 8;
    CHECK(refusal(few, &text) == "nothing");
}

TEST_CASE("a star beyond the loop limit of an invocation is refused by Jacobi, not by colours", "[pbd]")
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::chain;
    body.shape.links = 40000;
    body.material.stretch_stiffness = 0;
    for (std::uint32_t v = 1; v <= 40000; ++v)
        body.springs.push_back({0, v, 1.0, 0.0});
    scene.bodies = {body};
    scene.method.type = MethodKind::pbd;
    scene.method.scheme = ElementScheme::node_centric;
    scene = resolve(scene);
    std::string text;
    CHECK(refusal(scene, &text) == "limit");
    CHECK(text.find("40000 springs") != std::string::npos);
}
