#include "taut/scene/checker.hpp"

#include "taut/scene/keys.hpp"

#include <algorithm>
#include <cmath>

namespace taut::scene_file {

std::string shown(const glm::dvec3& value)
{
    return '[' + shown(value.x) + ", " + shown(value.y) + ", " + shown(value.z) + ']';
}

std::string Checker::join(std::string_view member) const
{
    if (member.empty())
        return path_;
    return path_.empty() ? std::string(member) : path_ + '.' + std::string(member);
}

Checker Checker::at(std::string_view member) const { return {issues_, join(member)}; }

Checker Checker::at(std::string_view member, std::size_t index) const
{
    return {issues_, join(member) + '[' + std::to_string(index) + ']'};
}

void Checker::error(std::string_view member, const std::string& text, ErrorCode code) const
{
    issues_.push_back({true, join(member), text, code});
}

void Checker::warning(std::string_view member, const std::string& text) const
{
    issues_.push_back({false, join(member), text, ErrorCode::bad_input});
}

bool Checker::finite(std::string_view member, double value, std::string_view unit) const
{
    if (std::abs(value) <= kMaxValue)
        return true;
    error(member, "is " + shown(value) + "; it must be finite, at most 1e30 in magnitude" +
                      (unit.empty() ? "" : " (" + std::string(unit) + ")"));
    return false;
}

bool Checker::finite(std::string_view member, const glm::dvec3& value, std::string_view unit) const
{
    if (std::abs(value.x) <= kMaxValue && std::abs(value.y) <= kMaxValue && std::abs(value.z) <= kMaxValue)
        return true;
    error(member, "is " + shown(value) + "; each number must be finite, at most 1e30 in magnitude (" +
                      std::string(unit) + ")");
    return false;
}

void Checker::positive(std::string_view member, double value, std::string_view unit) const
{
    if (finite(member, value, unit) && !(value > 0))
        error(member, "is " + shown(value) + "; it must be greater than 0" +
                          (unit.empty() ? "" : " " + std::string(unit)));
}

void Checker::not_negative(std::string_view member, double value, std::string_view unit) const
{
    if (finite(member, value, unit) && value < 0)
        error(member, "is " + shown(value) + "; it must be 0 or more " + std::string(unit));
}

void Checker::range(std::string_view member, std::uint32_t value, std::uint32_t low, std::uint32_t high) const
{
    if (value < low || value > high)
        error(member, "is " + std::to_string(value) + "; it must be from " + std::to_string(low) + " to " +
                          std::to_string(high));
}

void Checker::word(std::string_view member, const std::string& value,
                   std::span<const std::string_view> known) const
{
    if (std::find(known.begin(), known.end(), value) != known.end())
        return;
    const std::string close = nearest(value, known);
    error(member, "is \"" + value.substr(0, 60) + "\"; it must be " + listing(known) +
                      (close.empty() || known.size() == 1 ? "" : " (did you mean \"" + close + "\"?)"));
}

} // namespace taut::scene_file
