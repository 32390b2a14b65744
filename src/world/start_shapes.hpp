#pragma once
// How the vertices of a scene hang together where it starts. Internal to separate_start.cpp.

#include "taut/world/start_surfaces.hpp"

#include <cstdint>
#include <numeric>
#include <vector>

namespace taut {

/// Sets that become one where two of theirs are joined.
class Joined
{
public:
    explicit Joined(std::size_t count) : root_(count) { std::iota(root_.begin(), root_.end(), 0u); }
    void join(std::uint32_t a, std::uint32_t b) { root_[find(a)] = find(b); }
    /// Per element the number of one that stands for its set.
    std::vector<std::uint32_t> roots();

private:
    std::uint32_t find(std::uint32_t v);

    std::vector<std::uint32_t> root_;
};

/// Two vertices that keep their distance.
struct StartLength
{
    std::uint32_t a = 0, b = 0;
    double length = 0; ///< m
};

/// 1/kg, scene-wide; 0 = pinned or led.
std::vector<double> inverse_masses(const Scene& resolved);

/// Edges of surfaces, of tetrahedra, of elements, links and springs, and across each edge of two triangles
/// the way between the corners that they do not share, which keeps cloth from folding sharply; each once, in
/// order.
std::vector<StartLength> start_lengths(const Scene& resolved, const StartSurfaces& surfaces);

} // namespace taut
