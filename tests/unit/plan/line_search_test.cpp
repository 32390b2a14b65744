#include "support/catch.hpp"
#include "support/scenes.hpp"

#include "taut/plan/implicit_euler.hpp"
#include "taut/plan/plan.hpp"

using namespace taut;

namespace {

Scene cube()
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {1, 1, 1};
    body.material.stretch_stiffness = 0;
    body.material.model = SolidModel::neo_hookean;
    body.material.youngs_modulus = 1e6;
    body.material.density = 1000;
    scene.bodies = {body};
    scene.method.type = MethodKind::implicit_euler;
    scene.method.substeps = 1;
    return resolve(scene);
}

std::size_t passes(Scene scene, std::uint32_t halvings)
{
    scene.method.line_search = halvings;
    return make_plan(scene).passes.size();
}

} // namespace

TEST_CASE("a line search that nobody named is long where a body has tetrahedra")
{
    CHECK(line_search_of(cube()) == 16);
    CHECK(line_search_of(test::hanging(2)) == 2);
    Scene both = cube();
    both.bodies.insert(both.bodies.begin(), test::hanging(2).bodies[0]);
    CHECK(line_search_of(both) == 16);
    for (const std::uint32_t named : {0u, 3u, 16u})
    {
        both.method.line_search = named;
        CHECK(line_search_of(both) == named);
    }
    both.method.line_search = 17;
    CHECK_THROWS_WITH(resolve(both), Contains("line_search"));
}

TEST_CASE("trials of a line search take up to three passes of inertia and of each kind of element")
{
    const std::size_t none = passes(cube(), 0), kinds = 2; // inertia, tetrahedra
    CHECK(passes(cube(), 1) == none + 2 * kinds);
    CHECK(passes(cube(), 2) == none + 2 * kinds);
    CHECK(passes(cube(), 3) == none + 3 * kinds);
    CHECK(passes(cube(), 16) == none + 3 * kinds);
    CHECK(make_plan(cube()).passes.size() == passes(cube(), 16));
}
