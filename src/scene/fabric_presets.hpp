#pragma once
// Measured fabrics by name (docs/fabric.md).

#include "taut/scene/fabric.hpp"

#include <span>
#include <string_view>

namespace taut {

struct FabricPreset
{
    std::string_view name;
    double density; ///< kg/m^2
    Fabric fabric;
    std::string_view source; ///< who measured it, and how its numbers were had
};

/// In the order in which they are listed.
std::span<const FabricPreset> fabric_presets();

/// Null for a name that is none of them.
const FabricPreset* find_fabric_preset(std::string_view name);

} // namespace taut
