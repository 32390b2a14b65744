#pragma once
// The rival: distance constraints in plain scalar C++, one loop a colour, no library.

#include <cstdint>
#include <span>
#include <vector>

namespace plain {

struct Vec4 { float x, y, z, w; };
struct Constraint { std::uint32_t a, b; float rest_length, compliance; };

/// One Gauss-Seidel sweep on displacements, as the kernel does it. position.w = inverse mass.
void sweep_displacements(std::span<const Constraint> constraints, std::span<const std::uint32_t> colour_start,
                         const Vec4* position, Vec4* delta, float inverse_step);

/// The same on positions alone: less to read, and the rounding that comes with it.
void sweep_positions(std::span<const Constraint> constraints, std::span<const std::uint32_t> colour_start,
                     Vec4* position, float inverse_step);

} // namespace plain
