#pragma once
// Methods by number, and sets of them: rows of keys and of effects say so who reads them.

#include "taut/scene/scene.hpp"

#include <cstdint>

namespace taut {

/// In the order of kMethodNames.
enum class MethodKind
{
    mass_spring,
    implicit_euler,
    implicit_constraints,
    acad,
    pbd,
    xpbd,
    vbd
};

/// Sets of methods.
using MethodSet = std::uint32_t;
constexpr MethodSet only(MethodKind kind) { return MethodSet{1} << static_cast<unsigned>(kind); }
inline constexpr MethodSet kAllMethods = (MethodSet{1} << kMethodNames.size()) - 1;

} // namespace taut
