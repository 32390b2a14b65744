// Contact of meshes with flaws, and of what touches exactly (examples/contact, 48): each is clean, or named.

#include "support/catch.hpp"
#include "support/judged_run.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <string>

using namespace taut;

namespace {

constexpr double kGap = 0.004;

/// kg, of cloth of any shape.
double cloth_mass(const Body& body)
{
    double area = 0;
    const auto& x = body.mesh.positions;
    for (const auto& t : body.mesh.triangles)
        area += 0.5 * glm::length(glm::cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]));
    return body.material.density * area;
}

/// The sheet lies on the other body, a plate at y = 0.
void check_lies(const JudgedRun& run, std::size_t sheet = 1)
{
    for (const glm::dvec3& x : run.body(sheet))
        CHECK(x.y == Approx(kGap).epsilon(0.02));
    const auto forces = run.world.contact_forces();
    const BodyContactForce* carried = force_between(forces, 0, 1);
    REQUIRE(carried);
    const double up = sheet == 1 ? -1 : 1;
    CHECK(up * carried->force.y == Approx(9.81 * cloth_mass(run.world.scene().bodies[sheet])).epsilon(0.01));
    CHECK(run.world.events().degenerate == 0);
    CHECK(run.world.events().non_finite == 0);
}

Scene flawed(double height, ContactStart start = ContactStart::ignore)
{
    Scene scene = suite("48_flawed");
    scene.bodies[1].transform.translate.y = height;
    scene.contact.start = start;
    return scene;
}

/// A sheet of 9 by 9 vertices, some of which start where others are.
Scene gathered(const std::string& which)
{
    Scene scene = resolve(suite("04_sheet_on_plate"));
    std::vector<glm::dvec3>& x = scene.bodies[1].start_positions;
    x = scene.bodies[1].mesh.positions;
    if (which == "a vertex on another")
        x[40] = x[41];
    else if (which == "two vertices on an edge")
        x[40] = x[49] = 0.5 * (x[41] + x[42]);
    else // a row on the next
        std::copy_n(x.begin() + 9, 9, x.begin());
    return scene;
}

} // namespace

TEST_CASE("suite 48: flaws of meshes are named, and what is left of them lies clean")
{
    std::vector<SceneIssue> found;
    resolve(suite("48_flawed"), &found);
    for (const char* what :
         {"2 triangles without area, dropped; the first is number 5", "1 vertices of no triangle",
          "1 triangles of the same corners as an earlier one"})
        for (const char* field : {"bodies[0].mesh", "bodies[1].mesh"})
            CHECK(std::any_of(found.begin(), found.end(), [&](const SceneIssue& issue) {
                return issue.field == field && issue.text.find(what) != std::string::npos;
            }));
    JudgedRun run(suite("48_flawed"));
    run.run(1);
    CHECK(run.crossed == 0);
    check_lies(run);
}

TEST_CASE("suite 48: a sheet that all but touches a plate keeps its side, and one that does is named")
{
    JudgedRun above(flawed(1e-9)), below(flawed(-1e-9)), at(flawed(kGap));
    for (JudgedRun* run : {&above, &at})
    {
        run->run(1);
        CHECK(run->crossed == 0);
        check_lies(*run);
    }
    below.run(0.5);
    CHECK(below.crossed == 0);
    CHECK(highest(below.body(1)) < -0.5);
    CHECK_THROWS_WITH(World(flawed(0, ContactStart::refuse), test_device("cpu:serial")),
                      Contains("go through each other at the start") && Contains("(\"plate\")"));
}

TEST_CASE("suite 48: a sheet that touches a plate exactly comes to lie on it, whichever is the first")
{
    const bool sheet_first = GENERATE(false, true);
    const bool turned = GENERATE(false, true); // triangles that face down
    const double rounding = GENERATE(0.0, 3e-17, -3e-17);
    CAPTURE(sheet_first, turned, rounding);
    Scene scene = resolve(flawed(rounding));
    if (turned)
        for (auto& t : scene.bodies[0].mesh.triangles)
            std::swap(t[1], t[2]);
    if (sheet_first)
        std::swap(scene.bodies[0], scene.bodies[1]);
    JudgedRun touching(scene);
    touching.run(1);
    CHECK(touching.crossed <= 1); // the way from where they touch
    CHECK(touching.intersected == 0);
    check_lies(touching, sheet_first ? 0 : 1);
}

TEST_CASE("suite 48: a sheet whose vertices start in one place is named, comes apart and lies clean")
{
    const std::string which = GENERATE("a vertex on another", "two vertices on an edge", "a row on the next");
    CAPTURE(which);
    Scene scene = gathered(which);
    scene.contact.start = ContactStart::refuse;
    CHECK_THROWS_WITH(World(scene, test_device("cpu:serial")), Contains("(\"sheet\")"));
    scene.contact.start = ContactStart::ignore;
    JudgedRun run(scene);
    run.run(0.1);
    const std::size_t early = run.crossed;
    run.run(1);
    CHECK(run.crossed == early);
    CHECK(run.verdict.intersecting == 0);
    check_lies(run);
}

TEST_CASE("suite 48: a plate of a program that has a triangle twice, and one without area, is as without")
{
    Scene scene = resolve(suite("04_sheet_on_plate"));
    auto& triangles = scene.bodies[0].mesh.triangles;
    triangles.push_back(triangles[80]);
    triangles.push_back({0, 1, 2}); // of one row
    triangles.push_back({0, 1, 1});
    JudgedRun run(scene);
    run.run(1);
    CHECK(run.crossed == 0);
    check_lies(run);
}
