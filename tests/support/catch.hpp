#pragma once
// Catch2 2 and 3 under one include: Approx, and Contains(text) for a text that has another in it. Options of
// scenes are shown by their words.

#include "taut/scene/options.hpp"

#include <ostream>

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
inline auto Contains(const std::string& part) { return Catch::Matchers::ContainsSubstring(part); }
#else
#include <catch2/catch.hpp> // declares ::Approx itself
using Catch::Matchers::Contains;
#endif

namespace taut {

template <Option E>
std::ostream& operator<<(std::ostream& out, E value)
{
    return out << to_string(value);
}

} // namespace taut
