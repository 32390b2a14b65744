// taut check lists everything that is wrong, each by its field: values, meshes, and what a plan refuses.

#include "cli/program.hpp"
#include "support/catch.hpp"

#include <map>

using program::Folder;
using program::Result;

namespace {

constexpr char kSolid[] = R"({"box": {"cells": [2, 2, 2], "size": [0.1, 0.1, 0.1]},
    "material": {"density": 1000, "youngs_modulus": 1e6}})";
constexpr char kRigid[] = R"({"grid": {"cells": [4, 4]}, "material": {"stretch_stiffness": "rigid"}})";
constexpr char kFabric[] = R"({"grid": {"cells": [4, 4]},
    "material": {"fabric": {"warp": 1000, "weft": 1000, "shear": 100}}})";

/// Texts of the errors of a scene, by field.
std::map<std::string, std::string> errors_of(const std::string& method, const std::string& bodies)
{
    const Folder folder;
    const std::string scene =
        folder.file("scene.json", R"({"taut": 1, "method": )" + method + R"(, "bodies": [)" + bodies + "]}");
    const Result result = folder.taut({"check", scene, "--json"});
    INFO(result.out << result.err);
    CHECK(result.status == 2);
    std::map<std::string, std::string> out;
    const auto issues = program::parse(result.out)["issues"];
    for (const auto& issue : issues)
        if (issue["error"].get<bool>())
            out[issue["field"].get<std::string>()] = issue["text"].get<std::string>();
    return out;
}

std::string list(std::initializer_list<std::string> bodies)
{
    std::string out;
    for (const std::string& body : bodies)
        out += (out.empty() ? "" : ", ") + body;
    return out;
}

} // namespace

TEST_CASE("check lists what a method refuses of every body")
{
    const auto acad = errors_of(R"({"type": "acad"})", list({kRigid, kSolid, kSolid, kFabric}));
    CHECK(acad.size() == 4);
    CHECK(acad.count("bodies[0].material.stretch_stiffness") == 1);
    CHECK(acad.count("bodies[1].material.model") == 1);
    CHECK(acad.count("bodies[2].material.model") == 1);
    CHECK(acad.count("bodies[3].material.fabric") == 1);
    for (const char* method : {"vbd", "implicit_euler", "mass_spring"})
    {
        CAPTURE(method);
        const auto errors =
            errors_of(R"({"type": ")" + std::string(method) + R"("})", list({kFabric, kRigid}));
        CHECK(errors.size() == 1);
        CHECK(errors.count("bodies[1].material.stretch_stiffness") == 1);
    }
}

TEST_CASE("check names the substeps of an explicit method that are too few")
{
    const auto errors = errors_of(R"({"type": "mass_spring", "substeps": 2, "stability": "refuse"})",
                                  R"({"grid": {}, "material": {"stretch_stiffness": 1e7}})");
    REQUIRE(errors.size() == 1);
    CHECK(errors.begin()->first == "method.substeps");
    CHECK(errors.begin()->second.rfind("is 2, so a substep", 0) == 0);
}

TEST_CASE("errors of one body do not hide those of the others")
{
    const std::string flat = R"({"box": {"cells": [2, 2, 2]}, "transform": {"scale": 1e-300}})";
    const std::string no_such_pin = R"({"grid": {"cells": [4, 4]}, "pins": [{"vertices": [999]}]})";
    const std::string negative = R"({"grid": {}, "material": {"density": -1}})";
    const auto errors = errors_of(R"({"type": "acad"})",
                                  list({negative, R"({"mesh": "no.obj"})", no_such_pin, flat, kSolid}));
    CHECK(errors.size() == 5);
    for (const char* field : {"bodies[0].material.density", "bodies[1].mesh", "bodies[2].pins[0].vertices[0]",
                              "bodies[3].box", "bodies[4].material.model"})
    {
        CAPTURE(field);
        CHECK(errors.count(field) == 1);
    }
}
