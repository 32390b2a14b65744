#pragma once
// The surfaces of a scene where it starts: which go through each other, and which are nearer than their gap.

#include "taut/judge/crossings.hpp"
#include "taut/scene/scene.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace taut {

/// A vertex and a triangle, or two edges, of surfaces that are to meet, nearer than the gap between them.
struct NearPair
{
    std::array<std::uint32_t, 4> corner{}; ///< scene-wide
    std::array<double, 4> weight{}; ///< of the corners in the way between the nearest points: adds up to 0
    glm::dvec3 normal{0};           ///< unit, from the second of the two to the first
    double distance = 0, gap = 0;   ///< m
};

/// All that can meet. fp64 on the host; const members may be called from any thread.
class StartSurfaces
{
public:
    /// `resolved`: by resolve(). A scene of which nothing meets has no surfaces.
    explicit StartSurfaces(const Scene& resolved);

    /// m, world, scene-wide: where vertices start.
    const std::vector<glm::dvec3>& places() const { return places_; }
    const judging::Surface& surface() const { return surface_; }
    std::uint32_t body_of(std::uint32_t vertex) const { return body_[vertex]; }

    /// Edges that go through triangles, exactly, of surfaces that are to meet; in order of the edges.
    std::vector<judging::CrossingEdge> crossings(const std::vector<glm::dvec3>& places) const;

    /// Pairs nearer than their gap (docs/contact.md: the sum of two radii, of one body no more than what is
    /// between them at rest) of which a corner can move; those that touch are crossings and none of these.
    std::vector<NearPair> near(const std::vector<glm::dvec3>& places) const;

    /// Pairs of two bodies that touch as exactly as rounding tells, of which a corner can move.
    std::vector<NearPair> touching(const std::vector<glm::dvec3>& places) const;

    /// "12 pairs of triangles, the first triangle 3 of bodies[0] and triangle 5 of bodies[1] ("cloth")";
    /// empty where nothing crosses.
    std::string crossed(const std::vector<glm::dvec3>& places) const;

private:
    bool meets(std::uint32_t a, std::uint32_t b) const { return meet_[body_[a]][body_[b]]; }
    double gap_of(std::uint32_t a, std::uint32_t b) const { return radius_[body_[a]] + radius_[body_[b]]; }
    bool held(const std::array<std::uint32_t, 4>& corner) const;
    /// Those of near(), and those that touch, whose normal is 0.
    std::vector<NearPair> within_gap(const std::vector<glm::dvec3>& places) const;
    void near_triangles(const std::vector<glm::dvec3>& places, std::vector<NearPair>& out) const;
    void near_edges(const std::vector<glm::dvec3>& places, std::vector<NearPair>& out) const;
    std::string name_of(std::uint32_t triangle) const;

    judging::Surface surface_;
    std::vector<std::uint32_t> body_;       ///< per vertex
    std::vector<std::vector<bool>> meet_;   ///< per two bodies
    std::vector<double> radius_;            ///< m, per body
    std::vector<std::string> names_;        ///< of bodies
    std::vector<std::uint32_t> first_;      ///< of the triangles of each body
    std::vector<glm::dvec3> places_, rest_; ///< m
    std::vector<bool> used_;                ///< per vertex: of a triangle that meets anything
    std::vector<bool> held_;                ///< per vertex: pinned or led
};

/// m: by how much the nearest two of the surfaces of `resolved` that are not held are nearer than their gap
/// at the start; 0 where none is.
double deepest_contact(const Scene& resolved);

} // namespace taut
