// The iterations that a scene takes that names none.

#include "support/catch.hpp"
#include "support/scenes.hpp"

using namespace taut;

namespace {

/// As many as `scene` takes under a method, with 10 substeps of 1/600 s.
std::uint32_t taken(Scene scene, MethodKind method)
{
    scene.method.type = method;
    scene.method.substeps = 10;
    scene.method.iterations = 0;
    return resolve(scene).method.iterations;
}

Scene sheet(double stiffness)
{
    Scene scene = test::hanging(8); // 1 m, 0.2 kg/m^2: waves of 1e3 N/m run 0.94 edges in a substep
    scene.bodies[0].material.stretch_stiffness = stiffness;
    return scene;
}

} // namespace

TEST_CASE("implicit Euler takes two Newton steps where waves in cloth and chains run over more than an edge")
{
    CHECK(taken(sheet(5e2), MethodKind::implicit_euler) == 1);
    CHECK(taken(sheet(4e3), MethodKind::implicit_euler) == 2);
    // By sqrt(k / m) edges in a second: 0.2 kg a vertex.
    CHECK(taken(test::chain(10, 1e3, 0.2), MethodKind::implicit_euler) == 1);
    CHECK(taken(test::chain(10, 1e6, 0.2), MethodKind::implicit_euler) == 2);
    for (const MethodKind method :
         {MethodKind::xpbd, MethodKind::vbd, MethodKind::pbd, MethodKind::mass_spring})
        CHECK(taken(sheet(1e5), method) == 1);
    Scene solid;
    Body& body = solid.bodies.emplace_back();
    body.shape.kind = ShapeKind::box;
    body.material = solid_material();
    body.material.youngs_modulus = 1e9;
    CHECK(taken(solid, MethodKind::implicit_euler) == 1);
}

TEST_CASE("iterations that are named are taken, and automatic is a word of a scene")
{
    Scene scene = sheet(1e5);
    scene.method.type = MethodKind::implicit_euler;
    scene.method.iterations = 1;
    CHECK(resolve(scene).method.iterations == 1);
    const auto read = [](const std::string& iterations) {
        return parse_scene(R"({"taut": 1, "method": {"type": "implicit_euler", "iterations": )" + iterations +
                           R"(}, "bodies": [{"grid": {"cells": [8, 8], "size": [1, 1]},
                                   "material": {"density": 0.2, "stretch_stiffness": 1e5}}]})");
    };
    CHECK(resolve(read("\"automatic\"")).method.iterations == 2);
    CHECK(resolve(read("3")).method.iterations == 3);
    CHECK_THROWS_WITH(read("0"), Contains("method.iterations"));
}
