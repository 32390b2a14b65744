// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1, with one iteration.
// Departures: one parallel region a step, one loop a colour; without OpenMP the same loops are serial.

#include "plain_cloth.hpp"

#include <cmath>
#include <utility>

namespace plain {

Cloth::Cloth(std::vector<Vec4> position, std::vector<Constraint> constraints,
             std::vector<std::uint32_t> colour_start)
    : position_(std::move(position)),
      before_(position_),
      velocity_(position_.size(), Vec4{0, 0, 0, 0}),
      constraints_(std::move(constraints)),
      colour_start_(std::move(colour_start))
{}

void Cloth::step(float seconds, int substeps, float gravity_y)
{
    const float h = seconds / static_cast<float>(substeps), inverse = 1 / h;
    const auto n = static_cast<int>(position_.size());
    const auto colours = static_cast<int>(colour_start_.size()) - 1;
    Vec4 *x = position_.data(), *before = before_.data(), *v = velocity_.data();
    const Constraint* constraint = constraints_.data();
    const std::uint32_t* start = colour_start_.data();
#pragma omp parallel
    for (int s = 0; s < substeps; ++s)
    {
#pragma omp for schedule(static)
        for (int i = 0; i < n; ++i)
        {
            before[i] = x[i];
            if (x[i].w > 0)
            {
                v[i].y += gravity_y * h;
                x[i].x += v[i].x * h;
                x[i].y += v[i].y * h;
                x[i].z += v[i].z * h;
            }
        }
        for (int colour = 0; colour < colours; ++colour)
        {
            const auto first = static_cast<int>(start[colour]), end = static_cast<int>(start[colour + 1]);
#pragma omp for schedule(static)
            for (int k = first; k < end; ++k)
            {
                const Constraint& c = constraint[k];
                Vec4 &xa = x[c.a], &xb = x[c.b];
                const float dx = xa.x - xb.x, dy = xa.y - xb.y, dz = xa.z - xb.z;
                const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
                const float weight = xa.w + xb.w + c.compliance * inverse * inverse;
                if (!(length > 0) || !(weight > 0))
                    continue;
                const float push = (c.rest_length - length) / (weight * length);
                const float pa = xa.w * push, pb = xb.w * push;
                xa.x += pa * dx;
                xa.y += pa * dy;
                xa.z += pa * dz;
                xb.x -= pb * dx;
                xb.y -= pb * dy;
                xb.z -= pb * dz;
            }
        }
#pragma omp for schedule(static)
        for (int i = 0; i < n; ++i)
        {
            v[i].x = (x[i].x - before[i].x) * inverse;
            v[i].y = (x[i].y - before[i].y) * inverse;
            v[i].z = (x[i].z - before[i].z) * inverse;
        }
    }
}

} // namespace plain
