#include "taut/scene/read_table.hpp"

#include "taut/scene/key_text.hpp"
#include "taut/scene/keys.hpp"

#include <algorithm>
#include <optional>

namespace taut::scene_file {
namespace {

template <class T>
T& as(void* member)
{
    return *static_cast<T*>(member);
}

/// " in N/m"; " (of the rest distance)" where the number has no unit.
std::string in_unit(const Key& key)
{
    if (key.unit_text.empty())
        return {};
    return (unit_of(key).empty() ? " " : " in ") + std::string(key.unit_text);
}

bool is_word(const Field& value, const Key& key)
{
    return !key.word.empty() && value.is_text() && value.text() == key.word;
}

double read_number(const Field& value, const Key& key)
{
    if (key.word.empty())
        return value.number();
    if (is_word(value, key))
        return key.word_value;
    if (value.is_text())
        value.refuse("it must be a number" + in_unit(key) + " or \"" + std::string(key.word) + '"');
    const double number = value.number();
    if (key.limits.too_low(number)) // the message names the word, too
        value.refuse("it must be " + low_text(key) + ", or \"" + std::string(key.word) + '"');
    return number;
}

/// What a count must be; empty for a key without a range: what a uint32 can be.
std::string whole_number_text(const Key& key)
{
    if (!key.limits.has_low() || !key.limits.has_high())
        return "";
    const std::string_view before = key.limits.high == kMaxCount ? ", " : " ";
    return "it must be a whole number" + std::string(before) + count_text(key);
}

std::uint32_t read_count(const Field& value, const Key& key)
{
    std::string right = whole_number_text(key);
    if (key.word.empty())
        return value.count(right);
    right += ", or \"" + std::string(key.word) + '"';
    if (is_word(value, key))
        return static_cast<std::uint32_t>(key.word_value);
    const std::uint32_t count = value.count(right);
    if (key.limits.too_low(count))
        value.refuse(right); // as above
    return count;
}

/// The elements of a list of a fixed length.
std::vector<Field> read_parts(const Field& value, const Key& key, std::size_t count, std::string_view what)
{
    std::vector<Field> parts = value.elements();
    if (parts.size() != count)
        value.refuse("it must be " + std::string(count == 2 ? "two " : "three ") + std::string(what) + ' ' +
                     std::string(key.parts) + in_unit(key));
    return parts;
}

template <class Vector>
void read_counts(const Field& value, const Key& key, Vector& out)
{
    const auto parts = read_parts(value, key, std::size_t(Vector::length()), "whole numbers");
    for (std::size_t i = 0; i < parts.size(); ++i)
        out[int(i)] = parts[i].count(whole_number_text(key));
}

void read_texts(const Field& value, const Key& key, std::vector<std::string>& out)
{
    if (key.is_single)
        out.push_back(value.text());
    else
        value.each([&](const Field& text) { out.push_back(text.text()); });
}

/// An element that cannot be read keeps its place, so that the next ones have the numbers of the file.
void read_objects(const Field& value, const Key& key, void* list)
{
    value.each([&](const Field& element) { read_table(element, *key.table, key.access.append(list)); });
}

void read_option(const Field& value, const Key& key, void* member)
{
    const std::span<const std::string_view> words = key.word_sets[0].words;
    const std::string word = value.text();
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end())
        value.fail(unknown_word(word, words));
    key.option.set(member, static_cast<std::size_t>(found - words.begin()));
}

void read_value(const Field& value, const Key& key, void* member)
{
    switch (key.kind)
    {
    case Kind::number: as<double>(member) = read_number(value, key); return;
    case Kind::count: as<std::uint32_t>(member) = read_count(value, key); return;
    case Kind::maybe_number:
        as<std::optional<double>>(member) =
            is_word(value, key) ? std::nullopt : std::optional(read_number(value, key));
        return;
    case Kind::maybe_count:
        as<std::optional<std::uint32_t>>(member) =
            is_word(value, key) ? std::nullopt : std::optional(read_count(value, key));
        return;
    case Kind::version: as<int>(member) = static_cast<int>(value.count()); return;
    case Kind::boolean: as<bool>(member) = value.boolean(); return;
    case Kind::text: as<std::string>(member) = value.text(); return;
    case Kind::option: return read_option(value, key, member);
    case Kind::file: as<std::filesystem::path>(member) = value.text(); return;
    case Kind::vector: as<glm::dvec3>(member) = value.vector(); return;
    case Kind::number_pair:
    {
        const auto parts = read_parts(value, key, 2, "numbers");
        as<glm::dvec2>(member) = {parts[0].number(), parts[1].number()};
        return;
    }
    case Kind::count_pair: return read_counts(value, key, as<glm::uvec2>(member));
    case Kind::count_triple: return read_counts(value, key, as<glm::uvec3>(member));
    case Kind::counts:
        return value.each(
            [&](const Field& v) { as<std::vector<std::uint32_t>>(member).push_back(v.count()); });
    case Kind::numbers:
        return value.each([&](const Field& v) { as<std::vector<double>>(member).push_back(v.number()); });
    case Kind::vectors:
        return value.each([&](const Field& v) { as<std::vector<glm::dvec3>>(member).push_back(v.vector()); });
    case Kind::texts: return read_texts(value, key, as<std::vector<std::string>>(member));
    case Kind::object: read_table(value, *key.table, member); return;
    case Kind::objects: return read_objects(value, key, member);
    case Kind::ignored: value.text(); return;
    }
}

/// The choices that the object has; refuses a number of them that the table does not allow.
std::vector<const Key*> choose(const Field& field, const Table& table)
{
    std::vector<const Key*> chosen;
    if (std::none_of(table.keys.begin(), table.keys.end(), [](const Key& key) { return key.is_choice; }))
        return chosen;
    std::vector<std::string_view> all;
    for (const Key& key : table.keys)
    {
        if (!key.is_choice)
            continue;
        all.push_back(key.name);
        if (field.find(key.name))
            chosen.push_back(&key);
    }
    if (table.choice != Choice::exactly_one)
        return chosen; // what names nothing is told with what names an empty list, by check()
    if (chosen.size() > 1)
        field.fail("has both \"" + std::string(chosen[0]->name) + "\" and \"" + std::string(chosen[1]->name) +
                   "\"; keep one");
    if (chosen.empty())
        field.fail("needs one of " + listing(all));
    return chosen;
}

void read_key(const Field& field, const Key& key, const std::vector<const Key*>& chosen, void* object)
{
    const auto value = field.find(key.name);
    if (!value && key.is_needed)
    {
        const std::string right = key.advice.empty() ? "" : "; " + std::string(key.advice);
        field.fail_at(key.name, "lacks the key \"" + std::string(key.name) + '"' + right,
                      "is missing" + right);
    }
    if (key.own)
        return key.own(field, object);
    if (!value)
        return;
    if (const auto* table_choice = chosen.empty() ? nullptr : chosen[0];
        table_choice && !key.beside.empty() && key.beside != table_choice->name)
        value->fail("stands beside \"" + std::string(table_choice->name) + "\"; it belongs to \"" +
                    std::string(key.beside) + "\" only");
    if (key.begin)
        key.begin(object);
    read_value(*value, key, key.at ? key.at(object) : nullptr);
}

} // namespace

Field read_table(Field field, const Table& table, void* object)
{
    field.object(table);
    if (table.begin)
        table.begin(object);
    const auto chosen = choose(field, table);
    for (const Key& key : table.keys)
        Field::attempt([&] { read_key(field, key, chosen, object); });
    return field;
}

} // namespace taut::scene_file
