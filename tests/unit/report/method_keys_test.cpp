// The table of keys that methods read against the scenes that speak of them.

#include "support/catch.hpp"

#include "taut/report/method_settings.hpp"
#include "taut/scene/keys.hpp"
#include "taut/scene/settings.hpp"
#include "taut/scene/tables.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

using namespace taut;

namespace {

using Words = std::set<std::string>;

Words read_by(MethodKind kind)
{
    const auto keys = keys_read(kind);
    return {keys.begin(), keys.end()};
}

} // namespace

TEST_CASE("every key of a method is read by one at least", "[method_keys]")
{
    Words known = {"type", "substeps", "precision"};
    for (std::size_t k = 0; k < kWords<MethodKind>.size(); ++k)
        known.merge(read_by(static_cast<MethodKind>(k)));
    const auto keys = scene_file::names(scene_file::kMethodTable);
    CHECK(known == Words(keys.begin(), keys.end()));
}

TEST_CASE("a key that the method does not read is a warning by its field", "[method_keys]")
{
    MethodSettings settings;
    settings.type = MethodKind::pbd;
    const auto issues = unread_keys(settings, {"type", "substeps", "release", "stretch", "tau"});
    REQUIRE(issues.size() == 2);
    CHECK_FALSE(issues[0].error);
    CHECK(issues[0].field == "method.release");
    CHECK(issues[0].text.find("\"pbd\" does not read it") != std::string::npos);
    CHECK(issues[1].field == "method.tau");
    settings.type = MethodKind::mass_spring;
    CHECK(unread_keys(settings, {"iterations"}).empty()); // of the volume within a surface
    CHECK(unread_keys(settings, {"linear_operator"}).size() == 1);
    settings.type = MethodKind::acad;
    CHECK(unread_keys(settings, {"linear_operator"}).size() == 1); // its rows are never assembled
    CHECK(unread_keys(settings, {"release", "stability", "iterations", "integrator"}).empty());
}

TEST_CASE("no scene among the examples gives its method a key that it does not read", "[method_keys]")
{
    std::size_t scenes = 0;
    const std::string folder = std::string(TAUT_SOURCE_DIR) + "/examples/scenes";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    {
        if (entry.path().extension() != ".json")
            continue;
        ++scenes;
        CAPTURE(entry.path().string());
        const Scene scene = load_scene(entry.path());
        for (const SceneIssue& issue : unread_keys(scene.method, given_method_keys(entry.path(), {})))
            FAIL_CHECK(issue.field);
    }
    CHECK(scenes > 20);
}

TEST_CASE("keys of a method are those of the file and of settings", "[method_keys]")
{
    const std::filesystem::path file = std::string(TAUT_SOURCE_DIR) + "/examples/scenes/pbd.json";
    const std::string settings[] = {"method.release=strain", "gravity=[0,0,0]"};
    const auto keys = given_method_keys(file, settings);
    CHECK(Words(keys.begin(), keys.end()) ==
          Words{"bend", "iterations", "release", "scheme", "stretch", "substeps", "type"});
}
