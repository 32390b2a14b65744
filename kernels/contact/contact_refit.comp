// Boxes of the tree of triangles that meet others: of the leaves (LEAVES) where their corners are and will be
// at the next search if they go on as in the first substep, then of the nodes above, six levels a pass.
// The tree is a full binary one in an array: node k has the children 2k and 2k + 1, the root is 1, the leaf i
// is node `level` + i. One group per 64 nodes of a level.
//
// The fourth numbers say which of 26 directions n (from the middle of a cube to its faces, corners and edges)
// all triangles of a node face, now and at the next search: bits of n . normal >= 3/5, for faces and corners
// beside the least coordinates, for edges beside the greatest. A patch that faces one of them is a height
// field over a plane, and does not meet itself (contact_search, plan/contact_patch).
//
// GUARD, with the guarantee: where guarantee_anchor lets them go, but for what it adds for their radius; no
// directions.
//
// Based on: van den Bergen. Efficient Collision Detection of Complex Deformable Models using AABB Trees.
//   Journal of Graphics Tools 2(4), 1997 (refitting); Volino, Magnenat-Thalmann. Efficient self-collision
//   detection on smoothly discretized surface animations using geometrical shape regularity. Computer
//   Graphics Forum 13(3), 1994 (patches that face one way).
// Departures: directions are fixed, so that those of a node are the bits that its children share. Least and
//   greatest of numbers and bits are exact, so the order does not matter.
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

/// Bits that two reals share.
real both_of(real a, real b)
{
    return real(uint(a) & uint(b));
}

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

uint bit_of(real along, real size, uint bit)
{
    return along >= size ? 1u << bit : 0u;
}

/// Bits of faces and corners of a cube that a normal faces.
uint facing_corners(rvec3 n)
{
    real size = REAL(0.6) * length(n);
    uint bits = bit_of(n.x, size, 0u) | bit_of(-n.x, size, 1u) | bit_of(n.y, size, 2u) |
                bit_of(-n.y, size, 3u) | bit_of(n.z, size, 4u) | bit_of(-n.z, size, 5u);
    real far = REAL(1.7320508075688772) * size;
    for (uint k = 0u; k < 8u; ++k)
    {
        real x = (k & 1u) != 0u ? n.x : -n.x;
        real y = (k & 2u) != 0u ? n.y : -n.y;
        real z = (k & 4u) != 0u ? n.z : -n.z;
        bits |= bit_of((x + y) + z, far, 6u + k);
    }
    return size > real(0) ? bits : 0u;
}

/// Bits of edges of a cube that a normal faces.
uint facing_edges(rvec3 n)
{
    real size = REAL(0.6) * length(n);
    real far = REAL(1.4142135623730951) * size;
    uint bits = 0u;
    for (uint k = 0u; k < 4u; ++k)
    {
        real x = (k & 1u) != 0u ? n.x : -n.x;
        real y = (k & 1u) != 0u ? n.y : -n.y;
        real y2 = (k & 2u) != 0u ? n.y : -n.y;
        real z = (k & 2u) != 0u ? n.z : -n.z;
        bits |= bit_of(x + y2, far, k) | bit_of(y + z, far, 4u + k) | bit_of(x + z, far, 8u + k);
    }
    return size > real(0) ? bits : 0u;
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
    rvec3 now = cross(rvec3(b - a), rvec3(c - a));
    rvec3 then = cross(rvec3(end_of(t.b) - end_of(t.a)), rvec3(end_of(t.c) - end_of(t.a)));
    least.w = real(facing_corners(now) & facing_corners(then));
    most.w = real(facing_edges(now) & facing_edges(then));
    beyond.w = real(TAUT_CONTACT_CORNER_BITS); // nothing faces whatever the others face
    below.w = real(TAUT_CONTACT_EDGE_BITS);
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
        rvec4 least = min(low[2u * k], low[2u * k + 1u]);
        rvec4 most = max(high[2u * k], high[2u * k + 1u]);
        least.w = both_of(low[2u * k].w, low[2u * k + 1u].w);
        most.w = both_of(high[2u * k].w, high[2u * k + 1u].w);
        low[k] = least;
        high[k] = most;
        node[2u * (at + lane)] = low[k];
        node[2u * (at + lane) + 1u] = high[k];
        LANES_END
    }
}
