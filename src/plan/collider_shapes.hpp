#pragma once
// The table of collider shapes: what a plan holds of each, and what is written into it before a step.

#include "taut/runtime/base/kernel_info.hpp"
#include "taut/scene/scene.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace taut {

/// One row a ColliderKind.
struct ColliderShape
{
    using Records = std::vector<std::byte>;
    /// Appends the record of a collider between two times; of a shape with poses, at `from`. `first`: of its
    /// values among those of all.
    using Append = void (*)(Records& out, const Collider& collider, double from, double to,
                            std::uint32_t first);

    std::string_view name;   ///< as in scene files; the effect
    std::string_view kernel; ///< collide_<name>
    /// Shapes that turn have a record of the start of each substep in turn, and one of the end of the last;
    /// of others one record holds the whole time step.
    bool poses = false;
    bool values = false; ///< with a buffer of numbers, collider_values()
    std::uint32_t bytes_float = 0, bytes_double = 0; ///< of one record
    Append append_float = nullptr, append_double = nullptr;

    std::uint32_t copies(std::uint32_t substeps) const { return poses ? substeps + 1 : 1; }
    std::uint32_t bytes(Precision p) const { return p == Precision::float64 ? bytes_double : bytes_float; }
};

const ColliderShape& collider_shape(ColliderKind kind);

/// Of the values, read of a vertex that is far from the surface: at both ends of its way.
inline constexpr std::uint32_t kFarValues = 16;

std::uint32_t collider_count(const Scene& scene, ColliderKind kind);

/// The values of the distance fields of a resolved scene, one after the other, each once.
std::vector<float> collider_values(const Scene& scene);

/// The records of all colliders of a kind for the time step between two times, s.
ColliderShape::Records collider_records(const Scene& scene, ColliderKind kind, Precision precision,
                                        std::uint32_t substeps, double from, double to);

} // namespace taut
