// The volume within closed surfaces and its gradient: each vertex gathers that of its triangles, and each
// group leaves its share of V, of what the step does to V, and of the weight sum w |g|^2.
//
// Based on:
//   Va, Choi, Hong. Real-time Surface-based Volume Constraints on Mass-Spring Model in Unity3D. IEEE Access
//     11, 2023: the volume by the divergence theorem, V = 1/6 sum a . (b x c), dV/da = 1/6 sum b x c.
// Departures: V is homogeneous of degree 3, so that 3 V = sum g . x and triangles need no pass of their own;
//   a vertex sees its triangles from its own place, and places and moves count from the surface's first
//   vertex: on a closed surface the sums are the same, and float keeps its digits far from the origin.
// Bytes per vertex: 8 + 80 read, 16 written; per corner of a triangle 8 + 64 (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"

PARAMS
{
    uint groups;
    uint further; // 1: at the places that the displacement so far leads to; 0: at the start of the substep
};

// 6 words a group: its first vertex and the end of them, counted in this list; the surface's first vertex;
// the surface; its first group; its number of groups. Then 2 words a vertex: itself, and where its corners
// begin; the last pair of words holds where they end.
READ(0, uint, table);
READ(1, uint, corner);    // 2 words: the other two vertices of a triangle, in its order
READ(2, rvec4, position); // m, w = inverse mass
READ(3, rvec4, low);      // m, what position lost to rounding
READ(4, rvec4, delta);    // m, displacement so far, with what position lost
WRITE(5, rvec4, gradient); // m^2, of V; w = inverse mass
WRITE(6, real, partials);  // 3 a group: V [m^3], sum g . moved [m^3], sum w |g|^2 [m^4/kg]

SHARED(real, volume, TAUT_LINEAR_GROUP);
SHARED(real, change, TAUT_LINEAR_GROUP);
SHARED(real, weight, TAUT_LINEAR_GROUP);

/// From one vertex to another.
rvec3 between(uint from, uint to)
{
    rvec3 apart = rvec3(position[to]) - rvec3(position[from]);
    rvec3 fine = further != 0u ? rvec3(delta[to]) - rvec3(delta[from]) : rvec3(low[to]) - rvec3(low[from]);
    return apart + fine;
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint own = min(group, groups - 1u);
    uint first = table[6u * own];
    uint end = group < groups ? table[6u * own + 1u] : first;
    uint origin = table[6u * own + 2u];
    PHASE_BEGIN
    volume[lane] = real(0);
    change[lane] = real(0);
    weight[lane] = real(0);
    PHASE_END
    EACH_BEGIN(first, end)
    uint at = 6u * groups + 2u * uint(i);
    uint v = table[at];
    uint last = table[at + 3u];
    rvec3 g = rvec3(real(0));
    for (uint k = table[at + 1u]; k < last; ++k)
        g += cross(between(v, corner[2u * k]), between(v, corner[2u * k + 1u]));
    g *= REAL(0.16666666666666666667);
    real w = position[v].w;
    rvec3 moved = (rvec3(delta[v]) - rvec3(low[v])) - (rvec3(delta[origin]) - rvec3(low[origin]));
    gradient[i] = rvec4(g, w);
    volume[lane] += dot(g, between(origin, v)) * REAL(0.33333333333333333333);
    change[lane] += dot(g, moved);
    weight[lane] += w * dot(g, g);
    EACH_END
    SUM_LANES_2(volume, change)
    SUM_LANES(weight)
    LANES_BEGIN(1)
    if (group < groups)
    {
        partials[3u * group] = volume[0];
        partials[3u * group + 1u] = change[0];
        partials[3u * group + 2u] = weight[0];
    }
    LANES_END
}
