#pragma once
// The rival for whole steps of cloth: XPBD by colours as a programmer would write it with OpenMP, no library.

#include "plain.hpp"

#include <vector>

namespace plain {

/// Cloth that hangs: positions in float, one iteration a substep (no multipliers), colours in parallel loops.
class Cloth
{
public:
    /// position.w = inverse mass, 1/kg.
    Cloth(std::vector<Vec4> position, std::vector<Constraint> constraints,
          std::vector<std::uint32_t> colour_start);

    void step(float seconds, int substeps, float gravity_y);
    const std::vector<Vec4>& position() const { return position_; }

private:
    std::vector<Vec4> position_, before_, velocity_;
    std::vector<Constraint> constraints_;
    std::vector<std::uint32_t> colour_start_;
};

} // namespace plain
