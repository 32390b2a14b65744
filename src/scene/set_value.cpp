#include "taut/scene/set_value.hpp"

#include "taut/runtime/base/error.hpp"

#include <charconv>

namespace taut::scene_file {
namespace {

class Setting
{
public:
    Setting(std::string_view text, const std::string& file) : text_(text), file_(&file) {}

    [[noreturn]] void fail(const std::string& why) const
    {
        throw Error(ErrorCode::bad_input, *file_ + ": setting \"" + std::string(text_) + "\" " + why);
    }

    /// Goes to one part of the path, "bodies[0][1]".
    nlohmann::json& enter(nlohmann::json& at, std::string_view part) const
    {
        const std::size_t bracket = std::min(part.find('['), part.size());
        const std::string key(part.substr(0, bracket));
        if (key.empty())
            fail("has an empty key; write for example method.substeps=20");
        if (at.is_null())
            at = nlohmann::json::object();
        if (at.is_array())
            fail("asks for \"" + key + "\" of a list; write an element of it as bodies[0]");
        if (!at.is_object())
            fail("asks for \"" + key + "\" in what is not an object");
        nlohmann::json* found = &at[key];
        for (std::string_view rest = part.substr(bracket); !rest.empty();)
            found = &element(*found, rest);
        return *found;
    }

private:
    /// Takes "[3]" off the front of `rest`.
    nlohmann::json& element(nlohmann::json& list, std::string_view& rest) const
    {
        std::size_t index = 0;
        const std::size_t close = rest.find(']');
        if (rest.front() != '[' || close == std::string_view::npos)
            fail("has a bracket that does not close; write for example bodies[0]");
        const auto [end, error] = std::from_chars(rest.data() + 1, rest.data() + close, index);
        if (error != std::errc() || end != rest.data() + close)
            fail("needs a whole number between its brackets");
        if (!list.is_array() || index >= list.size())
            fail("asks for element " + std::to_string(index) + " of " +
                 (list.is_array() ? "a list of " + std::to_string(list.size()) : "what is not a list"));
        rest.remove_prefix(close + 1);
        return list[index];
    }

    std::string_view text_;
    const std::string* file_;
};

} // namespace

void set_value(nlohmann::json& tree, std::string_view text, const std::string& file)
{
    const Setting setting(text, file);
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos)
        setting.fail("has no \"=\"; write for example method.substeps=20");
    nlohmann::json* at = &tree;
    std::string_view path = text.substr(0, equals);
    for (;;)
    {
        const std::size_t dot = std::min(path.find('.'), path.size());
        at = &setting.enter(*at, path.substr(0, dot));
        if (dot == path.size())
            break;
        path.remove_prefix(dot + 1);
    }
    const std::string value(text.substr(equals + 1));
    nlohmann::json parsed = nlohmann::json::parse(value, nullptr, false);
    *at = parsed.is_discarded() ? nlohmann::json(value) : std::move(parsed);
}

} // namespace taut::scene_file
