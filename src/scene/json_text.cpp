#include "taut/scene/json_text.hpp"

#include "taut/runtime/base/error.hpp"

#include <algorithm>
#include <set>
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

/// Reads the text once before it is parsed, for what the parser does not tell: keys that stand twice, depth,
/// and where. (Its own callback looks through a list again after each of its entries.)
class Watcher final : public nlohmann::json_sax<json>
{
public:
    explicit Watcher(const std::string& file) : file_(file) {}

    bool null() override { return count(); }
    bool boolean(bool) override { return count(); }
    bool number_integer(number_integer_t) override { return count(); }
    bool number_unsigned(number_unsigned_t) override { return count(); }
    bool number_float(number_float_t, const string_t&) override { return count(); }
    bool string(string_t&) override { return count(); }
    bool binary(binary_t&) override { return count(); }
    bool start_object(std::size_t) override { return enter(false); }
    bool start_array(std::size_t) override { return enter(true); }
    bool end_object() override { return leave(); }
    bool end_array() override { return leave(); }
    /// Left to the parser, whose message it is.
    bool parse_error(std::size_t, const std::string&, const json::exception&) override { return false; }

    bool key(string_t& name) override
    {
        Level& level = levels_.back();
        if (!level.seen.insert(name).second)
        {
            levels_.pop_back();
            const std::string where = levels_.empty() ? "the scene" : path();
            throw Error(ErrorCode::bad_input, file_ + ": the key \"" + name + "\" stands twice in " + where +
                                                  "; keep one of the two");
        }
        level.key = name;
        return true;
    }

private:
    struct Level
    {
        bool array = false;
        std::size_t elements = 0;
        std::string key;
        std::set<std::string> seen;
    };

    bool count()
    {
        if (!levels_.empty())
            ++levels_.back().elements;
        return true;
    }

    bool enter(bool array)
    {
        count();
        if (levels_.size() > kMaxDepth)
            throw Error(ErrorCode::bad_input, file_ + ": " + path() + " is nested more than " +
                                                  std::to_string(kMaxDepth) +
                                                  " levels deep; a scene needs 8");
        levels_.push_back({array, 0, {}, {}});
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
            if (level.array)
                out += '[' + std::to_string(level.elements == 0 ? 0 : level.elements - 1) + ']';
            else
                out += (out.empty() ? "" : ".") + level.key;
        return out;
    }

    std::string file_;
    std::vector<Level> levels_;
};

} // namespace

json parse_json(std::string_view text, const std::string& file)
{
    try
    {
        Watcher watcher(file);
        json::sax_parse(text.begin(), text.end(), &watcher);
        return json::parse(text.begin(), text.end());
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
