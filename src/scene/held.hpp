#pragma once
// Which vertices of a body its pins hold.

#include "taut/scene/scene.hpp"

#include <vector>

namespace taut {

/// A flag for each vertex of the mesh of a resolved body; led ones are held, too.
inline std::vector<bool> held_vertices(const Body& body)
{
    std::vector<bool> held(body.mesh.positions.size(), false);
    for (const Pin& pin : body.pins)
        for (const std::uint32_t v : pin.vertices)
            held.at(v) = true;
    return held;
}

} // namespace taut
