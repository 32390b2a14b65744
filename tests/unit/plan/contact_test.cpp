// What contact adds to a plan, what it refuses, and the tree that it searches.

#include "support/catch.hpp"
#include "support/methods.hpp"
#include "support/scenes.hpp"

#include "taut/kernels/shared/contact_rows.h"
#include "taut/plan/contact_scene.hpp"
#include "taut/plan/contact_tree.hpp"
#include "taut/plan/plan.hpp"
#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <functional>
#include <set>

using namespace taut;

namespace {

const EffectCost* find_effect(const Plan& plan, std::string_view name)
{
    for (const EffectCost& effect : plan.effects)
        if (effect.name == name)
            return &effect;
    return nullptr;
}

Scene two(std::uint32_t cells = 6)
{
    Scene scene = test::hanging(cells);
    scene.method.substeps = 6;
    scene.method.iterations = 2;
    scene.bodies.push_back(scene.bodies[0]);
    for (glm::dvec3& x : scene.bodies[1].mesh.positions)
        x.z += 0.5;
    return scene;
}

bool same_passes(const Plan& a, const Plan& b)
{
    return std::equal(a.passes.begin(), a.passes.end(), b.passes.begin(), b.passes.end(),
                      [](const Dispatch& p, const Dispatch& q) {
                          return p.kernel == q.kernel && p.params == q.params && p.count == q.count;
                      }) &&
           a.barrier_before == b.barrier_before && a.bytes_allocated() == b.bytes_allocated();
}

} // namespace

TEST_CASE("contact that nothing can have adds nothing to a plan, under any method", "[contact]")
{
    for (const std::string& method : test::methods())
    {
        CAPTURE(method);
        Scene scene = test::under(test::hanging(4), method);
        const Plan plain = make_plan(scene);
        scene.contact.between = true; // one body alone
        scene.contact.friction = 1;
        scene.contact.thickness = 0.01;
        scene.contact.searches = scene.contact.sweeps = 9;
        CHECK(same_passes(plain, make_plan(scene)));
    }
    Scene both = two();
    const Plan apart = make_plan(both);
    both.bodies[0].contact.friction = 0.5;
    CHECK(same_passes(apart, make_plan(both)));
    CHECK(find_effect(apart, "contact") == nullptr);
    Scene chains = test::chain(4, 100, 0.1); // no surface
    const Plan links = make_plan(chains);
    chains.bodies[0].contact.self = true;
    CHECK(same_passes(links, make_plan(chains)));
}

TEST_CASE("contact adds a search that may be made and sweeps, and leaves all other passes as they were",
          "[contact]")
{
    Scene scene = two();
    const Plan before = make_plan(scene);
    scene.contact.between = true;
    scene.contact.searches = GENERATE(1u, 3u, 100u);
    scene.contact.sweeps = GENERATE(1u, 2u);
    const Plan after = make_plan(scene);
    const EffectCost* cost = find_effect(after, "contact");
    REQUIRE(cost != nullptr);
    // 144 triangles: 256 leaves, which 64 lanes refit in a pass, and 4 nodes above them in another.
    const std::uint64_t looks = 2, refits = 2, lists = 10,
                        substeps = 6; // in each of which it looks whether to
    CHECK(cost->dispatches_per_step ==
          substeps * (looks + refits + lists) + substeps * 2 * 3 * scene.contact.sweeps);
    std::size_t k = 0;
    for (const Dispatch& pass : after.passes)
        if (pass.label != "contact" && pass.kernel->name != "coast")
        {
            REQUIRE(k < before.passes.size());
            CHECK(pass.kernel->name == before.passes[k++].kernel->name);
        }
    CHECK(k == before.passes.size());
    CHECK(after.contact.triangles == 144);
}

TEST_CASE("bodies that meet nothing are in no list, by their groups", "[contact]")
{
    Scene scene = two();
    const Plan apart = make_plan(scene);
    scene.contact.between = true;
    scene.bodies[1].contact.group = "ghost";
    scene.bodies[0].contact.passes = {"ghost"};
    CHECK(same_passes(apart, make_plan(scene))); // either side may say it
    std::swap(scene.bodies[0].contact.passes, scene.bodies[1].contact.passes);
    scene.bodies[1].contact.passes = {"default"};
    CHECK(same_passes(apart, make_plan(scene)));
    scene.bodies[1].contact.passes = {"ghost"}; // its own group: no other one is in it
    CHECK(make_plan(scene).contact.triangles == 144);
    scene.bodies.push_back(scene.bodies[1]);
    for (glm::dvec3& x : scene.bodies[2].mesh.positions)
        x.z += 0.5;
    CHECK(make_plan(scene).contact.triangles == 216);
    scene.bodies[0].contact.passes = {"ghost"}; // and now no two meet
    CHECK(same_passes(make_plan(scene), [&] {
        Scene without = scene;
        without.contact.between = false;
        return make_plan(without);
    }()));
    scene.bodies[2].contact.self = true; // but one itself
    CHECK(make_plan(scene).contact.triangles == 72);
    CHECK(surfaces_meet(scene, 2, 2));
    CHECK(!surfaces_meet(scene, 1, 2));
}

TEST_CASE("a surface too thin to meet others is refused by name", "[contact]")
{
    const auto refusal = [](const Scene& scene) -> std::string {
        try
        {
            make_plan(scene);
        }
        catch (const Error& error)
        {
            return std::string(to_string(error.code())) + ": " + error.what();
        }
        return "";
    };
    Scene thin = test::hanging(4);
    thin.bodies[0].contact.self = true;
    thin.bodies[0].contact.thickness = 1e-6;
    CHECK_THAT(refusal(thin),
               Contains("bodies[0].contact.thickness is 1e-06 m") && Contains("needs at least"));
    thin.bodies[0].contact.thickness = 0;
    CHECK_THAT(refusal(thin), Contains("a radius above 0"));
}

TEST_CASE("the tree holds every triangle once, each half about one place, and shares vertices and sides out",
          "[contact]")
{
    const std::uint32_t cells = GENERATE(1u, 3u, 8u);
    const Scene scene = test::hanging(cells);
    const Mesh& mesh = scene.bodies[0].mesh;
    std::vector<ContactLeaf> leaves;
    for (const auto& t : mesh.triangles)
        leaves.push_back({t, 0, 0});
    leaves = in_tree_order(leaves, mesh.positions);
    share_out(leaves);
    std::multiset<std::array<std::uint32_t, 3>> all(mesh.triangles.begin(), mesh.triangles.end()), found;
    std::size_t vertices = 0, sides = 0;
    for (const ContactLeaf& leaf : leaves)
    {
        found.insert(leaf.corner);
        for (std::uint32_t k = 0; k < 3; ++k)
        {
            vertices += leaf.owns >> k & 1;
            sides += leaf.owns >> (TAUT_CONTACT_OWNS_SIDE + k) & 1;
        }
    }
    CHECK(found == all);
    CHECK(vertices == mesh.positions.size());
    CHECK(sides == mesh.positions.size() + mesh.triangles.size() - 1); // Euler
    CHECK(leaves_for(static_cast<std::uint32_t>(leaves.size())) >= leaves.size());
    if (cells == 8) // 128 triangles: the halves of the tree are halves of the square
    {
        double apart = 0;
        for (std::size_t k = 0; k < 128; ++k)
            for (const std::uint32_t v : leaves[k].corner)
                apart += (k < 64 ? -1 : 1) * mesh.positions[v].x;
        CHECK(std::abs(apart) / 192 > 0.4);
    }
}

TEST_CASE(
    "the guarantee is the last to write ways in every substep, and adds nothing where it is not asked for",
    "[contact]")
{
    Scene scene = two();
    scene.contact.between = true;
    const Plan plain = make_plan(scene);
    CHECK(find_effect(plain, "guarantee") == nullptr);
    scene.contact.guarantee = Guarantee::no_crossing;
    const Plan guarded = make_plan(scene);
    REQUIRE(find_effect(guarded, "guarantee") != nullptr);
    CHECK(!plain.contact.guarded);
    CHECK(guarded.contact.guarded);
    std::uint32_t ends = 0, filters = 0;
    for (std::size_t k = 0; k < guarded.passes.size(); ++k)
    {
        const std::string_view kernel = guarded.passes[k].kernel->name;
        filters += kernel == "guarantee_filter" ? 1 : 0;
        if (kernel != "finish")
            continue;
        ++ends;
        CHECK(guarded.passes[k - 1].kernel->name == "guarantee_filter");
    }
    CHECK(ends == guarded.substeps);
    CHECK(filters == ends);
}

TEST_CASE("under every method the guarantee writes last", "[contact]")
{
    const std::string method =
        GENERATE(from_range(std::vector<std::string>(kWords<MethodKind>.begin(), kWords<MethodKind>.end())));
    CAPTURE(method);
    Scene scene = test::under(two(), method);
    scene.contact.between = true;
    scene.contact.guarantee = Guarantee::no_crossing;
    const Plan plan = make_plan(scene);
    std::uint32_t ends = 0;
    for (std::size_t k = 1; k < plan.passes.size(); ++k)
        if (plan.passes[k].kernel->name == "finish")
        {
            ++ends;
            CHECK(plan.passes[k - 1].kernel->name == "guarantee_filter");
        }
    CHECK(ends == plan.substeps);
}
