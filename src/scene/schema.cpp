#include "taut/scene/schema.hpp"

#include "taut/scene/key_text.hpp"
#include "taut/scene/tables.hpp"

#include <algorithm>
#include <cmath>

namespace taut::scene_file {
namespace {

using Json = nlohmann::ordered_json;

/// 4 and not 4.0, as one writes it.
Json tidy(const Json& value)
{
    if (value.is_number_float() && value == std::floor(value.get<double>()) &&
        std::abs(value.get<double>()) < 1e15)
        return static_cast<std::int64_t>(value.get<double>());
    if (!value.is_array())
        return value;
    Json out = Json::array();
    for (const Json& part : value)
        out.push_back(tidy(part));
    return out;
}

/// What a number of the key may be.
Json number_schema(const Key& key, bool whole)
{
    Json out = {{"type", whole ? "integer" : "number"}};
    out[key.limits.above ? "exclusiveMinimum" : "minimum"] = tidy(key.limits.low);
    out[key.limits.below ? "exclusiveMaximum" : "maximum"] = tidy(key.limits.high);
    return out;
}

Json list_schema(const Json& items, std::size_t length = 0)
{
    Json out = {{"type", "array"}, {"items", items}};
    if (length > 0)
        out["minItems"] = out["maxItems"] = length;
    return out;
}

Json text_schema(const Key& key)
{
    Json out = {{"type", "string"}};
    for (const WordSet& set : key.word_sets)
        for (const std::string_view word : set.words)
            if (std::find(out["enum"].begin(), out["enum"].end(), word) == out["enum"].end())
                out["enum"].push_back(word);
    if (key.kind == Kind::file)
        out["minLength"] = 1;
    return out;
}

Json reference(const Table& table)
{
    std::string name(table.name);
    std::replace(name.begin(), name.end(), ' ', '_');
    return {{"$ref", "#/$defs/" + name}};
}

Json or_word(const Json& number, const Key& key)
{
    if (key.word.empty())
        return number;
    return {{"anyOf", Json::array({number, {{"const", key.word}}})}};
}

/// Types and ranges of a value.
Json value_schema(const Key& key)
{
    switch (key.kind)
    {
    case Kind::number:
    case Kind::maybe_number: return or_word(number_schema(key, false), key);
    case Kind::count:
    case Kind::maybe_count: return or_word(number_schema(key, true), key);
    case Kind::version: return {{"const", tidy(key.limits.low)}};
    case Kind::boolean: return {{"type", "boolean"}};
    case Kind::text:
    case Kind::option:
    case Kind::file:
    case Kind::ignored: return text_schema(key);
    case Kind::vector: return list_schema(number_schema(key, false), 3);
    case Kind::number_pair: return list_schema(number_schema(key, false), 2);
    case Kind::count_pair: return list_schema(number_schema(key, true), 2);
    case Kind::count_triple: return list_schema(number_schema(key, true), 3);
    case Kind::counts: return list_schema(number_schema(key, true));
    case Kind::numbers: return list_schema(number_schema(key, false));
    case Kind::vectors: return list_schema(list_schema(number_schema(key, false), 3));
    case Kind::texts: return key.is_single ? text_schema(key) : list_schema(text_schema(key));
    case Kind::object: return key.solid_table ? Json::object() : reference(*key.table);
    case Kind::objects: return list_schema(reference(*key.table));
    }
    return Json::object();
}

/// The sentence without the links and marks of the pages.
std::string plain_text(std::string_view text)
{
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == ']' && text.substr(i + 1, 1) == "(")
            i = text.find(')', i);
        else if (text[i] != '`' && text[i] != '[')
            out += text[i];
    return out;
}

std::string description(const Key& key)
{
    std::string out = key.parts.empty() ? "" : std::string(key.parts) + ": ";
    out += plain_text(key.what);
    if (!unit_of(key).empty())
        out += " [" + std::string(unit_of(key)) + ']';
    std::string readers;
    for (std::size_t k = 0; key.readers != 0 && key.readers != kAllMethods && k < kWords<MethodKind>.size();
         ++k)
        if (key.readers & only(static_cast<MethodKind>(k)))
            readers +=
                (readers.empty() ? " (read by " : ", ") + std::string(to_string(static_cast<MethodKind>(k)));
    return out + (readers.empty() ? "" : readers + ')');
}

Json key_schema(const Key& key, const void* defaults)
{
    Json out = value_schema(key);
    out["description"] = description(key);
    const bool is_unset =
        key.has_unset || key.kind == Kind::version || key.kind == Kind::file || key.is_needed;
    const Json usual = is_unset ? Json() : tidy(value_of(key, defaults));
    if (!usual.is_null())
        out["default"] = usual;
    return out;
}

/// What else holds where a body has this choice: the keys of its material, and none that belong to another.
Json branch(const Table& table, const Key& chosen)
{
    Json out = {{"required", {chosen.name}}};
    for (const Key& key : table.keys)
    {
        if (key.solid_table)
            out["properties"][std::string(key.name)] =
                reference(chosen.is_solid ? *key.solid_table : *key.table);
        if (!key.beside.empty() && !(key.beside == "solids" ? chosen.is_solid : key.beside == chosen.name))
            out["properties"][std::string(key.name)] = false;
    }
    return out;
}

Json table_schema(const Table& table)
{
    const auto defaults = defaults_of(table);
    Json out = {{"type", "object"}, {"additionalProperties", false}};
    Json branches = Json::array();
    for (const Key& key : table.keys)
    {
        out["properties"][std::string(key.name)] = key_schema(key, defaults.get());
        if (key.is_needed)
            out["required"].push_back(key.name);
        if (key.is_choice)
            branches.push_back(branch(table, key));
    }
    if (table.choice != Choice::none)
        out[table.choice == Choice::exactly_one ? "oneOf" : "anyOf"] = branches;
    return out;
}

} // namespace

nlohmann::ordered_json scene_schema()
{
    Json out = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Scene of Taut"}};
    out.update(table_schema(kSceneTable));
    for (const Table* table : all_tables())
        if (table != &kSceneTable)
            out["$defs"][reference(*table)["$ref"].get<std::string>().substr(8)] = table_schema(*table);
    return out;
}

} // namespace taut::scene_file
