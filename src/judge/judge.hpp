#pragma once
// An independent judge of frames of triangles: what passes through what, how near, how far stretched. It
// shares no code with the kernels, and takes frames of any program.

#include "taut/judge/distance.hpp"
#include "taut/judge/surface.hpp"
#include "taut/judge/swept.hpp"

#include <optional>
#include <string>

namespace taut::judging {

/// What one frame is.
struct FrameVerdict
{
    std::size_t intersecting = 0;                          ///< pairs of triangles that go through each other
    std::vector<std::array<std::uint32_t, 2>> first_pairs; ///< the first ten of them
    Nearest nearest;                                       ///< of the whole surface
    Nearest nearest_parts;                                 ///< of different connected parts
    double stretch = 0; ///< largest of |l / l0 - 1| over judged edges, l0 that of the first frame
    std::uint32_t stretched_edge = 0; ///< of Surface::edges
    double volume_change = -1;        ///< largest of |V / V0 - 1| over closed parts; -1: there is none
    /// Of each pair of borders, (0, 1), (0, 2), (1, 2), ...; nothing where they touch, or are not judged
    /// against each other. Empty beyond kMostBorders.
    std::vector<std::optional<int>> linking;
};

/// Judges one frame after another of one set of triangles. One thread at a time.
class Judge
{
public:
    static constexpr std::size_t kMostBorders = 8; ///< linking numbers are left out where there are more

    /// `first`: positions of the first frame, m. Throws Error{bad_input} where a position is not finite or
    /// beyond 1e30, a triangle names a vertex that is not there, or there is no triangle. `led`: vertices
    /// that are not judged among each other (Surface::led); `passing`: bodies that are not.
    Judge(std::vector<Triangle> triangles, const std::vector<glm::dvec3>& first, std::vector<bool> led = {},
          PassingBodies passing = {});

    /// Throws Error{bad_input} where the number of positions is another one, or one is not finite or too
    /// large.
    FrameVerdict look(const std::vector<glm::dvec3>& positions) const;

    /// What passes through what on straight ways from one frame to the next (swept.hpp). Throws as look()
    /// does.
    std::vector<Passing> between(const std::vector<glm::dvec3>& before,
                                 const std::vector<glm::dvec3>& after) const;

    const Surface& surface() const { return surface_; }

private:
    void check(const std::vector<glm::dvec3>& positions) const;
    double volume(std::uint32_t part, const std::vector<glm::dvec3>& positions) const;

    Surface surface_;
    std::vector<double> lengths_; ///< of the edges in the first frame, m
    std::vector<double> volumes_; ///< of the closed parts in the first frame, m^3
};

} // namespace taut::judging
