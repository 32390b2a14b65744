// Distance fields as values and as files.

#include "support/catch.hpp"
#include "unit/scene/refusal.hpp"
#include "unit/scene/temporary.hpp"

#include "taut/scene/collider.hpp"
#include "taut/scene/distance_field.hpp"

#include <glm/geometric.hpp>

#include <fstream>
#include <sstream>

using namespace taut;

namespace {

DistanceField ball_field(double radius = 0.5, double cell = 0.125, std::uint32_t points = 13)
{
    DistanceField field;
    field.points = {points, points, points};
    field.low = glm::dvec3(-0.5 * cell * (points - 1));
    field.cell = cell;
    for (std::uint32_t k = 0; k < points; ++k)
        for (std::uint32_t j = 0; j < points; ++j)
            for (std::uint32_t i = 0; i < points; ++i)
                field.values.push_back(static_cast<float>(glm::length(field.place(i, j, k)) - radius));
    return field;
}

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// The message that a call ends with; "nothing" where it ends well.
template <typename F>
std::string message_of(const F& call)
{
    try
    {
        call();
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "nothing";
}

std::string refused(const std::filesystem::path& file)
{
    return message_of([&] { read_distance_field(file); });
}

std::string refused(const std::string& json, const std::filesystem::path& folder)
{
    return message_of([&] { resolve(parse_scene(json, folder, "scene.json")); });
}

} // namespace

TEST_CASE("between its points a field is linear along each axis, and beyond them no less than the way there")
{
    DistanceField field = ball_field();
    CHECK(field.distance(field.place(3, 7, 2)) == Approx(field.values[field.index(3, 7, 2)]));
    const glm::dvec3 a = field.place(4, 5, 6), b = field.place(5, 5, 6);
    CHECK(field.distance(a + 0.25 * (b - a)) ==
          Approx(0.75 * field.values[field.index(4, 5, 6)] + 0.25 * field.values[field.index(5, 5, 6)]));
    for (const glm::dvec3& p : {glm::dvec3(2, 0.1, 0), glm::dvec3(-3, 4, 0.2), glm::dvec3(0.9, 5, -7)})
    {
        const double exact = glm::length(p) - 0.5;
        CHECK(field.distance(p) <= exact + 1e-6);
        CHECK(field.distance(p) > 0.8 * exact);
        CHECK(glm::dot(field.normal(p), glm::normalize(p)) > 0.9);
    }
    CHECK(field.depth() == Approx(0.5));
    CHECK(field.normal(glm::dvec3(0)) == glm::dvec3(0, 1, 0)); // the middle of the ball has no way out
    CHECK(glm::distance(field.normal({0.3, 0.2, 0.1}), glm::normalize(glm::dvec3(0.3, 0.2, 0.1))) < 0.05);
}

TEST_CASE("a field is written and read to the last bit")
{
    const Temporary folder;
    const DistanceField field = ball_field();
    write_distance_field(folder.path / "ball.sdf", field);
    const DistanceField back = read_distance_field(folder.path / "ball.sdf");
    CHECK(back.points == field.points);
    CHECK(back.low == field.low);
    CHECK(back.cell == field.cell);
    CHECK(back.values == field.values);
    CHECK(text_of(folder.path / "ball.sdf").starts_with("13 13 13\n-0.75 -0.75 -0.75\n0.125\n"));
}

TEST_CASE("a file that is no field is refused by its line, or by its point")
{
    const Temporary folder;
    write_distance_field(folder.path / "ball.sdf", ball_field());
    const std::string good = text_of(folder.path / "ball.sdf");
    const auto refused_text = [&](const std::string& text) {
        std::ofstream(folder.path / "bad.sdf") << text;
        return refused(folder.path / "bad.sdf");
    };
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return refused_text(text.replace(text.find(from), from.size(), to));
    };
    CHECK_THAT(refused(folder.path / "none.sdf"), Contains("none.sdf") && Contains("no such file"));
    CHECK_THAT(refused_text(""), Contains("bad.sdf"));
    CHECK_THAT(with("13 13 13", "13 1 13"), Contains("bad.sdf: line 1") && Contains("2 to 2^30"));
    CHECK_THAT(with("13 13 13", "13 13 14"), Contains("too short") || Contains("a distance"));
    CHECK_THAT(with("13 13 13", "13 13 12"), Contains("more values"));
    CHECK_THAT(with("13 13 13", "1000000000 1000000000 1000000000"), Contains("too short"));
    CHECK_THAT(with("\n0.125\n", "\n0\n"), Contains("1e-15"));
    CHECK_THAT(with("\n0.125\n", "\nnear\n"), Contains("bad.sdf: line 3") && Contains("near"));
    CHECK_THAT(with("\n0.125\n", "\n0.0125\n"), Contains("distances do not")); // not the file's unit
    CHECK_THAT(with("\n0.125\n", "\n12.5\n"), Contains("another unit"));
    CHECK_THAT(with("\n-0.5\n", "\nnan\n"), Contains("finite"));
}

TEST_CASE("a field without an inside, or with a border that is inside, is no collider")
{
    Scene scene;
    scene.bodies.resize(1);
    scene.colliders.resize(1);
    scene.colliders[0].kind = ColliderKind::distance_field;
    const auto refused_field = [&](DistanceField field) {
        scene.colliders[0].field = std::make_shared<const DistanceField>(std::move(field));
        return refusal(scene);
    };
    CHECK(refused_field(ball_field()) == "nothing");
    CHECK_THAT(refused_field(ball_field(0.9)), Contains("colliders[0].distance_field") && Contains("border"));
    DistanceField outside = ball_field();
    for (float& value : outside.values)
        value = std::abs(value) + 0.01f;
    CHECK_THAT(refused_field(outside), Contains("nothing is inside"));
    DistanceField cut = ball_field();
    cut.values.pop_back();
    CHECK_THAT(refused_field(cut), Contains("2196 values"));
    scene.colliders[0].field = nullptr;
    CHECK_THAT(refusal(scene), Contains("colliders[0].distance_field.file") && Contains("taut sdf"));
}

TEST_CASE("a scene names its grid, which is scaled, turned about its origin and looked for beside the file")
{
    const Temporary folder;
    DistanceField field = ball_field();
    field.low.x += 2; // the ball lies at x = 2 of its file
    write_distance_field(folder.path / "ball.sdf", field);
    const std::string text =
        R"({"taut": 1, "bodies": [{"name": "sheet", "grid": {"cells": [2, 2]}}], "colliders": [
        {"distance_field": {"file": "ball.sdf", "origin": [1, 0, 0], "scale": 0.5,
                            "rotate": {"axis": [0, 1, 0], "degrees": 90}}}]})";
    const Scene scene = resolve(parse_scene(text, folder.path, "scene.json"));
    const Collider& collider = scene.colliders.at(0);
    const ColliderFrame frame = rest_frame(collider);
    CHECK(glm::distance(frame.centre, glm::dvec3(1, 0, -1)) < 1e-12); // x of the file goes to -z
    const ColliderSolid solid = solid_of(collider);
    CHECK(glm::distance(solid.half, glm::dvec3(0.375)) < 1e-12);
    CHECK(solid.field_distance({0, 0, 0}) == Approx(-0.25));
    CHECK(solid.field_distance(frame.inside({1, 0.3, -1})) == Approx(0.05).margin(1e-3));
    CHECK_THAT(refused(text, folder.path / "elsewhere"), Contains("colliders[0].distance_field.file"));
}

TEST_CASE(
    "a grid that ends nearer than the gap that a body keeps is refused, and so is what scale makes of one")
{
    const Temporary folder;
    write_distance_field(folder.path / "ball.sdf", ball_field()); // ends 0.25 m from the ball
    const auto refused_scene = [&](const std::string& thickness, const std::string& scale) {
        const std::string text = R"({"taut": 1, "bodies": [{"name": "s", "grid": {"cells": [2, 2]},
            "material": {"thickness": )" +
                                 thickness + R"(}}], "colliders": [
            {"distance_field": {"file": "ball.sdf", "scale": )" +
                                 scale + "}}]}";
        return refused(text, folder.path);
    };
    CHECK(refused_scene("0.24", "1") == "nothing");
    CHECK_THAT(refused_scene("0.26", "1"), Contains("colliders[0].distance_field") && Contains("--margin"));
    CHECK_THAT(refused_scene("0.001", "1e-30"), Contains("distance_field.scale"));
}
