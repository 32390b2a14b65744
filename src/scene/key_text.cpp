#include "taut/scene/key_text.hpp"

#include "taut/runtime/base/shown.hpp"

#include <charconv>
#include <cmath>
#include <optional>

namespace taut::scene_file {
namespace {

using Json = nlohmann::ordered_json;

/// Without an exponent where that is not long: 100000, 0.00001.
std::string plain(double value)
{
    if (value != 0 && (std::abs(value) < 1e-6 || std::abs(value) >= 1e10))
        return shown(value);
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed).ptr;
    return {text, end};
}

std::string plain(const Json& value)
{
    if (value.is_string())
        return '"' + value.get<std::string>() + '"';
    if (value.is_number_float())
        return plain(value.get<double>());
    if (!value.is_array())
        return value.dump();
    std::string out;
    for (const Json& part : value)
        out += (out.empty() ? "[" : ", ") + plain(part);
    return out + ']';
}

template <class Vector>
Json parts_of(const Vector& vector)
{
    Json out = Json::array();
    for (int i = 0; i < Vector::length(); ++i)
        out.push_back(vector[i]);
    return out;
}

template <class T>
Json with_word(const Key& key, T value)
{
    if (!key.word.empty() && double(value) == key.word_value)
        return key.word;
    return value;
}

template <class T>
Json or_word(const Key& key, const std::optional<T>& value)
{
    return value ? Json(*value) : key.word.empty() ? Json() : Json(key.word);
}

std::string range_of_numbers(const Key& key)
{
    const Limits& limits = key.limits;
    const bool low = limits.has_low(), high = limits.has_high() && limits.high < kMaxCount;
    if (low && high && !limits.above && !limits.below)
        return plain(limits.low) == plain(limits.high) ? plain(limits.low)
                                                       : plain(limits.low) + " to " + plain(limits.high);
    std::string out;
    if (low)
        out = limits.above ? "above " + plain(limits.low) : plain(limits.low) + " or more";
    if (high)
        out += (out.empty() ? "" : ", ") + std::string(limits.below ? "below " : "to ") + plain(limits.high);
    return out.empty() ? "finite" : out;
}

std::string range_of_words(const Key& key)
{
    std::string out;
    for (const WordSet& set : key.word_sets)
    {
        std::string words;
        for (const std::string_view word : set.words)
            words += (words.empty() ? "\"" : ", \"") + std::string(word) + '"';
        out += (out.empty() || words.empty() ? "" : "; ") +
               (set.of.empty() ? "" : std::string(set.of) + ": ") + words;
    }
    return out;
}

std::string a(std::string_view name)
{
    const bool vowel = !name.empty() && std::string_view("aeiou").find(name[0]) != std::string_view::npos;
    return (vowel ? "an `" : "a `") + std::string(name) + '`';
}

} // namespace

std::string_view unit_of(const Key& key)
{
    return key.unit_text.starts_with('(') ? std::string_view() : key.unit_text;
}

std::string with_unit(double value, const Key& key)
{
    const std::string unit(unit_of(key));
    if (unit.empty())
        return shown(value);
    return shown(value) + (unit.starts_with("1/") ? " per " + unit.substr(2) : ' ' + unit);
}

std::string low_text(const Key& key)
{
    const std::string_view unit = unit_of(key);
    const std::string note = unit.empty() && !key.unit_text.empty() ? ' ' + std::string(key.unit_text) : "";
    if (key.limits.above)
        return "greater than " + with_unit(key.limits.low, key) + note;
    return with_unit(key.limits.low, key) + " or more" + note;
}

std::string limits_text(const Key& key)
{
    std::string out = key.limits.has_low() ? low_text(key) : "";
    if (key.limits.has_high())
        out += (out.empty() ? "" : " and ") + std::string(key.limits.below ? "less than " : "at most ") +
               with_unit(key.limits.high, key);
    return out + (key.reason.empty() ? "" : " (" + std::string(key.reason) + ')');
}

std::string count_text(const Key& key)
{
    const std::string low = shown(key.limits.low);
    return key.limits.high == kMaxCount ? low + " or more"
                                        : "from " + low + " to " + shown(key.limits.high, 10);
}

nlohmann::ordered_json value_of(const Key& key, const void* object)
{
    if (!key.at)
        return nullptr;
    const void* member = key.at(const_cast<void*>(object)); // only finds it
    switch (key.kind)
    {
    case Kind::number: return with_word(key, member_as<double>(member));
    case Kind::count: return with_word(key, member_as<std::uint32_t>(member));
    case Kind::maybe_number: return or_word(key, member_as<std::optional<double>>(member));
    case Kind::maybe_count: return or_word(key, member_as<std::optional<std::uint32_t>>(member));
    case Kind::version: return member_as<int>(member);
    case Kind::boolean: return member_as<bool>(member);
    case Kind::text: return member_as<std::string>(member);
    case Kind::option:
    {
        const std::size_t place = key.option.get(member);
        return place < key.word_sets[0].words.size() ? Json(key.word_sets[0].words[place]) : Json();
    }
    case Kind::file: return member_as<std::filesystem::path>(member).string();
    case Kind::vector: return parts_of(member_as<glm::dvec3>(member));
    case Kind::number_pair: return parts_of(member_as<glm::dvec2>(member));
    case Kind::count_pair: return parts_of(member_as<glm::uvec2>(member));
    case Kind::count_triple: return parts_of(member_as<glm::uvec3>(member));
    default: return nullptr;
    }
}

std::string default_text(const Key& key, const void* defaults)
{
    if (!key.default_text.empty())
        return std::string(key.default_text);
    if (key.is_needed)
        return "needed";
    if (key.kind == Kind::ignored || key.kind == Kind::file)
        return "none";
    const Json value = value_of(key, defaults);
    return value.is_null() ? "none" : plain(value);
}

std::string range_text(const Key& key)
{
    if (!key.range_text.empty())
        return std::string(key.range_text);
    if (key.kind == Kind::object)
        return a(key.table->name) +
               (key.solid_table ? ", of solids " + a(key.solid_table->name) : std::string());
    if (key.kind == Kind::objects)
        return "list of `" + std::string(key.table->name) + '`';
    if (key.kind == Kind::boolean)
        return "true, false";
    if (key.is_direction)
        return "not [0, 0, 0]";
    if (key.is_ascending)
        return "ascending from key to key";
    if (!key.word_sets[0].words.empty())
        return range_of_words(key);
    if (key.kind == Kind::file)
        return "a text";
    if (key.kind == Kind::text || key.kind == Kind::ignored)
        return "any text";
    return range_of_numbers(key) + (key.word.empty() ? "" : ", or \"" + std::string(key.word) + '"');
}

std::shared_ptr<void> defaults_of(const Table& table)
{
    std::shared_ptr<void> out = table.make();
    if (table.begin)
        table.begin(out.get());
    return out;
}

} // namespace taut::scene_file
