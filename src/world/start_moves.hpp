#pragma once
// Moves of what crosses, or is too near, where a scene starts. Internal to separate_start.cpp.

#include "taut/world/start_shapes.hpp"
#include "taut/world/start_surfaces.hpp"

#include <span>
#include <vector>

namespace taut {

/// What hangs together by `lengths` goes as it is, where nothing of it is held (`inverse_mass` 0, 1/kg per
/// vertex), until no two such wholes cross or are too near at `x` (m). Returns false, with `x` as it was,
/// where that does not end.
bool part_whole(const StartSurfaces& surfaces, std::span<const double> inverse_mass,
                std::span<const StartLength> lengths, std::vector<glm::dvec3>& x);

/// How long single vertices go on.
struct StartRounds
{
    std::uint32_t most = 2000;    ///< for what crosses still
    std::uint32_t patience = 400; ///< without fewer crossings than ever before
    std::uint32_t finish = 300;   ///< after that, for what is only too near, and for lengths
};

/// Every vertex that is not held goes, and lengths are kept as well as they can be. Returns false where
/// something crosses still; what is too near may be left.
bool part_vertices(const StartSurfaces& surfaces, std::vector<double> inverse_mass,
                   std::vector<StartLength> lengths, std::vector<glm::dvec3>& x,
                   const StartRounds& rounds = {});

} // namespace taut
