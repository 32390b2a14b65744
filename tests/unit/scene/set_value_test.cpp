#include "support/catch.hpp"
#include "temporary.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/settings.hpp"

using namespace taut;

namespace {

const char* const kScene = R"({"taut": 1, "bodies": [{"grid": {}}, {"chain": {"links": 3}}]})";

std::string refusal_of(const std::string& setting)
{
    try
    {
        parse_scene(kScene, {}, "my.json", std::vector<std::string>{setting});
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("settings change single values of a scene, and make objects that are missing")
{
    const std::vector<std::string> settings = {"method.type=acad", "method.substeps=7",
                                               "bodies[0].material.drag=1.5", "gravity=[0, 0, -1]",
                                               "bodies[1].chain.links=9", "bodies[0].grid.network.bend=4",
                                               "method.volume=0.25"};
    const Scene scene = parse_scene(kScene, {}, "my.json", settings);
    CHECK(scene.method.type == MethodKind::acad);
    CHECK(scene.method.substeps == 7);
    CHECK(scene.method.volume == 0.25);
    CHECK(scene.bodies[0].material.drag == 1.5);
    CHECK(scene.gravity == glm::dvec3(0, 0, -1));
    CHECK(scene.bodies[1].shape.links == 9);
    CHECK(scene.bodies[0].shape.network.used);
    CHECK(scene.bodies[0].shape.network.bend == 4);
}

TEST_CASE("a check of a file lists unknown and missing keys under their own path")
{
    const Temporary folder;
    const auto file = folder.write("some.json", R"({"gravitty": [0, 0, 0], "bodies": [
        {"chain": {"links": 3}, "material": {"densty": 1}, "springs": [{"a": 0, "b": 1}]}]})");
    std::vector<std::string> found;
    for (const SceneIssue& issue : check_file(file))
        found.push_back(issue.field + " " + issue.text.substr(0, issue.text.find(';')));
    const std::vector<std::string> expected = {"gravitty is an unknown key", "taut is missing",
                                               "bodies[0].material.densty is an unknown key",
                                               "bodies[0].springs[0].rest_length is missing"};
    CHECK_THAT(found, Catch::Matchers::UnorderedEquals(expected));
}

TEST_CASE("a key that no path can have stands in brackets, in quotes and short")
{
    const Temporary folder;
    const auto field_of = [&](const std::string& key) {
        const auto issues = check_file(folder.write("some.json", "{\"taut\": 1, \"" + key + "\": 1}"));
        REQUIRE(!issues.empty());
        return issues[0].field;
    };
    CHECK(field_of("") == "[\"\"]");
    CHECK(field_of("method.substeps") == "[\"method.substeps\"]");
    CHECK(field_of("\\u001b[2J") == "[\"\\u001b[2J\"]");
    CHECK(field_of(std::string(5000, 'x')).size() < 70);
}

TEST_CASE("of a file with thousands of mistakes the first are listed, each under its path")
{
    const Temporary folder;
    std::string springs;
    for (int k = 0; k < 3000; ++k)
        springs +=
            std::string(k == 0 ? "" : ", ") + R"({"a": 0, "b": "one", "rest_length": 1, "compliance": 0})";
    const auto issues =
        check_file(folder.write("many.json", R"({"taut": 1, "bodies": [{"grid": {}, "springs": [)" + springs +
                                                 R"(], "pins": [{"at": 1}]}]})"));
    REQUIRE(issues.size() == scene_file::kMostIssues + 1);
    CHECK(issues[0].field == "bodies[0].pins[0].at");
    CHECK(issues[999].field == "bodies[0].springs[998].b");
    CHECK(issues.back().error);
    CHECK_THAT(issues.back().text, Contains("more mistakes than these"));
}

TEST_CASE("a scene without bodies is told that nothing happens in it")
{
    const std::vector<SceneIssue> issues = check(Scene());
    REQUIRE(issues.size() == 1);
    CHECK(issues[0].field == "bodies");
    CHECK(!issues[0].error);
}

TEST_CASE("a check of a file hands out the scene and the keys that it has read")
{
    const Temporary folder;
    const auto file = folder.write("some.json", R"({"taut": 1, "bodies": [{"chain": {"links": 3}}],
                                                    "method": {"type": "vbd", "iterations": 7}})");
    Scene scene;
    std::vector<std::string> keys;
    CHECK(check_file(file, &scene, &keys).empty());
    CHECK(keys == given_method_keys(file, {}));
    CHECK(keys.size() == 2);
    CHECK(scene.name == "some");
    CHECK(scene.directory == folder.path);
    CHECK(scene.method.iterations == 7);
    CHECK(scene.bodies[0].shape.links == 3);
}

TEST_CASE("settings that say nothing are refused in words")
{
    CHECK_THAT(refusal_of("method.substeps"), Contains("my.json") && Contains("has no \"=\""));
    CHECK_THAT(refusal_of("=3"), Contains("empty key"));
    CHECK_THAT(refusal_of("bodies[2].velocity=[0, 0, 0]"), Contains("element 2 of a list of 2"));
    CHECK_THAT(refusal_of("bodies[x].velocity=[0, 0, 0]"), Contains("whole number"));
    CHECK_THAT(refusal_of("bodies[0.velocity=[0, 0, 0]"), Contains("does not close"));
    CHECK_THAT(refusal_of("method[0]=3"), Contains("not a list"));
    CHECK_THAT(refusal_of("taut.x=3"), Contains("not an object"));
    CHECK_THAT(refusal_of("bodies.0.velocity=[0, 0, 0]"), Contains("of a list") && Contains("bodies[0]"));
    CHECK_THAT(refusal_of("method.substep=3"), Contains("did you mean \"substeps\"?")); // by the parser
    CHECK_THAT(refusal_of("method.substeps=many"), Contains("many"));
}
