#pragma once
// A solid from a file whose vertices carry numbers of their own: any numbers, with gaps, in any order.

#include "taut/scene/raw_solid.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace taut::scene_file {

/// What is wrong comes back as a sentence for the reader's message, empty when nothing is.
class SolidBuilder
{
public:
    void add_vertex(std::int64_t number, const glm::dvec3& position);
    /// After the last vertex, before the first tetrahedron. Refuses a number that two vertices have.
    std::string close_vertices();
    bool closed() const { return closed_; }
    /// Refuses vertices that are not there, and one named twice.
    std::string add_tetrahedron(std::int64_t number, const std::array<std::int64_t, 4>& corners);

    RawSolid take() { return std::move(solid_); }

private:
    RawSolid solid_;
    std::vector<std::pair<std::int64_t, std::uint32_t>> index_of_; ///< sorted by the first once closed
    bool closed_ = false;
};

} // namespace taut::scene_file
