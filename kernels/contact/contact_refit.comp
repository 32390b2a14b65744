// Boxes of the tree of triangles that meet others: of the leaves (LEAVES) where their corners are and will be
// at the next search if they go on as in the first substep, then of the nodes above, six levels a pass.
// The tree is a full binary one in an array: node k has the children 2k and 2k + 1, the root is 1, the leaf i
// is node `level` + i. One group per 64 nodes of a level.
//
// GUARD, with the guarantee: where guarantee_anchor lets them go, but for what it adds for their radius.
//
// Based on: van den Bergen. Efficient Collision Detection of Complex Deformable Models using AABB Trees.
//   Journal of Graphics Tools 2(4), 1997 (refitting).
// Departures: none. Least and greatest of numbers are exact, so the order does not matter.
// Bytes per triangle: 20 + 96 read, 64 written (float).
//! variant leaves LEAVES=1
//! variant guarded LEAVES=1 GUARD=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#if GUARD
#include "shared/guarantee.glsl"
#endif

PARAMS
{
    uint level;    // nodes of the level that is begun with, a power of two; also the number of its first one
    uint count;    // triangles
    uint substeps; // until the next search
};

GROUP_UPDATE(0, rvec4, node); // two a node: least and greatest coordinates, m
#if LEAVES
READ(1, ContactTriangle, triangle);
READ(2, rvec4, position);
READ(3, rvec4, delta); // m, of the first substep
#endif

SHARED(rvec4, low, 2 * TAUT_CONTACT_REFIT);
SHARED(rvec4, high, 2 * TAUT_CONTACT_REFIT);

#if LEAVES
#if GUARD
rvec4 way_of(uint v)
{
    return rvec4(sound_way(rvec3(position[v]), rvec3(delta[v])) * real(substeps), real(0));
}

/// Half the side of the box about a corner on its way.
rvec4 sway_of(uint v)
{
    return rvec4(rvec3(length(rvec3(way_of(v))) * sway()), real(0));
}

rvec4 least_of(uint v)
{
    rvec4 x = rvec4(rvec3(position[v]), real(0));
    return min(x, x + way_of(v)) - sway_of(v);
}

rvec4 most_of(uint v)
{
    rvec4 x = rvec4(rvec3(position[v]), real(0));
    return max(x, x + way_of(v)) + sway_of(v);
}
#else
rvec4 end_of(uint v)
{
    return rvec4(rvec3(position[v]) + rvec3(delta[v]) * real(substeps), real(0));
}
#endif
#endif

GROUP_KERNEL(TAUT_CONTACT_REFIT)
{
    uint lanes = min(level, uint(TAUT_CONTACT_REFIT));
    uint first = level + group * lanes;
    LANES_BEGIN(lanes)
    uint k = lanes + lane;
#if LEAVES
    uint leaf = group * lanes + lane;
    ContactTriangle t = triangle[min(leaf, count - 1u)];
    rvec4 beyond = rvec4(rvec3(REAL(1e30)), real(0)); // the box of nothing is turned inside out
    rvec4 below = rvec4(rvec3(REAL(-1e30)), real(0));
#if GUARD
    rvec4 least = min(min(least_of(t.a), least_of(t.b)), least_of(t.c));
    rvec4 most = max(max(most_of(t.a), most_of(t.b)), most_of(t.c));
#else
    rvec4 a = rvec4(rvec3(position[t.a]), real(0));
    rvec4 b = rvec4(rvec3(position[t.b]), real(0));
    rvec4 c = rvec4(rvec3(position[t.c]), real(0));
    rvec4 least = min(min(min(a, b), c), min(min(end_of(t.a), end_of(t.b)), end_of(t.c)));
    rvec4 most = max(max(max(a, b), c), max(max(end_of(t.a), end_of(t.b)), end_of(t.c)));
#endif
    low[k] = leaf < count ? least : beyond;
    high[k] = leaf < count ? most : below;
    node[2u * (first + lane)] = low[k];
    node[2u * (first + lane) + 1u] = high[k];
#else
    low[k] = node[2u * (first + lane)];
    high[k] = node[2u * (first + lane) + 1u];
#endif
    LANES_END
    for (uint width = lanes / 2u; width > 0u; width /= 2u)
    {
        uint at = first / (lanes / width);
        LANES_BEGIN(width)
        uint k = width + lane;
        low[k] = min(low[2u * k], low[2u * k + 1u]);
        high[k] = max(high[2u * k], high[2u * k + 1u]);
        node[2u * (at + lane)] = low[k];
        node[2u * (at + lane) + 1u] = high[k];
        LANES_END
    }
}
