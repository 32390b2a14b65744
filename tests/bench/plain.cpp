#include "plain.hpp"

#include <cmath>

namespace plain {

void sweep_displacements(std::span<const Constraint> constraints, std::span<const std::uint32_t> colour_start,
                         const Vec4* position, Vec4* delta, float inverse_step)
{
    for (std::size_t colour = 0; colour + 1 < colour_start.size(); ++colour)
        for (std::uint32_t k = colour_start[colour]; k < colour_start[colour + 1]; ++k)
        {
            const Constraint& c = constraints[k];
            const Vec4 &xa = position[c.a], &xb = position[c.b];
            Vec4 &da = delta[c.a], &db = delta[c.b];
            const float dx = (xa.x - xb.x) + (da.x - db.x);
            const float dy = (xa.y - xb.y) + (da.y - db.y);
            const float dz = (xa.z - xb.z) + (da.z - db.z);
            const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
            const float weight = xa.w + xb.w;
            if (!(length > 0) || !(weight > 0))
                continue;
            const float scaled = c.compliance * inverse_step * inverse_step;
            const float push = -(length - c.rest_length) / (weight + scaled) / length;
            da.x += xa.w * push * dx;
            da.y += xa.w * push * dy;
            da.z += xa.w * push * dz;
            db.x -= xb.w * push * dx;
            db.y -= xb.w * push * dy;
            db.z -= xb.w * push * dz;
        }
}

void sweep_positions(std::span<const Constraint> constraints, std::span<const std::uint32_t> colour_start,
                     Vec4* position, float inverse_step)
{
    for (std::size_t colour = 0; colour + 1 < colour_start.size(); ++colour)
        for (std::uint32_t k = colour_start[colour]; k < colour_start[colour + 1]; ++k)
        {
            const Constraint& c = constraints[k];
            Vec4 &xa = position[c.a], &xb = position[c.b];
            const float dx = xa.x - xb.x, dy = xa.y - xb.y, dz = xa.z - xb.z;
            const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
            const float weight = xa.w + xb.w;
            if (!(length > 0) || !(weight > 0))
                continue;
            const float scaled = c.compliance * inverse_step * inverse_step;
            const float push = -(length - c.rest_length) / (weight + scaled) / length;
            xa.x += xa.w * push * dx;
            xa.y += xa.w * push * dy;
            xa.z += xa.w * push * dz;
            xb.x -= xb.w * push * dx;
            xb.y -= xb.w * push * dy;
            xb.z -= xb.w * push * dz;
        }
}

} // namespace plain
