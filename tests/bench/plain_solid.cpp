// Based on: Macklin et al. Small Steps in Physics Simulation. SCA 2019, algorithm 1, with one iteration;
//   volumes as in Mueller et al. Strain Based Dynamics. SCA 2014.
// Departures: one parallel region a step, one loop a colour; without OpenMP the same loops are serial.

#include "plain_solid.hpp"

#include <cmath>
#include <utility>

namespace plain {
namespace {

struct Vec3
{
    float x, y, z;
};

inline Vec3 between(const Vec4& a, const Vec4& b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }
inline Vec3 cross(const Vec3& a, const Vec3& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline void push(Vec4& x, const Vec3& g, float by)
{
    x.x += g.x * by;
    x.y += g.y * by;
    x.z += g.z * by;
}

inline void hold_length(const Constraint& c, Vec4* x, float inverse)
{
    const Vec3 d = between(x[c.b], x[c.a]);
    const float length = std::sqrt(dot(d, d));
    const float weight = x[c.a].w + x[c.b].w + c.compliance * inverse * inverse;
    if (!(length > 0) || !(weight > 0))
        return;
    const float by = (c.rest_length - length) / (weight * length);
    push(x[c.a], d, x[c.a].w * by);
    push(x[c.b], d, -x[c.b].w * by);
}

inline void hold_volume(const Tetrahedron& t, Vec4* x, float inverse)
{
    const Vec3 e1 = between(x[t.a], x[t.b]), e2 = between(x[t.a], x[t.c]), e3 = between(x[t.a], x[t.d]);
    const Vec3 g1 = cross(e2, e3), g2 = cross(e3, e1), g3 = cross(e1, e2);
    const Vec3 g0 = {-(g1.x + g2.x + g3.x), -(g1.y + g2.y + g3.y), -(g1.z + g2.z + g3.z)};
    const float weight = (x[t.a].w * dot(g0, g0) + x[t.b].w * dot(g1, g1) + x[t.c].w * dot(g2, g2) +
                          x[t.d].w * dot(g3, g3)) /
                             36 +
                         t.compliance * inverse * inverse;
    if (!(weight > 0))
        return;
    const float by = (t.rest_volume - dot(e1, g1) / 6) / (6 * weight);
    push(x[t.a], g0, x[t.a].w * by);
    push(x[t.b], g1, x[t.b].w * by);
    push(x[t.c], g2, x[t.c].w * by);
    push(x[t.d], g3, x[t.d].w * by);
}

} // namespace

Solid::Solid(std::vector<Vec4> position, std::vector<Constraint> springs,
             std::vector<std::uint32_t> spring_colours, std::vector<Tetrahedron> tetrahedra,
             std::vector<std::uint32_t> tetrahedron_colours)
    : position_(std::move(position)),
      before_(position_),
      velocity_(position_.size(), Vec4{0, 0, 0, 0}),
      springs_(std::move(springs)),
      spring_colours_(std::move(spring_colours)),
      tetrahedra_(std::move(tetrahedra)),
      tetrahedron_colours_(std::move(tetrahedron_colours))
{}

void Solid::step(float seconds, int substeps, float gravity_y)
{
    const float h = seconds / static_cast<float>(substeps), inverse = 1 / h;
    const auto n = static_cast<int>(position_.size());
    const auto spring_colours = static_cast<int>(spring_colours_.size()) - 1;
    const auto tetrahedron_colours = static_cast<int>(tetrahedron_colours_.size()) - 1;
    Vec4 *x = position_.data(), *before = before_.data(), *v = velocity_.data();
    const Constraint* springs = springs_.data();
    const Tetrahedron* tetrahedra = tetrahedra_.data();
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
        for (int colour = 0; colour < spring_colours; ++colour)
        {
            const auto first = static_cast<int>(spring_colours_[static_cast<std::size_t>(colour)]);
            const auto end = static_cast<int>(spring_colours_[static_cast<std::size_t>(colour) + 1]);
#pragma omp for schedule(static)
            for (int k = first; k < end; ++k)
                hold_length(springs[k], x, inverse);
        }
        for (int colour = 0; colour < tetrahedron_colours; ++colour)
        {
            const auto first = static_cast<int>(tetrahedron_colours_[static_cast<std::size_t>(colour)]);
            const auto end = static_cast<int>(tetrahedron_colours_[static_cast<std::size_t>(colour) + 1]);
#pragma omp for schedule(static)
            for (int k = first; k < end; ++k)
                hold_volume(tetrahedra[k], x, inverse);
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
