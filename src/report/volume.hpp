#pragma once
// What bodies that enclose a volume keep of it.

#include "taut/scene/scene.hpp"

#include <cstdint>
#include <span>

namespace taut {

struct VolumeReport
{
    bool any = false;             ///< the scene has a body with a volume
    double ratio = 1;             ///< V / V0 of the body that is furthest from 1; V signed
    double least = 1;             ///< V / V0 of the body that has least of its own
    double worst_element = 0;     ///< largest |V - V0| / V0 of a tetrahedron
    std::uint64_t inverted = 0;   ///< tetrahedra with V <= 0
};

/// Bodies with tetrahedra, and closed cloth that holds its volume or a gas. `positions`: scene-wide, m.
VolumeReport measure_volume(const Scene& resolved, std::span<const glm::dvec3> positions);

} // namespace taut
