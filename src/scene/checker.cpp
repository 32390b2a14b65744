#include "taut/scene/checker.hpp"

#include "taut/scene/keys.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace taut::scene_file {

std::string shown(const glm::dvec3& value)
{
    return '[' + shown(value.x) + ", " + shown(value.y) + ", " + shown(value.z) + ']';
}

std::string Checker::join(std::string_view member) const
{
    std::string out;
    const auto append = [&](std::string_view name) {
        if (!name.empty())
            (out += out.empty() ? "" : ".") += name;
    };
    for (std::size_t k = 0; k < depth_; ++k)
    {
        append(path_[k].member);
        if (path_[k].index != kNoIndex)
            out += '[' + std::to_string(path_[k].index) + ']';
    }
    append(member);
    return out;
}

Checker Checker::at(std::string_view member, std::size_t index) const
{
    Checker out = *this;
    assert(out.depth_ < out.path_.size());
    out.path_[out.depth_++] = {member, index};
    return out;
}

void Checker::error(std::string_view member, const std::string& text, ErrorCode code) const
{
    issues_.push_back({true, join(member), text, code});
}

void Checker::warning(std::string_view member, const std::string& text) const
{
    issues_.push_back({false, join(member), text, ErrorCode::bad_input});
}

namespace {

/// " (N/m)", or the note that a number without a unit has.
std::string in_brackets(std::string_view unit)
{
    if (unit.empty())
        return {};
    return unit.starts_with('(') ? ' ' + std::string(unit) : " (" + std::string(unit) + ')';
}

} // namespace

bool Checker::finite(std::string_view member, double value, std::string_view unit, ErrorCode code) const
{
    if (std::abs(value) <= kMaxValue)
        return true;
    error(member, "is " + shown(value) + "; it must be finite, at most 1e30 in magnitude" + in_brackets(unit),
          code);
    return false;
}

bool Checker::finite(std::string_view member, const glm::dvec3& value, std::string_view unit) const
{
    if (std::abs(value.x) <= kMaxValue && std::abs(value.y) <= kMaxValue && std::abs(value.z) <= kMaxValue)
        return true;
    error(member, "is " + shown(value) + "; each number must be finite, at most 1e30 in magnitude" +
                      in_brackets(unit));
    return false;
}

void Checker::word(std::string_view member, const std::string& value,
                   std::span<const std::string_view> known) const
{
    if (std::find(known.begin(), known.end(), value) != known.end())
        return;
    error(member, unknown_word(value, known));
}

} // namespace taut::scene_file
