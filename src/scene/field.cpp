#include "taut/scene/field.hpp"

#include "taut/runtime/base/error.hpp"
#include "taut/scene/keys.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace taut::scene_file {

namespace {

/// A value as a message shows it: its text, cut short.
std::string shown(const nlohmann::json& value)
{
    if (value.is_object())
        return "an object";
    if (value.is_array())
        return "a list of " + std::to_string(value.size());
    const std::string text = value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
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

void Field::refuse(const std::string& right) const { fail("is " + shown(*value_) + "; " + right); }

const Field& Field::object(std::string_view kind)
{
    const KeySet& known = keys_of(kind);
    if (!value_->is_object())
        refuse("it must be an object with the keys " + listing(known.keys));
    for (const auto& item : value_->items())
    {
        if (std::find(known.keys.begin(), known.keys.end(), item.key()) != known.keys.end())
            continue;
        const std::string_view hint = meant(kind, item.key());
        const std::string close = nearest(item.key(), known.keys);
        const std::string right = !hint.empty()   ? std::string(hint)
                                  : close.empty() ? "it may have " + listing(known.keys)
                                                  : "did you mean \"" + close + "\"?";
        attempt([&] { fail("has the unknown key " + shown(item.key()) + "; " + right); });
    }
    kind_ = known.object;
    return *this;
}

std::optional<Field> Field::find(std::string_view key) const
{
    // A key that is read but not in the table would be refused in every file: a fault of ours.
    assert(std::count(keys_of(kind_).keys.begin(), keys_of(kind_).keys.end(), key) == 1);
    const auto member = value_->find(std::string(key));
    if (member == value_->end())
        return std::nullopt;
    return Field(*member, *file_, (path_.empty() ? "" : path_ + ".") + std::string(key), issues_);
}

Field Field::need(std::string_view key) const
{
    if (const auto member = find(key))
        return *member;
    fail("lacks the key \"" + std::string(key) + "\"");
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

void Field::read(std::string_view key, double& out) const
{
    if (const auto member = find(key))
        attempt([&] { out = member->number(); });
}

void Field::read(std::string_view key, std::uint32_t& out) const
{
    if (const auto member = find(key))
        attempt([&] { out = member->count(); });
}

void Field::read(std::string_view key, bool& out) const
{
    if (const auto member = find(key))
        attempt([&] { out = member->boolean(); });
}

void Field::read(std::string_view key, std::string& out) const
{
    if (const auto member = find(key))
        attempt([&] { out = member->text(); });
}

void Field::read(std::string_view key, glm::dvec3& out) const
{
    if (const auto member = find(key))
        attempt([&] { out = member->vector(); });
}

} // namespace taut::scene_file
