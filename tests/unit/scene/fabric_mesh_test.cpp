// When `taut check` says that a mesh, or a precision, cannot carry a fabric.

#include "support/catch.hpp"

#include "taut/scene/fabric_mesh.hpp"

using namespace taut;

namespace {

/// 0.2 kg/m^2 that bends over (B / (0.2 * 9.81))^(1/3): 1.962e-3 N m are 10 cm.
Scene woven(std::uint32_t cells, double rigidity, double modulus = 1000)
{
    Scene scene;
    Body body;
    body.shape.cells = {cells, cells};
    body.material.stretch_stiffness = 0;
    body.material.density = 0.2;
    Fabric& fabric = body.material.fabric;
    fabric.used = true;
    fabric.warp = fabric.weft = modulus;
    fabric.shear = modulus / 20;
    fabric.bending.used = rigidity > 0;
    fabric.bending.warp = rigidity;
    fabric.bending.weft = 8 * rigidity;
    scene.bodies = {body};
    return resolve(scene);
}

} // namespace

TEST_CASE("a fabric whose bending length has fewer than three edges is warned of, and no other")
{
    // Of a square with its diagonals alternating the mean edge is (2 + sqrt 2) / 3 cells.
    CHECK(fabric_mesh_issues(woven(36, 1.962e-3)).empty());
    const std::vector<SceneIssue> coarse = fabric_mesh_issues(woven(32, 1.962e-3));
    REQUIRE(coarse.size() == 1);
    CHECK_FALSE(coarse[0].error);
    CHECK(coarse[0].field == "bodies[0].grid.cells");
    CHECK_THAT(coarse[0].text, Contains("35.6 mm") && Contains("100 mm"));
    CHECK(fabric_mesh_issues(woven(4, 0)).empty()); // asked for no bending
    Scene weightless = woven(4, 1.962e-3);
    weightless.gravity = glm::dvec3(0);
    CHECK(fabric_mesh_issues(weightless).empty());
}

TEST_CASE("a fabric whose strain by its weight has no digit is warned of, by the scene's precision")
{
    CHECK(fabric_mesh_issues(woven(4, 0, 1e7)).empty()); // 2.8e-7
    Scene stiff = woven(4, 0, 1e9);
    REQUIRE(fabric_mesh_issues(stiff).size() == 1);
    CHECK(fabric_mesh_issues(stiff)[0].field == "bodies[0].material.fabric");
    CHECK_THAT(fabric_mesh_issues(stiff)[0].text, Contains("1e+09 N/m") && Contains("\"float\""));
    stiff.method.precision = Precision::float64;
    CHECK(fabric_mesh_issues(stiff).empty());
    Scene stiffer = woven(4, 0, 1e18);
    stiffer.method.precision = Precision::float64;
    CHECK(fabric_mesh_issues(stiffer).size() == 1);
}
