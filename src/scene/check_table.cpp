#include "taut/scene/check_table.hpp"

#include "taut/scene/key_text.hpp"
#include "taut/scene/keys.hpp"

#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace taut::scene_file {
namespace {

/// Values that a file cannot say, and that stand for something in the struct.
bool stands_for_something(const Key& key, double value)
{
    if (key.has_unset && value == key.unset)
        return true;
    const bool optional = key.kind == Kind::maybe_number || key.kind == Kind::maybe_count;
    return !optional && !key.word.empty() && value == key.word_value;
}

/// The word that may stand in place of a number.
std::string or_word(const Key& key)
{
    return key.word.empty() ? "" : ", or \"" + std::string(key.word) + '"';
}

void check_number(const Key& key, std::string_view member, double value, const Checker& out)
{
    if (stands_for_something(key, value) || !out.finite(member, value, key.unit_text, key.error))
        return;
    if (!key.limits.contains(value))
        out.error(member, "is " + with_unit(value, key) + "; it must be " + limits_text(key) + or_word(key),
                  key.error);
}

void check_count(const Key& key, std::uint32_t value, const Checker& out)
{
    if (stands_for_something(key, value) || key.limits.contains(value))
        return;
    out.error(key.name, "is " + std::to_string(value) + "; it must be " + count_text(key) + or_word(key));
}

/// Numbers of one key: each within its limits.
template <class Vector>
void check_parts(const Key& key, const Vector& value, const Checker& out)
{
    bool good = true;
    for (int i = 0; i < Vector::length(); ++i)
        good = good && key.limits.contains(value[i]);
    if (good)
        return;
    std::string whole;
    for (int i = 0; i < Vector::length(); ++i)
        whole += (i == 0 ? "[" : ", ") + shown(value[i]);
    Key low = key;
    if (key.limits.high >= kMaxCount)
        low.limits.high = kMaxValue;
    out.error(key.name, "is " + whole + "]; " + (Vector::length() == 2 ? "both" : "each") + " must be " +
                            limits_text(low) + (low.limits.has_high() ? "" : ", and finite"));
}

void check_vector(const Key& key, std::string_view member, const glm::dvec3& value, const Checker& out)
{
    const bool finite = out.finite(member, value, key.is_direction ? "any length but 0" : unit_of(key));
    if (finite && key.is_direction && !(glm::length(value) > 0))
        out.error(member, "is " + shown(value) + "; it must have a direction, for example [0, 1, 0]");
    if (finite && key.limits.has_low())
        check_parts(key, value, out);
}

void check_objects(const Key& key, const void* list, const Checker& out)
{
    const Key* time = nullptr;
    for (const Key& k : key.table->keys)
        if (k.is_ascending && out.scope() != Scope::keys)
            time = &k;
    const auto at = [&](const void* element) {
        return member_as<double>(time->at(const_cast<void*>(element)));
    };
    for (std::size_t i = 0; i < key.access.size(list); ++i)
    {
        const void* element = key.access.element(list, i);
        const Checker each = out.at(key.name, i);
        check_table(*key.table, element, each);
        if (!time || i == 0 || !(std::abs(at(element)) <= kMaxValue))
            continue;
        const double last = at(key.access.element(list, i - 1));
        if (!(at(element) > last))
            each.error(time->name, "is " + shown(at(element)) + " s, and the key before it stands at " +
                                       shown(last) + " s; times must ascend");
    }
}

/// A file cannot say what is none of the words, a program can.
void check_option(const Key& key, const void* member, const Checker& out)
{
    const std::size_t place = key.option.get(member);
    if (place >= key.word_sets[0].words.size())
        out.error(key.name,
                  "is value " + std::to_string(place) + "; it must be " + listing(key.word_sets[0].words));
}

void check_key(const Key& key, const void* object, const Checker& out)
{
    if ((key.present && !key.present(object)) || (key.is_source && out.scope() == Scope::meshes) || !key.at)
        return;
    const void* member = key.at(const_cast<void*>(object)); // only finds it
    switch (key.kind)
    {
    case Kind::number: return check_number(key, key.name, member_as<double>(member), out);
    case Kind::count: return check_count(key, member_as<std::uint32_t>(member), out);
    case Kind::maybe_number:
        if (const auto& value = member_as<std::optional<double>>(member))
            check_number(key, key.name, *value, out);
        return;
    case Kind::maybe_count:
        if (const auto& value = member_as<std::optional<std::uint32_t>>(member))
            check_count(key, *value, out);
        return;
    case Kind::option: return check_option(key, member, out);
    case Kind::vector: return check_vector(key, key.name, member_as<glm::dvec3>(member), out);
    case Kind::number_pair: return check_parts(key, member_as<glm::dvec2>(member), out);
    case Kind::count_pair: return check_parts(key, member_as<glm::uvec2>(member), out);
    case Kind::count_triple: return check_parts(key, member_as<glm::uvec3>(member), out);
    case Kind::numbers: // an element that could not be read has left its place to the next
        if (out.scope() == Scope::keys)
            return;
        for (std::size_t i = 0; i < member_as<std::vector<double>>(member).size(); ++i)
            check_number(key, "", member_as<std::vector<double>>(member)[i], out.at(key.name, i));
        return;
    case Kind::vectors:
        if (out.scope() == Scope::keys)
            return;
        for (std::size_t i = 0; i < member_as<std::vector<glm::dvec3>>(member).size(); ++i)
            check_vector(key, "", member_as<std::vector<glm::dvec3>>(member)[i], out.at(key.name, i));
        return;
    case Kind::object:
    {
        const bool solid = key.solids && key.solids(object);
        return check_table(solid ? *key.solid_table : *key.table, member, out.at(key.name));
    }
    case Kind::objects: return check_objects(key, member, out);
    case Kind::version:
    case Kind::boolean:
    case Kind::text:
    case Kind::file:
    case Kind::counts:
    case Kind::texts:
    case Kind::ignored: return; // the tables' own checks look at these
    }
}

} // namespace

void check_table(const Table& table, const void* object, const Checker& out)
{
    for (const Key& key : table.keys)
        check_key(key, object, out);
    if (table.check && out.scope() != Scope::keys)
        table.check(object, out);
}

} // namespace taut::scene_file
