// The scene file. Defaults are those of the C++ types: a key that is missing leaves them alone.

#include "taut/scene/check_table.hpp"
#include "taut/scene/field.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/json_text.hpp"
#include "taut/scene/read_table.hpp"
#include "taut/scene/set_value.hpp"
#include "taut/scene/settings.hpp"
#include "taut/scene/tables.hpp"

namespace taut {
namespace {

using scene_file::Field;

Scene read_scene(const Field& field)
{
    Scene scene;
    read_table(field, scene_file::kSceneTable, &scene);
    return scene;
}

/// What a scene has of its file's place.
void place(Scene& scene, const std::filesystem::path& file)
{
    scene.directory = file.parent_path();
    if (scene.name.empty())
        scene.name = file.stem().string();
}

/// Files that are not there, of a scene that has other faults: without any, resolve() reads them and says so.
void add_missing_files(const Scene& scene, const std::filesystem::path& directory,
                       std::vector<SceneIssue>& issues)
{
    const auto look = [&](const std::filesystem::path& file, const std::string& field) {
        if (std::error_code ignored; !file.empty() && !std::filesystem::exists(directory / file, ignored))
            issues.push_back({true, field,
                              "names " + file.string() + "; there is no such file (looked for " +
                                  (directory / file).string() + ")",
                              ErrorCode::io});
    };
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    {
        const Body& body = scene.bodies[b];
        const std::string where = "bodies[" + std::to_string(b) + "].";
        look(body.shape.file, where + (body.shape.kind == ShapeKind::tetrahedra ? "tetrahedra" : "mesh"));
        look(body.embedded_file, where + "embedded");
    }
    for (std::size_t c = 0; c < scene.colliders.size(); ++c)
        look(scene.colliders[c].field_file, "colliders[" + std::to_string(c) + "].distance_field.file");
}

/// Errors may all be among what is left out, so the last line is one if any was.
void cut_short(std::vector<SceneIssue>& issues)
{
    if (issues.size() <= scene_file::kMostIssues)
        return;
    const bool error = any_error(issues);
    issues.resize(scene_file::kMostIssues);
    issues.push_back(
        {error, "", "the scene has more mistakes than these; mend the first ones and check it again"});
}

} // namespace

std::vector<SceneIssue> check_file(const std::filesystem::path& file, Scene* scene,
                                   std::vector<std::string>* method_keys)
{
    const std::string name = file.string();
    const std::string text = scene_file::read_file(file, scene_file::kMaxSceneBytes);
    std::vector<SceneIssue> issues;
    const nlohmann::json tree = scene_file::parse_json(text, name);
    Scene found;
    try
    {
        Field::attempt([&] { read_table(Field(tree, name, {}, &issues), scene_file::kSceneTable, &found); });
    }
    catch (const scene_file::ListFull&)
    {}
    if (issues.empty())
        issues = check(found);
    else
        for (SceneIssue& issue : scene_file::check_keys(found))
            issues.push_back(std::move(issue));
    if (any_error(issues))
        add_missing_files(found, file.parent_path(), issues);
    cut_short(issues);
    if (method_keys)
        *method_keys = scene_file::keys_of(tree, "method");
    if (scene)
    {
        *scene = std::move(found);
        place(*scene, file);
    }
    return issues;
}

Scene parse_scene(std::string_view json, const std::filesystem::path& directory, std::string_view name,
                  std::span<const std::string> settings)
{
    const std::string file(name);
    nlohmann::json tree = scene_file::parse_json(json, file);
    for (const std::string& setting : settings)
        scene_file::set_value(tree, setting, file);
    Scene scene = read_scene(Field(tree, file, {}));
    scene.directory = directory;
    return scene;
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> settings)
{
    Scene scene = parse_scene(scene_file::read_file(file, scene_file::kMaxSceneBytes), file.parent_path(),
                              file.string(), settings);
    place(scene, file);
    return scene;
}

Scene parse_scene(std::string_view json, const std::filesystem::path& directory, std::string_view name)
{
    return parse_scene(json, directory, name, {});
}

Scene load_scene(const std::filesystem::path& file) { return load_scene(file, {}); }

} // namespace taut
