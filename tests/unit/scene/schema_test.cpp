// The JSON Schema against scenes, by a validator that knows nothing of Taut, and against the parser.

#include "support/catch.hpp"
#include "support/skip.hpp"
#include "temporary.hpp"

#include "taut/scene/key_text.hpp"
#include "taut/scene/schema.hpp"
#include "taut/scene/settings.hpp"
#include "taut/scene/tables.hpp"

#ifdef TAUT_HAS_VALIJSON
#include "support/json_schema.hpp"
#endif

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

using namespace taut;

namespace {

const std::filesystem::path kExamples = std::filesystem::path(TAUT_SOURCE_DIR) / "examples";

/// Scenes that the schema and the parser refuse alike.
std::vector<std::string> broken_scenes()
{
    std::vector<std::string> out = {R"({})", R"({"taut": 2})", R"([])", R"({"taut": "1"})"};
    for (const char* member : {R"("timestpe": 0.1)",
                               R"("timestep": 0)",
                               R"("timestep": 2)",
                               R"("timestep": "fast")",
                               R"("gravity": [0, 1])",
                               R"("gravity": [0, 1, null])",
                               R"("gravity": [0, 1, 1e31])",
                               R"("damping": -1)",
                               R"("external_forces": 1)",
                               R"("name": 1)",
                               R"("bodies": {})",
                               R"("method": [])",
                               R"("method": {"type": "xpdb"})",
                               R"("method": {"substeps": 0})",
                               R"("method": {"substeps": 2.5})",
                               R"("method": {"substeps": "some"})",
                               R"("method": {"stretch": 1.01})",
                               R"("method": {"relaxation": 2})",
                               R"("method": {"relaxation": 0})",
                               R"("method": {"spectral_radius": 1})",
                               R"("method": {"constraint_compliance": -1})",
                               R"("method": {"line_search": 17})",
                               R"("method": {"line_search": -1})",
                               R"("method": {"line_search": 4294967295})",
                               R"("method": {"line_search": "some"})",
                               R"("method": {"compress": "yes"})",
                               R"("accept": {"residual": 0})",
                               R"("accept": {"inverted": -1})",
                               R"("wind": {"density": -1})",
                               R"("wind": {"keys": [{"time": 0}]})",
                               R"("wind": {"keys": [{"velocity": [0, 0, 0]}]})",
                               R"("colliders": [{}])",
                               R"("colliders": [{"sphere": {}, "plane": {}}])",
                               R"("colliders": [{"sphere": {"radius": 0}}])",
                               R"("colliders": [{"sphere": {"normal": [0, 1, 0]}}])",
                               R"("colliders": [{"cuboid": {"half_size": [1, 0, 1]}}])",
                               R"("colliders": [{"plane": {}, "friction": -1}])",
                               R"("colliders": [{"capsule": {"to": 1}}])",
                               R"("colliders": [{"plane": {}, "motion": [{"translate": [0, 0, 0]}]}])"})
        out.push_back(std::string(R"({"taut": 1, )") + member + "}");
    for (const char* members : {R"("name": "x")",
                                R"("grid": {}, "chain": {})",
                                R"("cloth": {})",
                                R"("grid": {"cells": [4]})",
                                R"("grid": {"cells": [4, 0]})",
                                R"("grid": {"size": [1, 0]})",
                                R"("grid": {"diagonals": "both"})",
                                R"("grid": {"network": {"shear": -1}})",
                                R"("grid": {}, "weld_distance": 0)",
                                R"("mesh": "")",
                                R"("mesh": 3)",
                                R"("tetrahedra": "")",
                                R"("chain": {"width": 0})",
                                R"("chain": {"links": -1})",
                                R"("box": {"cells": [1, 1]})",
                                R"("box": {"split": "four"})",
                                R"("ball": {"cells": 1})",
                                R"("ball": {"radius": 0})",
                                R"("grid": {}, "embedded": "fine.obj")",
                                R"("box": {}, "embedded": "")",
                                R"("grid": {}, "material": {"density": 0})",
                                R"("grid": {}, "material": {"youngs_modulus": 1})",
                                R"("box": {}, "material": {"stretch_stiffness": 1})",
                                R"("box": {}, "material": {"model": "jelly"})",
                                R"("box": {}, "material": {"poissons_ratio": 0.5})",
                                R"("box": {}, "material": {"volume_stiffness": -1})",
                                R"("grid": {}, "material": {"stretch_stiffness": "stiff"})",
                                R"("grid": {}, "material": {"plastic_creep": 0})",
                                R"("grid": {}, "transform": {"scale": 0})",
                                R"("grid": {}, "transform": {"rotate": {"degree": 3}})",
                                R"("grid": {}, "pins": [{}])",
                                R"("grid": {}, "pins": [{"corner": "topleft"}])",
                                R"("grid": {}, "pins": [{"edges": ["up"]}])",
                                R"("grid": {}, "pins": [{"vertices": [-1]}])",
                                R"("grid": {}, "pins": [{"box": {"min": [0, 0, 0]}}])",
                                R"("grid": {}, "springs": [{"a": 0, "b": 1}])",
                                R"("grid": {}, "springs": [{"a": 0, "b": 1, "rest_length": -1}])",
                                R"("grid": {}, "vertex_masses": [0])",
                                R"("grid": {}, "start_positions": [[0, 0]])"})
        out.push_back(std::string(R"({"taut": 1, "bodies": [{)") + members + "}]}");
    return out;
}

} // namespace

TEST_CASE("the schema has every key of every table, with its words and its default", "[schema]")
{
    const auto schema = scene_file::scene_schema();
    for (const scene_file::Table* table : scene_file::all_tables())
    {
        std::string name(table->name);
        std::replace(name.begin(), name.end(), ' ', '_');
        const auto& object = name == "scene" ? schema : schema.at("$defs").at(name);
        CHECK(object.at("additionalProperties") == false);
        CHECK(object.at("properties").size() == table->keys.size());
        for (const scene_file::Key& key : table->keys)
        {
            INFO(name << ": " << key.name);
            const auto& property = object.at("properties").at(std::string(key.name));
            CHECK(!property.at("description").get<std::string>().empty());
        }
    }
    const auto& method = schema.at("$defs").at("method").at("properties");
    CHECK(method.at("type").at("enum").size() == kWords<MethodKind>.size());
    CHECK(method.at("type").at("default") == "xpbd");
    CHECK(method.at("substeps").at("default") == "automatic");
    CHECK(method.at("relaxation").at("exclusiveMaximum") == 2);
    CHECK_THAT(method.at("stretch").at("description").get<std::string>(), Contains("(read by pbd)"));
    CHECK(schema.at("$defs").at("wind").at("properties").at("density").at("default") == 1.2);
    CHECK(schema.at("required") == std::vector<std::string>{"taut"});
}

TEST_CASE("every scene of the list is an error to check", "[schema]")
{
    const Temporary folder;
    for (const std::string& text : broken_scenes())
    {
        INFO(text);
        CHECK(any_error(check_file(folder.write("scene.json", text))));
    }
}

#ifdef TAUT_HAS_VALIJSON

TEST_CASE("every scene of the examples is valid by the schema", "[schema]")
{
    const JsonSchema schema(scene_file::scene_schema());
    std::size_t scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kExamples))
    {
        if (entry.path().extension() != ".json")
            continue;
        ++scenes;
        std::ifstream stream(entry.path());
        INFO(entry.path());
        CHECK(schema.faults(nlohmann::json::parse(stream)) == "");
    }
    CHECK(scenes > 20);
}

TEST_CASE("no scene of the list is valid by the schema", "[schema]")
{
    const JsonSchema schema(scene_file::scene_schema());
    for (const std::string& text : broken_scenes())
    {
        INFO(text);
        CHECK(schema.faults(nlohmann::json::parse(text)) != "");
    }
}

#else

TEST_CASE("the schema is held against scenes by a validator", "[schema]")
{
    TAUT_LEFT_OUT("schema and scenes: valijson is not here (Debian, Ubuntu: libvalijson-dev)");
}

#endif
