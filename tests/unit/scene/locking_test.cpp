// How many tetrahedra a solid is across, and when `taut check` says that it is too few.

#include "support/catch.hpp"

#include "taut/scene/locking.hpp"

#include <string>

using namespace taut;

namespace {

Scene box_of(std::uint32_t x, std::uint32_t y, std::uint32_t z, double poissons_ratio = 0.3)
{
    Scene scene;
    Body body;
    body.shape.kind = ShapeKind::box;
    body.shape.box_cells = {x, y, z};
    body.shape.box_size = {0.1 * x, 0.1 * y, 0.1 * z};
    body.material.youngs_modulus = 1e5;
    body.material.poissons_ratio = poissons_ratio;
    scene.bodies = {body};
    return resolve(scene);
}

} // namespace

TEST_CASE("a box is as many tetrahedra across as it has cells where it is thinnest")
{
    for (std::uint32_t cells = 1; cells <= 6; ++cells)
    {
        CAPTURE(cells);
        CHECK(tetrahedra_across(box_of(8, cells, 8).bodies[0].mesh) == cells);
        CHECK(tetrahedra_across(box_of(9, 7, cells).bodies[0].mesh) == cells);
    }
    CHECK(tetrahedra_across(Mesh{}) == 0);
}

TEST_CASE("solids that are few tetrahedra across, or hardly give way, are warned of, and no others")
{
    CHECK(locking_issues(box_of(8, 4, 4)).empty());
    const std::vector<SceneIssue> thin = locking_issues(box_of(8, 2, 8));
    REQUIRE(thin.size() == 1);
    CHECK(!thin[0].error);
    CHECK(thin[0].field == "bodies[0].box.cells");
    CHECK_THAT(thin[0].text, Contains("2 tetrahedra across") && Contains("at least 4"));
    const std::vector<SceneIssue> rubber = locking_issues(box_of(8, 5, 8, 0.49));
    REQUIRE(rubber.size() == 1);
    CHECK_THAT(rubber[0].text, Contains("0.49") && Contains("at least 8"));
    CHECK(locking_issues(box_of(8, 8, 8, 0.49)).empty());
    Scene springs = box_of(8, 4, 4);
    springs.bodies[0].material.model = SolidModel::springs;
    REQUIRE(locking_issues(springs).size() == 1);
    CHECK(locking_issues(springs)[0].field == "bodies[0].material.model");
    springs.bodies[0].kinematic.used = true; // does not bend
    CHECK(locking_issues(springs).empty());
}
