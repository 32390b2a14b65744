#include "support/catch.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/scene.hpp"
#include "taut/scene/schema.hpp"
#include "taut/scene/tables.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace taut;

namespace {

const std::filesystem::path kRoot = TAUT_SOURCE_DIR;

std::string page(const char* name)
{
    std::ifstream stream(kRoot / "docs" / name);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// What stands from each "<!-- NAME -->" to the next "<!-- end -->", in order.
std::vector<std::string> tables_in(const std::string& text)
{
    std::vector<std::string> out;
    const std::string begin = "\n<!-- ", end = "\n<!-- end -->\n";
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at))
    {
        const std::size_t last = text.find(end, at) + end.size() - 1;
        out.push_back(text.substr(at, last - at));
        at = last;
    }
    return out;
}

} // namespace

TEST_CASE("the pages have the tables of the program (docs/update_tables.sh puts them there)")
{
    std::vector<std::string> shown = tables_in(page("scene.md"));
    for (std::string& table : tables_in(page("methods.md")))
        shown.push_back(std::move(table));
    const std::vector<std::string> made = tables_in("\n" + scene_file::tables_as_markdown());
    REQUIRE(shown.size() == made.size());
    REQUIRE(made.size() == scene_file::all_tables().size() + 1);
    for (std::size_t i = 0; i < made.size(); ++i)
        CHECK(shown[i] == made[i]);
}

TEST_CASE("each table stands under the heading of its object")
{
    const std::string text = page("scene.md");
    for (const scene_file::Table* table : scene_file::all_tables())
    {
        const std::string name(table->name);
        INFO(name);
        const std::size_t heading = text.find("\n## `" + name + "`\n");
        REQUIRE(heading != std::string::npos);
        CHECK(text.find("\n<!-- " + name + " -->\n") < text.find("\n## ", heading + 1));
    }
}

TEST_CASE("rows have a sentence, and what they name is there")
{
    for (const scene_file::Table* table : scene_file::all_tables())
        for (const scene_file::Key& key : table->keys)
        {
            INFO(table->name << ": " << key.name);
            CHECK(!key.what.empty());
            CHECK(std::count_if(table->keys.begin(), table->keys.end(),
                                [&](const auto& other) { return other.name == key.name; }) == 1);
            const std::string_view file = key.page.substr(0, key.page.find('#'));
            CHECK((key.page.empty() || std::filesystem::exists(kRoot / "docs" / file)));
            CHECK((key.beside.empty() || key.beside == "solids" || table->find(key.beside)));
            if (key.kind != scene_file::Kind::object && key.kind != scene_file::Kind::objects)
                continue;
            const auto all = scene_file::all_tables();
            CHECK(std::any_of(all.begin(), all.end(),
                              [&](const scene_file::Table* t) { return t->name == key.table->name; }));
        }
}

TEST_CASE("the examples in docs/scene.md are scenes without a fault")
{
    const std::string text = page("scene.md"), fence = "```json\n";
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
    CHECK(drape.bodies[0].contact.self);
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
