#include "taut/scene/settings.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/file_text.hpp"
#include "taut/scene/json_text.hpp"
#include "taut/scene/set_value.hpp"

#include <algorithm>

namespace taut {

bool any_error(std::span<const SceneIssue> issues)
{
    return std::any_of(issues.begin(), issues.end(), [](const SceneIssue& issue) { return issue.error; });
}

std::vector<std::string> given_method_keys(const std::filesystem::path& file,
                                           std::span<const std::string> settings)
{
    nlohmann::json tree =
        scene_file::parse_json(scene_file::read_file(file, scene_file::kMaxSceneBytes), file.string());
    for (const std::string& setting : settings)
        scene_file::set_value(tree, setting, file.string());
    return scene_file::keys_of(tree, "method");
}

Scene resolve_file(const std::filesystem::path& file, std::span<const std::string> settings,
                   std::vector<SceneIssue>* found)
{
    const Scene scene = load_scene(file, settings);
    try
    {
        return resolve(scene, found);
    }
    catch (const Error& error)
    {
        throw Error(error.code(), file.string() + ": " + error.what());
    }
}

} // namespace taut
