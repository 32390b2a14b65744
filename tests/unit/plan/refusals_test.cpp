#include "taut/plan/refusals.hpp"

#include "support/catch.hpp"

using namespace taut;

TEST_CASE("a refusal is an issue of the field that its message begins with")
{
    const auto issue = [](const char* text) { return issue_of(Error(ErrorCode::unsupported, text)); };
    const SceneIssue model = issue("bodies[12].material.model is \"fife\"");
    CHECK(model.field == "bodies[12].material.model");
    CHECK(model.text == "is \"fife\"");
    CHECK(model.code == ErrorCode::unsupported);
    CHECK(model.error);
    CHECK(issue("bodies[0] has no springs").field == "bodies[0]");
    CHECK(issue("timestep is 0").field == "timestep");
    CHECK(issue("bodies[0].elements[1]: a body").field == "bodies[0].elements[1]");
    CHECK(issue("bodies[0].elements[1]: a body").text == "a body");
}

TEST_CASE("a sentence that begins with no key is an issue of no field")
{
    const auto issue = [](const char* text) { return issue_of(Error(ErrorCode::limit, text)); };
    for (const char* text : {"vertex 3 is not finite", "it is too large", "vertex: too many", "", "bodies",
                             "timestep of 1 is too long"})
    {
        CAPTURE(text);
        CHECK(issue(text).field.empty());
        CHECK(issue(text).text == text);
    }
}

TEST_CASE("refusals are gathered body by body, and the first is thrown")
{
    Scene scene;
    scene.bodies.resize(3);
    Refusals out;
    CHECK_NOTHROW(out.throw_first());
    out.attempt_bodies(scene, [](const Body&, std::size_t k) {
        if (k > 0)
            throw Error(ErrorCode::bad_input, "bodies[" + std::to_string(k) + "] is wrong");
    });
    REQUIRE(out.found().size() == 2);
    CHECK_THROWS_WITH(out.throw_first(), "bodies[1] is wrong");
    CHECK_THROWS_AS(out.attempt([] { throw Error(ErrorCode::out_of_memory, "none left"); }), Error);
}
