#include "taut/scene/field.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/descriptor.hpp"
#include "taut/scene/keys.hpp"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>

namespace taut::scene_file {

namespace {

/// A value as a message shows it: its text, cut short.
std::string shown_value(const nlohmann::json& value)
{
    if (value.is_object())
        return "an object";
    if (value.is_array())
        return "a list of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

/// What to say to one who writes a key that means something elsewhere; empty if nothing is known.
std::string_view advice(const Table& table, std::string_view key)
{
    for (const Stranger& stranger : table.strangers)
        if (stranger.name == key)
            return stranger.advice;
    return {};
}

} // namespace

Field::Field(const nlohmann::json& value, const std::string& file, std::string path,
             std::vector<SceneIssue>* issues)
    : value_(&value),
      file_(&file),
      path_(std::move(path)),
      issues_(issues)
{}

void Field::attempt(const std::function<void()>& part)
{
    try
    {
        part();
    }
    catch (const Listed&)
    {}
}

void Field::fail(const std::string& text) const
{
    if (issues_)
    {
        issues_->push_back({true, path_, path_.empty() ? "the scene " + text : text});
        throw Listed();
    }
    throw Error(ErrorCode::bad_input, *file_ + ": " + (path_.empty() ? "the scene" : path_) + " " + text);
}

void Field::fail_at(std::string_view key, const std::string& text, const std::string& listed) const
{
    if (issues_)
    {
        issues_->push_back({true, path_of(key), listed});
        throw Listed();
    }
    fail(text);
}

std::string Field::path_of(std::string_view key) const
{
    const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '$'; };
    if (key.empty() || key.size() > 60 || !std::all_of(key.begin(), key.end(), plain))
        return path_ + '[' + shown_value(std::string(key)) + ']'; // what a file may have for a key
    return (path_.empty() ? "" : path_ + ".") + std::string(key);
}

void Field::refuse(const std::string& right) const { fail("is " + shown_value(*value_) + "; " + right); }

const Field& Field::object(const Table& table)
{
    const std::vector<std::string_view> known = names(table);
    if (!value_->is_object())
        refuse("it must be an object with the keys " + listing(known));
    for (const auto& item : value_->items())
    {
        if (table.find(item.key()))
            continue;
        const std::string_view hint = advice(table, item.key());
        const std::string close = nearest(item.key(), known);
        const auto right = [&](const char* all) {
            return !hint.empty()   ? std::string(hint)
                   : close.empty() ? all + listing(known)
                                   : "did you mean \"" + close + "\"?";
        };
        attempt([&] {
            fail_at(item.key(),
                    "has the unknown key " + shown_value(item.key()) + "; " + right("it may have "),
                    "is an unknown key; " + right("its object may have "));
        });
    }
    table_ = &table;
    return *this;
}

std::optional<Field> Field::find(std::string_view key) const
{
    // A key that is read but not in the table would be refused in every file: a fault of ours.
    assert(table_ && table_->find(key));
    const auto member = value_->find(std::string(key));
    if (member == value_->end())
        return std::nullopt;
    return Field(*member, *file_, path_of(key), issues_);
}

double Field::number() const
{
    if (!value_->is_number())
        refuse("it must be a number");
    return value_->get<double>();
}

std::uint32_t Field::count(std::string_view right) const
{
    const double number = value_->is_number() ? value_->get<double>() : -1;
    if (!(number >= 0 && number <= 4294967295.0 && number == std::floor(number)))
        refuse(right.empty() ? "it must be a whole number from 0 to 4294967295" : std::string(right));
    return static_cast<std::uint32_t>(number);
}

bool Field::boolean() const
{
    if (!value_->is_boolean())
        refuse("it must be true or false");
    return value_->get<bool>();
}

std::string Field::text() const
{
    if (!value_->is_string())
        refuse("it must be a text in quotes");
    return value_->get<std::string>();
}

std::vector<Field> Field::elements() const
{
    if (!value_->is_array())
        refuse("it must be a list [ ... ]");
    std::vector<Field> out;
    out.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i)
        out.emplace_back((*value_)[i], *file_, path_ + '[' + std::to_string(i) + ']', issues_);
    return out;
}

glm::dvec3 Field::vector() const
{
    if (!value_->is_array() || value_->size() != 3)
        refuse("it must be three numbers [x, y, z]");
    const std::vector<Field> part = elements();
    return {part[0].number(), part[1].number(), part[2].number()};
}

} // namespace taut::scene_file
