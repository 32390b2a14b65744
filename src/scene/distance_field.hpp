#pragma once
// Signed distances to a closed surface at the points of a grid: a shape of colliders, and its files.

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taut {

/// In the frame of its file. Only read once it is made; several threads may do so.
struct DistanceField
{
    std::array<std::uint32_t, 3> points{}; ///< along x, y and z, each >= 2
    glm::dvec3 low{0};                     ///< m, place of point (0, 0, 0)
    double cell = 0;                       ///< m, between neighbours, > 0
    std::vector<float> values;             ///< m, below 0 inside; x fastest, then y, then z

    glm::dvec3 half_size() const; ///< m, of the box that the points fill
    glm::dvec3 middle() const;    ///< m, of that box

    /// m, at `p`: linear along each axis between the eight points round it. Beyond the grid a lower bound:
    /// sqrt(d^2 + phi^2), d from the nearest place of the border and phi there.
    double distance(const glm::dvec3& p) const;

    /// The way out at `p`, of length 1: central differences over a cell; upwards where they are 0.
    glm::dvec3 normal(const glm::dvec3& p) const;

    /// m, >= 0: of the point furthest inside.
    double depth() const;
    /// m: the least value on the border, beyond which distances are bounds.
    double margin() const;

    std::size_t index(std::size_t i, std::size_t j, std::size_t k) const
    {
        return i + points[0] * (j + points[1] * k);
    }
    glm::dvec3 place(std::size_t i, std::size_t j, std::size_t k) const
    {
        return low + cell * glm::dvec3(i, j, k);
    }
};

/// Of one field, and of all that a scene has: indices are 32 bits in kernels.
inline constexpr std::size_t kMostFieldPoints = std::size_t(1) << 30;

/// What keeps it from being a collider, as a sentence that begins with a verb; empty where nothing does: too
/// few points or too many values, a number that is not finite, cells that are no lengths, a border that is
/// not outside, no point inside, neighbours that differ by more than 1.5 cells, or nowhere by half a cell.
std::string fault_of(const DistanceField& field);

/// The text that Batty's SDFGen writes: numbers of points, place of the first, distance of neighbours,
/// values. Throws Error{io}, and Error{bad_input} naming the file, the line and what is wrong, fault_of()
/// included.
DistanceField read_distance_field(const std::filesystem::path& file);

/// Under a temporary name, then renamed. Throws Error{io}.
void write_distance_field(const std::filesystem::path& file, const DistanceField& field);

} // namespace taut
