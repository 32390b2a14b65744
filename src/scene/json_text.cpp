#include "taut/scene/json_text.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace taut::scene_file {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxDepth = 32;

std::string place(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_start + 1);
}

/// The library's message without its number and its own idea of the place.
std::string reason(std::string what)
{
    for (const std::string_view mark : {"] ", "while parsing "})
        if (const std::size_t at = what.find(mark); at != std::string::npos)
            what.erase(0, at + mark.size());
    return what;
}

/// Builds the tree, and notices what the library's own parser does not tell: keys that stand twice, depth,
/// and where. (Its callback looks through a list again after each of its entries.)
class Builder final : public nlohmann::json_sax<json>
{
public:
    explicit Builder(const std::string& file) : file_(file) {}

    json take() { return std::move(root_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t& value) override { return put(std::move(value)); }
    bool start_object(std::size_t) override { return enter(json::object()); }
    bool start_array(std::size_t) override { return enter(json::array()); }
    bool end_object() override { return leave(); }
    bool end_array() override { return leave(); }

    bool parse_error(std::size_t, const std::string&, const json::exception& error) override
    {
        if (const auto* broken = dynamic_cast<const json::parse_error*>(&error))
            throw *broken;
        if (const auto* large = dynamic_cast<const json::out_of_range*>(&error))
            throw *large;
        throw Error(ErrorCode::bad_input, file_ + ": " + reason(error.what()));
    }

    bool key(string_t& name) override
    {
        Level& level = levels_.back();
        const auto [entry, is_new] = level.tree->emplace(name, nullptr);
        if (!is_new)
        {
            levels_.pop_back();
            const std::string where = levels_.empty() ? "the scene" : path();
            throw Error(ErrorCode::bad_input, file_ + ": the key \"" + name + "\" stands twice in " + where +
                                                  "; keep one of the two");
        }
        level.entry = &*entry;
        level.key = std::move(name);
        return true;
    }

private:
    /// Pointers hold: nothing is added to a list or an object while one of its entries is open.
    struct Level
    {
        json* tree = nullptr;
        json* entry = nullptr; ///< of an object, what the value of the last key becomes
        std::string key;
    };

    json& placed(json value)
    {
        if (levels_.empty())
            return root_ = std::move(value);
        Level& level = levels_.back();
        if (!level.tree->is_array())
            return *level.entry = std::move(value);
        level.tree->push_back(std::move(value));
        return level.tree->back();
    }

    bool put(json value)
    {
        placed(std::move(value));
        return true;
    }

    bool enter(json container)
    {
        json& tree = placed(std::move(container));
        if (levels_.size() > kMaxDepth)
            throw Error(ErrorCode::bad_input, file_ + ": " + path() + " is nested more than " +
                                                  std::to_string(kMaxDepth) +
                                                  " levels deep; a scene needs 8");
        levels_.push_back({&tree, nullptr, {}});
        return true;
    }

    bool leave()
    {
        levels_.pop_back();
        return true;
    }

    std::string path() const
    {
        std::string out;
        for (const Level& level : levels_)
            if (level.tree->is_array())
                out += '[' + std::to_string(level.tree->empty() ? 0 : level.tree->size() - 1) + ']';
            else
                out += (out.empty() ? "" : ".") + level.key;
        return out;
    }

    std::string file_;
    json root_;
    std::vector<Level> levels_;
};

} // namespace

json parse_json(std::string_view text, const std::string& file)
{
    try
    {
        Builder builder(file);
        json::sax_parse(text.begin(), text.end(), &builder);
        return builder.take();
    }
    catch (const json::parse_error& error)
    {
        throw Error(ErrorCode::bad_input, file + ": " + place(text, error.byte == 0 ? 0 : error.byte - 1) +
                                              " is not JSON: " + reason(error.what()));
    }
    catch (const json::exception& error) // a number that no double can hold
    {
        const std::string what = error.what();
        const std::size_t open = what.find('\''), close = what.rfind('\'');
        const std::size_t at = open < close ? text.find(what.substr(open + 1, close - open - 1)) : 0;
        throw Error(ErrorCode::bad_input, file + ": " + place(text, at) + ": " + reason(what) +
                                              "; numbers must be at most 1e30 in magnitude");
    }
}

std::vector<std::string> keys_of(const json& tree, const char* name)
{
    std::vector<std::string> keys;
    if (tree.is_object() && tree.contains(name) && tree[name].is_object())
        for (const auto& [key, value] : tree[name].items())
            keys.push_back(key);
    return keys;
}

} // namespace taut::scene_file
