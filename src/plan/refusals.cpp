#include "taut/plan/refusals.hpp"

#include "taut/scene/keys.hpp"
#include "taut/scene/tables.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace taut {
namespace {

bool stands_in_field(char c)
{
    return std::islower(static_cast<unsigned char>(c)) != 0 ||
           std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '[' || c == ']';
}

/// "bodies[2].pins" begins with a key of scenes, "vertex" does not.
bool begins_with_key(const std::string& field)
{
    const std::string first = field.substr(0, field.find_first_of(".["));
    const std::vector<std::string_view> keys = scene_file::names(scene_file::kSceneTable);
    return std::find(keys.begin(), keys.end(), first) != keys.end();
}

} // namespace

SceneIssue issue_of(const Error& error)
{
    const std::string text = error.what();
    const auto end = std::find_if_not(text.begin(), text.end(), stands_in_field);
    const std::string field(text.begin(), end), rest(end, text.end());
    const bool colon = rest.starts_with(": ");
    if (!begins_with_key(field) || !(colon || rest.starts_with(" is ") || rest.starts_with(" has ")))
        return {true, "", text, error.code()};
    return {true, field, rest.substr(colon ? 2 : 1), error.code()};
}

} // namespace taut
