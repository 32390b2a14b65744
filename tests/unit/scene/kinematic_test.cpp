// Bodies that are led: what a scene file says, what becomes of it, and what it refuses.

#include "point_cache.hpp"
#include "support/catch.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"

using namespace taut;

namespace {

/// Two triangles: their second and fifth vertices are one place, the third is of no triangle.
std::string obj(double lift)
{
    const std::string y = " " + std::to_string(lift) + " ";
    return "v 0" + y + "0\nv 1" + y + "0\nv 9 9 9\nv 0" + y + "1\nv 1" + y + "0\nv 1" + y +
           "1\nf 1 2 4\nf 5 6 4\n";
}

Scene parsed(const std::string& body, const std::filesystem::path& directory = {})
{
    return parse_scene(R"({"taut": 1, "contact": {}, "bodies": [{)" + body + "}]}", directory);
}

std::string refusal(const std::string& body, const std::filesystem::path& directory = {})
{
    try
    {
        resolve(parsed(body, directory));
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "nothing refused";
}

/// Coordinates count up from 0.
std::string counting_cache(std::uint32_t points, std::uint32_t samples)
{
    std::vector<float> values;
    for (std::uint32_t k = 0; k < 3 * points * samples; ++k)
        values.push_back(static_cast<float>(k));
    return point_cache(points, samples, values);
}

} // namespace

TEST_CASE("a kinematic body becomes one pin of all its vertices, and nothing stretches it")
{
    const Scene scene = resolve(parsed(
        R"("grid": {"cells": [2, 3]}, "material": {"bending_stiffness": 1, "thickness": 0.004},
           "kinematic": {"motion": [{"time": 0}, {"time": 1, "translate": [0, 1, 0]}]})"));
    const Body& body = scene.bodies[0];
    REQUIRE(body.pins.size() == 1);
    CHECK(body.pins[0].vertices.size() == 12);
    CHECK(body.pins[0].motion.size() == 2);
    CHECK(body.material.stretch_stiffness == 0);
    CHECK(body.material.bending_stiffness == 0);
    CHECK(body.material.thickness == 0.004);
}

TEST_CASE("a kinematic body starts where its motion has it at time 0")
{
    const std::string grid = R"("grid": {"cells": [1, 1]}, "kinematic": {"motion": [)";
    const Scene ahead =
        resolve(parsed(grid + R"({"time": -1}, {"time": 1, "translate": [0, 2, 0]}]})")); // half-way at 0
    const Body& body = ahead.bodies[0];
    REQUIRE(body.start_positions.size() == 4);
    for (std::size_t v = 0; v < 4; ++v)
        CHECK(glm::distance(body.start_positions[v], body.mesh.positions[v] + glm::dvec3(0, 1, 0)) < 1e-12);
    const Scene here = resolve(parsed(grid + R"({"time": 0}, {"time": 1, "translate": [0, 2, 0]}]})"));
    CHECK(here.bodies[0].start_positions.empty());
}

TEST_CASE("a kinematic body has no elements of its fabric")
{
    const std::string cloth =
        R"("grid": {"cells": [2, 3]}, "material": {"fabric": {"preset": "clyde_cotton"}})";
    REQUIRE(resolve(parsed(cloth)).bodies[0].elements.size() == 1);
    const Scene scene = resolve(parsed(cloth + R"(, "kinematic": {})"));
    CHECK(scene.bodies[0].elements.empty());
    CHECK(!scene.bodies[0].material.fabric.used);
}

TEST_CASE("a kinematic solid keeps its surface alone")
{
    const Scene scene = resolve(parsed(R"("box": {"cells": [2, 2, 2]}, "kinematic": {})"));
    CHECK(scene.bodies[0].mesh.tetrahedra.empty());
    CHECK(scene.bodies[0].mesh.triangles.size() == 48);
    CHECK(scene.bodies[0].pins[0].vertices.size() == 27);
    CHECK(scene.bodies[0].material.model == SolidModel::neo_hookean);
}

TEST_CASE("a sequence of files moves the vertices that welding has left, by the body's transform")
{
    const Temporary folder;
    std::filesystem::create_directories(folder.path / "frames");
    folder.write("rest.obj", obj(5));
    folder.write("frames/f2.obj", obj(2));
    folder.write("frames/f10.obj", obj(3)); // welds nothing otherwise: the rest mesh says what is one
    const Scene scene =
        resolve(parsed(R"("mesh": "rest.obj", "transform": {"scale": 2, "translate": [0, 1, 0]},
        "kinematic": {"sequence": {"file": "frames", "rate": 10, "start": 1}})",
                       folder.path));
    const Body& body = scene.bodies[0];
    REQUIRE(body.mesh.positions.size() == 4);
    REQUIRE(body.pins[0].places);
    const SequencePlaces& places = *body.pins[0].places;
    REQUIRE(places.frames.size() == 2);
    CHECK(place_at(places, 0, 1) == glm::dvec3(2, 5, 0)); // 2 * 2 + 1, before the first frame
    CHECK(place_at(places, 1.05, 1).y == Approx(6));
    CHECK(place_at(places, 1.1, 3) == glm::dvec3(2, 7, 2));
    CHECK(place_at(places, 50, 3) == glm::dvec3(2, 7, 2)); // after the last one
    CHECK(body.start_positions[1] == glm::dvec3(2, 5, 0)); // where the sequence begins, not the rest shape
}

TEST_CASE("a point cache moves a generated shape")
{
    const Temporary folder;
    folder.write("walk.pc2", counting_cache(4, 3));
    const Scene scene = resolve(
        parsed(R"("grid": {"cells": [1, 1]}, "kinematic": {"sequence": {"file": "walk.pc2", "rate": 1}})",
               folder.path));
    const SequencePlaces& places = *scene.bodies[0].pins[0].places;
    REQUIRE(places.frames.size() == 3);
    CHECK(place_at(places, 1, 2) == glm::dvec3(18, 19, 20));
    CHECK(place_at(places, 1.5, 2) == glm::dvec3(24, 25, 26));
}

TEST_CASE("a sequence that its transform takes out of range is refused")
{
    const Temporary folder;
    std::vector<float> values(12, 1);
    values[10] = 1e25f;
    folder.write("walk.pc2", point_cache(4, 1, values));
    CHECK_THAT(refusal(R"("grid": {"cells": [1, 1]}, "transform": {"scale": 1e6},
                          "kinematic": {"sequence": {"file": "walk.pc2", "rate": 1}})",
                       folder.path),
               Contains("by the body's transform: vertex 3 is") && Contains("at most 1e30"));
}

TEST_CASE("what cannot stand beside kinematic is refused by name")
{
    const auto beside = [](const std::string& keys) {
        return refusal(R"("grid": {"cells": [1, 1]}, "kinematic": {}, )" + keys);
    };
    CHECK_THAT(beside(R"("pins": [{"corner": "top_left"}])"), Contains("bodies[0].pins stands beside"));
    CHECK_THAT(beside(R"("velocity": [1, 0, 0])"), Contains("bodies[0].velocity"));
    CHECK_THAT(beside(R"("contact": {"self": true})"), Contains("bodies[0].contact.self"));
    CHECK_THAT(beside(R"("springs": [{"a": 0, "b": 1, "rest_length": 1}])"), Contains("bodies[0].springs"));
    CHECK_THAT(refusal(R"("chain": {}, "kinematic": {})"), Contains("bodies[0].kinematic"));
    CHECK_THAT(refusal(R"("grid": {}, "kinematic": {"moved_by_program": true, "motion": [{"time": 0}]})"),
               Contains("bodies[0].kinematic has more than one of"));
    CHECK_THAT(refusal(R"("grid": {}, "kinematic": {"sequence": {"file": "a.pc2"}})"),
               Contains("kinematic.sequence lacks the key \"rate\""));
    CHECK_THAT(refusal(R"("grid": {}, "kinematic": {"sequence": {"file": "a.pc2", "rate": 0}})"),
               Contains("kinematic.sequence.rate"));
}

TEST_CASE("a sequence of another mesh, or none, is refused by its file")
{
    const Temporary folder;
    folder.write("walk.pc2", counting_cache(5, 3));
    folder.write("walk.txt", "");
    folder.write("rest.obj", obj(0));
    std::filesystem::create_directories(folder.path / "frames");
    folder.write("frames/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto with = [&](const std::string& shape, const std::string& file) {
        return refusal(shape + R"(, "kinematic": {"sequence": {"file": ")" + file + R"(", "rate": 1}})",
                       folder.path);
    };
    const std::string grid = R"("grid": {"cells": [1, 1]})", mesh = R"("mesh": "rest.obj")";
    CHECK_THAT(with(grid, "walk.pc2"), Contains("walk.pc2 moves 5 vertices; the body's mesh has 4"));
    CHECK_THAT(with(mesh, "walk.pc2"), Contains("walk.pc2 moves 5 vertices") && Contains("rest.obj has 6"));
    CHECK_THAT(with(mesh, "frames"), Contains("a.obj: its faces are not those of"));
    CHECK_THAT(with(mesh, "walk.txt"), Contains("name a point cache (.pc2) or a folder"));
    CHECK_THAT(with(mesh, "none.pc2"), Contains("none.pc2 cannot be read"));
    CHECK_THAT(with(mesh, "none"), Contains("none is no sequence that is read"));
    CHECK_THAT(with(mesh, "none"), Contains("bodies[0].kinematic.sequence.file"));
}

TEST_CASE("a mesh among the colliders is told where it belongs")
{
    CHECK_THROWS_WITH(parse_scene(R"({"taut": 1, "colliders": [{"mesh": "a.obj"}]})"),
                      Contains("\"kinematic\": {}"));
}

TEST_CASE("a kinematic body in a scene without contact is warned of")
{
    const auto warnings = [](const char* contact) {
        std::size_t count = 0;
        for (const SceneIssue& issue : check(parse_scene(std::string(R"({"taut": 1, )") + contact +
                                                         R"("bodies": [{"grid": {}, "kinematic": {}}]})")))
            count += !issue.error && issue.field == "bodies[0].kinematic";
        return count;
    };
    CHECK(warnings("") == 1);
    CHECK(warnings(R"("contact": {}, )") == 0);
}
