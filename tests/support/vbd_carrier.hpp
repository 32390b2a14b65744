#pragma once
// What carries bodies in the tests of vertex block descent: the frames that vbd_frame leaves behind its sums.

#include "support/block_parts.hpp"

#include <glm/geometric.hpp>

namespace taut::conformance {

/// How what carries a body moves: by `way` at `place`, which is from the body's first row, turning about it.
struct Carrier
{
    bool carries = false;
    glm::dvec3 way{0}, place{0}, turn{0};

    glm::dvec3 way_at(const glm::dvec3& r) const { return way + glm::cross(turn, r - place); }
    /// Of the terms of that; r: the sizes of the two places.
    double size(double r) const { return glm::length(way) + glm::length(turn) * (r + glm::length(place)); }
};

/// Frames of all groups behind `sums`, alike in those of a body. Every other body of which nothing is held is
/// carried; what the frames of others say beside that counts for nothing.
template <typename Real>
std::vector<Carrier> add_frames(std::vector<Real>& sums, const BodyParts& parts, Random& random)
{
    const auto vector = [&](double size) { return glm::dvec3(random.vec4<Real>(size, Real(0))); };
    std::vector<Carrier> carriers;
    std::uint32_t loose = 0;
    for (const BodyParts::Part& part : parts.parts)
    {
        Carrier carrier;
        if (part.from < carriers.size())
            carrier = carriers[part.from];
        else
            carrier = {!part.held && loose++ % 2 == 0, vector(1e-2), vector(1), vector(1e-2)};
        carriers.push_back(carrier);
        sums.push_back(Real(carrier.carries ? 1 : 0));
        for (const glm::dvec3& v : {carrier.way, carrier.place, carrier.turn})
            for (int axis = 0; axis < 3; ++axis)
                sums.push_back(static_cast<Real>(v[axis]));
    }
    return carriers;
}

} // namespace taut::conformance
