#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/tables.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace taut;

namespace {

const std::filesystem::path kRoot = TAUT_SOURCE_DIR;

std::string page()
{
    std::ifstream stream(kRoot / "docs" / "scene.md");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The section of docs/scene.md under the heading "## `object`".
std::string section(const std::string& text, std::string_view object)
{
    const std::size_t begin = text.find("\n## `" + std::string(object) + "`");
    if (begin == std::string::npos)
        return {};
    return text.substr(begin, text.find("\n## ", begin + 1) - begin);
}

} // namespace

TEST_CASE("every key of the parser has a row in docs/scene.md, under its object")
{
    const std::string text = page();
    REQUIRE(!text.empty());
    for (const scene_file::Table* table : scene_file::all_tables())
    {
        const std::string rows = section(text, table->name);
        INFO("## `" << table->name << "`");
        CHECK(!rows.empty());
        for (const std::string_view key : scene_file::names(*table))
        {
            INFO(key);
            CHECK(rows.find("\n| `" + std::string(key) + "` |") != std::string::npos);
        }
    }
}

TEST_CASE("every row of docs/scene.md is a key of the parser")
{
    const std::string text = page();
    for (const scene_file::Table* table : scene_file::all_tables())
    {
        const std::string rows = section(text, table->name);
        for (std::size_t at = rows.find("\n| `"); at != std::string::npos; at = rows.find("\n| `", at + 1))
        {
            const std::string key = rows.substr(at + 4, rows.find('`', at + 4) - at - 4);
            INFO(table->name << ": " << key);
            CHECK(table->find(key));
        }
    }
}

TEST_CASE("the examples in docs/scene.md are scenes without a fault")
{
    const std::string text = page(), fence = "```json\n";
    int examples = 0;
    for (std::size_t at = text.find(fence); at != std::string::npos;
         at = text.find(fence, at + 1), ++examples)
    {
        const std::size_t begin = at + fence.size();
        const Scene scene =
            parse_scene(text.substr(begin, text.find("```", begin) - begin), {}, "docs/scene.md");
        for (const SceneIssue& issue : check(scene))
            FAIL(issue.field << ' ' << issue.text);
    }
    CHECK(examples >= 2);
}

TEST_CASE("every scene in examples/scenes loads and resolves without a warning")
{
    int scenes = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / "examples" / "scenes"))
    {
        if (entry.path().extension() != ".json")
            continue;
        INFO(entry.path());
        const Scene scene = load_scene(entry.path());
        std::vector<SceneIssue> warnings;
        CHECK_NOTHROW(resolve(scene, &warnings));
        CHECK(warnings.empty());
        ++scenes;
    }
    CHECK(scenes >= 2);
}

TEST_CASE("drape uses every effect of cloth, hanging none beside gravity and stretch")
{
    const Scene drape = load_scene(kRoot / "examples" / "scenes" / "drape.json");
    REQUIRE(drape.bodies.size() == 1);
    CHECK(drape.bodies[0].material.bending_stiffness > 0);
    REQUIRE(drape.colliders.size() == 2);
    CHECK(drape.colliders[0].friction > 0);
    CHECK(drape.duration >= 3);

    const Scene hanging = resolve(load_scene(kRoot / "examples" / "scenes" / "hanging.json"));
    REQUIRE(hanging.bodies.size() == 1);
    CHECK(hanging.bodies[0].material.bending_stiffness == 0);
    CHECK(hanging.colliders.empty());
    CHECK(hanging.damping == 0);
    REQUIRE(hanging.bodies[0].pins.size() == 1);
    CHECK(hanging.bodies[0].pins[0].vertices.size() == 2);
    CHECK(hanging.bodies[0].pins[0].motion.empty());
}
