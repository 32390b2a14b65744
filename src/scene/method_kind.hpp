#pragma once
// Sets of methods: rows of keys and of effects say so who reads them.

#include "taut/scene/options.hpp"

#include <cstdint>

namespace taut {

/// Sets of methods.
using MethodSet = std::uint32_t;
constexpr MethodSet only(MethodKind kind) { return MethodSet{1} << static_cast<unsigned>(kind); }
inline constexpr MethodSet kAllMethods = (MethodSet{1} << kWords<MethodKind>.size()) - 1;

} // namespace taut
