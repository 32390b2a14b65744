#pragma once
// Rows in words: for messages, for the pages and for the schema.

#include "taut/scene/descriptor.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace taut::scene_file {

/// A member of a struct, from its place.
template <class T>
const T& member_as(const void* member)
{
    return *static_cast<const T*>(member);
}

/// "N/m", or nothing where the number has no unit.
std::string_view unit_of(const Key& key);

/// "3 N/m", "2 per s", "0.5"
std::string with_unit(double value, const Key& key);

/// What a number must be: "0 N/m or more", "greater than 0 s and at most 1 s".
std::string low_text(const Key& key);
std::string limits_text(const Key& key);

/// What a count must be: "1 or more", "from 1 to 1000".
std::string count_text(const Key& key);

/// Columns of the pages' tables.
std::string default_text(const Key& key, const void* defaults);
std::string range_text(const Key& key);

/// A member as a scene file has it, numbers that a word stands for by the word. Null for objects.
nlohmann::ordered_json value_of(const Key& key, const void* object);

/// A struct as a file leaves it that has none of the table's keys.
std::shared_ptr<void> defaults_of(const Table& table);

} // namespace taut::scene_file
