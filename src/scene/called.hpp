#pragma once
// How sentences name an entry of one of the scene's lists.

#include <cstddef>
#include <string>

namespace taut {

/// bodies[2], or bodies[2] (sleeve) of one that has a name.
inline std::string called(const std::string& list, std::size_t number, const std::string& name)
{
    return list + "[" + std::to_string(number) + "]" + (name.empty() ? "" : " (" + name + ")");
}

} // namespace taut
