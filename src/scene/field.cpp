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

[[noreturn]] void list(std::vector<SceneIssue>& issues, std::string path, std::string text)
{
    issues.push_back({true, std::move(path), std::move(text)});
    if (issues.size() > kMostIssues)
        throw ListFull();
    throw Listed();
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
      base_(std::make_shared<const std::string>(std::move(path))),
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
    const std::string here = path();
    if (issues_)
        list(*issues_, here, here.empty() ? "the scene " + text : text);
    throw Error(ErrorCode::bad_input, *file_ + ": " + (here.empty() ? "the scene" : here) + " " + text);
}

void Field::fail_at(std::string_view key, const std::string& text, const std::string& listed) const
{
    if (issues_)
        list(*issues_, path_of(key), listed);
    fail(text);
}

std::string Field::path() const
{
    std::string out = *base_;
    if (index_ != kNoIndex)
        out += '[' + std::to_string(index_) + ']';
    if (!key_.empty())
        out += (out.empty() ? "" : ".") + std::string(key_);
    return out;
}

std::string Field::path_of(std::string_view key) const
{
    const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '$'; };
    if (key.empty() || key.size() > 60 || !std::all_of(key.begin(), key.end(), plain))
        return path() + '[' + shown_value(std::string(key)) + ']'; // what a file may have for a key
    const std::string here = path();
    return (here.empty() ? "" : here + ".") + std::string(key);
}

void Field::refuse(const std::string& right) const { fail("is " + shown_value(*value_) + "; " + right); }

const Field& Field::object(const Table& table)
{
    if (!value_->is_object())
        refuse("it must be an object with the keys " + listing(names(table)));
    for (const auto& item : value_->items())
    {
        if (table.find(item.key()))
            continue;
        const std::vector<std::string_view> known = names(table);
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
    Field out = *this;
    out.value_ = &*member;
    out.table_ = nullptr;
    if (!key_.empty())
    {
        out.base_ = std::make_shared<const std::string>(path());
        out.index_ = kNoIndex;
    }
    out.key_ = key;
    return out;
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
    Field element = *this;
    element.table_ = nullptr;
    if (index_ != kNoIndex || !key_.empty())
        element.base_ = std::make_shared<const std::string>(path());
    element.key_ = {};
    std::vector<Field> out;
    out.reserve(value_->size());
    for (std::size_t i = 0; i < value_->size(); ++i)
    {
        element.value_ = &(*value_)[i];
        element.index_ = i;
        out.push_back(element);
    }
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
