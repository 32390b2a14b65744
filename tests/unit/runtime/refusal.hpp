#pragma once
// Catches the taut::Error of an action, for tests that look at its code and its words.

#include "taut/runtime/base/error.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace taut::test {

/// The error of `act`; none: a text that matches nothing.
struct Refusal
{
    std::optional<ErrorCode> code;
    std::string text;
    bool says(std::string_view words) const { return text.find(words) != std::string::npos; }
};

inline Refusal refusal(const std::function<void()>& act)
{
    try
    {
        act();
    }
    catch (const Error& error)
    {
        return {error.code(), error.what()};
    }
    return {};
}

} // namespace taut::test
