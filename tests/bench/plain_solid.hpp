#pragma once
// The rival for whole steps of solids: XPBD springs and volumes by colours as a programmer would write it
// with OpenMP, no library.

#include "plain.hpp"

#include <vector>

namespace plain {

struct Tetrahedron
{
    std::uint32_t a, b, c, d;
    float rest_volume, compliance;
};

/// A solid that hangs: as plain::Cloth, and a sweep over its tetrahedra after that over its springs.
class Solid
{
public:
    Solid(std::vector<Vec4> position, std::vector<Constraint> springs,
          std::vector<std::uint32_t> spring_colours, std::vector<Tetrahedron> tetrahedra,
          std::vector<std::uint32_t> tetrahedron_colours);

    void step(float seconds, int substeps, float gravity_y);
    const std::vector<Vec4>& position() const { return position_; }

private:
    std::vector<Vec4> position_, before_, velocity_;
    std::vector<Constraint> springs_;
    std::vector<std::uint32_t> spring_colours_;
    std::vector<Tetrahedron> tetrahedra_;
    std::vector<std::uint32_t> tetrahedron_colours_;
};

} // namespace plain
