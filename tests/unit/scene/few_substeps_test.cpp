// Named substeps that are too few for the solids of a scene.

#include "taut/scene/few_substeps.hpp"

#include "support/catch.hpp"
#include "support/scenes.hpp"
#include "taut/scene/mesh_issues.hpp"

using namespace taut;

namespace {

/// A cube of rubber of 4 cm, 4^3 cells, on a floor: under xpbd automatic takes 17.
Scene cube_on_floor()
{
    Scene scene;
    Body& body = scene.bodies.emplace_back();
    body.shape.kind = ShapeKind::box;
    body.shape.box_size = glm::dvec3(0.04);
    body.material = solid_material();
    body.material.density = 1100;
    body.material.youngs_modulus = 1e6;
    body.transform.translate = {0, 0.02, 0};
    Collider floor;
    floor.kind = ColliderKind::plane;
    scene.colliders = {floor};
    return scene;
}

std::vector<SceneIssue> warned(Scene scene, MethodKind method, std::uint32_t substeps)
{
    scene.method.type = method;
    scene.method.substeps = substeps;
    return few_substeps_issues(resolve(scene));
}

} // namespace

TEST_CASE("named substeps that are too few for a solid are warned of", "[substeps]")
{
    const Scene scene = cube_on_floor();
    for (const MethodKind method : {MethodKind::xpbd, MethodKind::implicit_euler})
    {
        CHECK(warned(scene, method, 1).size() == 1);
        CHECK(warned(scene, method, 3).size() == 1); // `diverged`, docs/methods.md
        CHECK(warned(scene, method, 5).empty());
        CHECK(warned(scene, method, 0).empty()); // automatic
        Scene stiff = scene; // takes more, so that the floor presses no energy into it
        stiff.bodies[0].material.youngs_modulus = 1e8;
        CHECK(warned(stiff, method, 5).size() == 1);
    }
    const SceneIssue issue = warned(scene, MethodKind::xpbd, 3).at(0);
    CHECK_FALSE(issue.error);
    CHECK(issue.field == "method.substeps");
    CHECK(issue.text.starts_with("is 3; for these solids automatic takes 17: "));
    CHECK(warned(scene, MethodKind::vbd, 1).empty()); // whose sweeps meet the floor
    CHECK(warned(scene, MethodKind::pbd, 1).empty());
}

TEST_CASE("named substeps are few for what is held or can meet something alone", "[substeps]")
{
    Scene scene = cube_on_floor();
    scene.colliders.clear();
    CHECK(warned(scene, MethodKind::xpbd, 1).empty());
    scene.contact.between = true;
    CHECK(warned(scene, MethodKind::xpbd, 1).size() == 1);
    scene.contact.between = false;
    scene.bodies[0].pins.emplace_back().faces = {"top"};
    CHECK(warned(scene, MethodKind::xpbd, 1).size() == 1);
    CHECK(warned(scene, MethodKind::implicit_euler, 1).empty()); // of which only what stands asks for more
    Scene cloth = test::hanging(32);
    cloth.colliders = {Collider{}};
    CHECK(warned(cloth, MethodKind::xpbd, 1).empty());
}

TEST_CASE("the warning of few substeps is among those of meshes, and names no more than there may be",
          "[substeps]")
{
    Scene scene = cube_on_floor();
    scene.method.substeps = 1;
    const std::vector<SceneIssue> all = mesh_issues(resolve(scene));
    CHECK(std::ranges::any_of(all, [](const SceneIssue& i) { return i.field == "method.substeps"; }));
    scene.timestep = 1;
    scene.bodies[0].material.youngs_modulus = 1e9;
    scene.bodies[0].shape.box_size = glm::dvec3(0.001);
    CHECK(warned(scene, MethodKind::xpbd, 999).empty());
    CHECK(warned(scene, MethodKind::xpbd, 200).at(0).text.find("takes 1000:") != std::string::npos);
}
