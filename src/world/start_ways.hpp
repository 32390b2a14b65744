#pragma once
// Where edges that go through triangles have to go. Internal to separate_start.cpp.

#include "taut/world/start_surfaces.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace taut {

/// Refers to one state of the surfaces, which must outlive it.
///
/// Based on: Volino, Magnenat-Thalmann. Resolving surface collisions through intersection contour
///   minimization. ACM TOG 25(3), 2006; Baraff, Witkin, Kass. Untangling cloth. SIGGRAPH 2003 (the smaller of
///   two pieces that a curve of crossings cuts off is on the wrong side).
/// Departures: a curve that cuts nothing off becomes shorter, as the former say; a piece that is cut off goes
///   back through the triangles that cut it.
class StartWays
{
public:
    /// `crossed`: all crossings at `places` [m], in order of their edges.
    StartWays(const StartSurfaces& surfaces, const std::vector<glm::dvec3>& places,
              std::span<const judging::CrossingEdge> crossed);

    /// Unit: where the edge has to go relative to the triangle.
    glm::dvec3 way(const judging::CrossingEdge& c) const;

    /// The piece that the edge cuts off: of its two ends' the one of fewer vertices; none where both are of
    /// one.
    std::optional<std::uint32_t> cut_off(const judging::CrossingEdge& c) const;

    /// Number of the piece that a vertex belongs to, below that of all vertices.
    std::uint32_t piece_of(std::uint32_t vertex) const { return piece_of_[vertex]; }

private:
    glm::dvec3 shorter(const judging::CrossingEdge& c) const;
    glm::dvec3 back(const judging::CrossingEdge& c) const;
    glm::dvec3 normal_of(std::uint32_t triangle) const;
    glm::dvec3 out_of_plane(const judging::CrossingEdge& c) const;

    const StartSurfaces& surfaces_;
    const judging::Surface& surface_;
    const std::vector<glm::dvec3>& x_;
    std::vector<std::uint32_t> piece_of_, size_; ///< per vertex; vertices of the piece that it stands for
};

} // namespace taut
