// Which vertices and triangles, and which edges, may come within their gap before the next search. One
// invocation per triangle, for the vertices and sides that are its own, against the tree of all triangles. A
// pair is found if the boxes of its ways come within reach, and
//
//   |x_A - x_B| < r_A + r_B + skin + substeps max |d_i - d_j|,   i of A, j of B,
//
// d the displacement of the first substep: the skin is for what changes it later. Without FILL the pairs are
// counted, with FILL they are written behind those of the triangles before, in the order of the tree.
//
// The largest patch of the triangle that faces one way (contact_refit, plan/contact_patch) is passed over: it
// cannot meet itself.
//
// GUARD, with the guarantee, passes over nothing, and asks whether they could meet if each corner went along
// its forecast d as far as it likes, or stood still, and up to a tenth of it astray (guarantee_anchor holds
// them to that):
//
//   |x_A - x_B| < R + substeps |D|,   and less than R across D,   D the mean of the four d,
//   R = r_A + r_B + skin + substeps (max (|d_i - D| + |d_i| / 10) + max (|d_j - D| + |d_j| / 10)).
//
// Based on: Curtis, Tamstorf, Manocha. Fast Collision Detection for Deformable Models using Representative-
//   Triangles. I3D 2008 (every vertex and edge belongs to one triangle); Smits. Efficiency Issues for Ray
//   Tracing. Journal of Graphics Tools 3(2), 1998 (a tree walked without a stack); Volino, Magnenat-Thalmann.
//   Computer Graphics Forum 13(3), 1994 (patches that face one way).
// Departures: in the full binary tree the next node to visit is in the number of the last one. What was
//   counted is kept for FILL; of a triangle with more pairs than are kept FILL walks again, to the last.
// Bytes per triangle: 116 + 32 a node visited, 116 a triangle compared, 4 a pair; FILL 28 + 44 a pair.
//! variant fill FILL=1
//! variant guarded GUARD=1
//! variant guarded_fill GUARD=1 FILL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#if GUARD
#include "shared/guarantee.glsl"
#endif
#include "shared/contact_near.glsl"

PARAMS
{
    uint count;    // triangles
    uint leaves;   // of the tree, a power of two
    uint substeps; // until the next search
    float skin;    // m
    float reach;   // m, at least the greatest sum of two radii and the skin
    uint capacity; // pairs that the list holds
};

READ(0, ContactTriangle, triangle);
READ(1, rvec4, position); // w = inverse mass; 0 is held
READ(2, rvec4, delta);
READ(3, rvec4, node); // two a node: least and greatest coordinates, m
READ(4, ContactBody, body);
#if FILL
READ(5, uint, start); // pairs found before those of each triangle, and of all
WRITE(6, ContactPair, pair);
READ(7, uint, found);
#else
WRITE(5, uint, found);    // pairs of each triangle, then the first TAUT_CONTACT_KEPT of each, see put()
WRITE(6, uint, compared); // triangles whose boxes meet its own
COUNTERS(7, lost);
#endif

uint next_of(uint k)
{
    return k == 0u ? 1u : (k == 1u ? 2u : 0u);
}

uint corner_of(ContactTriangle t, uint k)
{
    return k == 0u ? t.a : (k == 1u ? t.b : t.c);
}

Corner corner_at(uint v)
{
    Corner here;
    here.x = rvec3(position[v]);
    here.way = rvec3(delta[v]);
    here.size = real(0);
#if GUARD
    here.way = sound_way(here.x, here.way);
    here.size = length(here.way);
#endif
    return here;
}

/// Whether four corners make a pair: neither a nor b is c or d, and any of the four is free to move.
bool makes_pair(uint a, uint b, uint c, uint d)
{
    real free = position[a].w + ((position[b].w + position[c].w) + position[d].w);
    return a != c && a != d && b != c && b != d && free > real(0);
}

/// Aligned with the axes.
struct Box
{
    rvec3 least, most; // m
};

/// Around the ways of two corners, and of the side between them, until the next search, and a margin.
INLINE Box box_of(Corner a, Corner b, real margin)
{
    rvec3 p = a.x + a.way * real(substeps);
    rvec3 q = b.x + b.way * real(substeps);
    rvec3 about = rvec3((max(a.size, b.size) * real(substeps)) * sway() + margin);
    Box box;
    box.least = min(min(a.x, b.x), min(p, q)) - about;
    box.most = max(max(a.x, b.x), max(p, q)) + about;
    return box;
}

INLINE bool overlap(Box a, Box b)
{
    return a.least.x <= b.most.x && a.least.y <= b.most.y && a.least.z <= b.most.z &&
           a.most.x >= b.least.x && a.most.y >= b.least.y && a.most.z >= b.least.z;
}

/// Around both boxes if the other one is wanted, else the first.
INLINE Box joined(bool wanted, Box box, Box other)
{
    Box both;
    both.least = wanted ? min(box.least, other.least) : box.least;
    both.most = wanted ? max(box.most, other.most) : box.most;
    return both;
}

/// Around what comes within reach of the vertices and sides that are a triangle's own.
Box around_own(ContactTriangle t)
{
    Box box;
    box.least = rvec3(REAL(1e30));
    box.most = rvec3(REAL(-1e30));
    for (uint k = 0u; k < 3u; ++k)
    {
        Corner a = corner_at(corner_of(t, k));
        Corner b = corner_at(corner_of(t, next_of(k)));
        uint side = 1u << (TAUT_CONTACT_OWNS_SIDE + k);
        box = joined((t.owns & (1u << k)) != 0u, box, box_of(a, a, real(reach)));
        box = joined((t.owns & side) != 0u, box, box_of(a, b, real(reach)));
    }
    return box;
}

/// Puts a pair down if there is a place for it, and gives the next place. The pair is said by the leaf of the
/// other triangle, and `which`: vertex k of this one, or 3 + 3 k + l: side k of this one and l of the other.
/// Both are kept as one word, 16 leaf + which.
uint put(uint at, uint i, uint leaf, uint which)
{
#if FILL
    if (at < capacity)
    {
        ContactTriangle t = triangle[i];
        ContactTriangle u = triangle[leaf];
        bool edges = which > 2u;
        uint k = edges ? (which - 3u) / 3u : which;
        uint l = edges ? (which - 3u) % 3u : 0u;
        ContactPair entry;
        entry.a = corner_of(t, k);
        entry.b = edges ? corner_of(t, next_of(k)) : u.a;
        entry.c = edges ? corner_of(u, l) : u.b;
        entry.d = edges ? corner_of(u, next_of(l)) : u.c;
        entry.kind = edges ? TAUT_CONTACT_EDGES : TAUT_CONTACT_VERTEX;
        pair[at] = entry;
    }
#else
    if (at < TAUT_CONTACT_KEPT)
        found[count + i * TAUT_CONTACT_KEPT + at] = (leaf << 4u) | which;
#endif
    return at + 1u;
}

/// The pairs of one triangle's own vertices and sides, those in `bits`, with another, in the box of its leaf;
/// sides once for both.
uint compare(uint at, uint i, uint leaf, uint bits, Box box, real pair_reach)
{
    ContactTriangle t = triangle[i];
    ContactTriangle u = triangle[leaf];
    Meeting m;
    m.edges = false;
    for (uint k = 0u; k < 3u; ++k)
    {
        uint v = corner_of(t, k);
        if ((bits & (1u << k)) == 0u || v == u.a || !makes_pair(v, u.a, u.b, u.c))
            continue;
        m.a = corner_at(v);
        if (!overlap(box_of(m.a, m.a, real(reach)), box))
            continue;
        m.b = corner_at(u.a);
        m.c = corner_at(u.b);
        m.d = corner_at(u.c);
        if (could_meet(m, pair_reach, real(substeps)))
            at = put(at, i, leaf, k);
    }
    m.edges = true;
    for (uint k = 0u; k < 3u; ++k)
    {
        if ((bits & (1u << (TAUT_CONTACT_OWNS_SIDE + k))) == 0u)
            continue;
        uint a = corner_of(t, k);
        uint b = corner_of(t, next_of(k));
        m.a = corner_at(a);
        m.b = corner_at(b);
        Box way = box_of(m.a, m.b, real(reach));
        bool comes = overlap(way, box);
        for (uint l = 0u; l < 3u && comes; ++l)
        {
            uint c = corner_of(u, l);
            uint d = corner_of(u, next_of(l));
            if ((u.owns & (1u << (TAUT_CONTACT_OWNS_SIDE + l))) == 0u || !makes_pair(a, b, c, d))
                continue;
            m.c = corner_at(c);
            m.d = corner_at(d);
            if (overlap(way, box_of(m.c, m.d, real(0))) && could_meet(m, pair_reach, real(substeps)))
                at = put(at, i, leaf, 3u + 3u * k + l);
        }
    }
    return at;
}

#if !GUARD
/// The node of the largest patch of a triangle that faces one way; 0, which is none, where there is none.
uint patch_of(uint leaf, uint owns)
{
    uint top = owns >> TAUT_CONTACT_OWNS_PATCH;
    uint k = (leaves + leaf) >> TAUT_CONTACT_PATCH;
    uint spared = 0u;
    for (uint level = TAUT_CONTACT_PATCH; level <= top; ++level)
    {
        bool faces = node[2u * k].w > real(0) || node[2u * k + 1u].w > real(0);
        spared = faces ? k : spared;
        top = faces ? top : 0u;
        k >>= 1u;
    }
    return spared;
}
#endif

/// What a walk through the tree has found.
struct Walk
{
    uint at;    // the place behind the last pair
    uint tests; // triangles compared
    bool more;  // nodes are left: it has all that it may put down, or was cut short
};

/// Puts down the pairs of triangle i, from the place `first` to the one before `last`.
Walk walk(uint i, uint first, uint last)
{
    ContactTriangle t = triangle[i];
    ContactBody own = body[t.body];
    Box around = around_own(t);
#if GUARD
    uint spared = 0u;
#else
    uint spared = patch_of(i, t.owns);
#endif
    // Sides look for those behind their own leaf only, so that a triangle without vertices begins there.
    uint k = (t.owns & TAUT_CONTACT_OWNS_VERTICES) != 0u ? 1u : (spared > 0u ? spared : leaves + i);
    uint trips = 0u;
    Walk w;
    w.at = first;
    w.tests = 0u;
    w.more = (t.owns & TAUT_CONTACT_OWNS_ANY) != 0u;
    while (w.more && w.at < last && trips < TAUT_CONTACT_TRIPS)
    {
        Box box;
        box.least = rvec3(node[2u * k]);
        box.most = rvec3(node[2u * k + 1u]);
        bool meets = k != spared && overlap(around, box);
        trips += 1u;
        if (meets && k >= leaves && k != leaves + i)
        {
            uint leaf = k - leaves;
            ContactBody other = body[triangle[leaf].body];
            bool same = triangle[leaf].body == t.body;
            bool passes = (own.meets & other.group) == 0u || (other.meets & own.group) == 0u;
            if (same ? own.self != 0u : !passes)
            {
                uint asked = leaf > i ? TAUT_CONTACT_OWNS_ANY : TAUT_CONTACT_OWNS_VERTICES;
                real pair_reach = (own.radius + other.radius) + real(skin);
                w.at = compare(w.at, i, leaf, t.owns & asked, box, pair_reach);
                w.tests += 1u;
                trips += 12u;
            }
        }
        if (meets && k < leaves)
            k = 2u * k;
        else
        {
            k += 1u;
            while ((k & 1u) == 0u)
            {
                k >>= 1u;
                trips += 1u;
            }
            w.more = k > 1u;
        }
    }
    return w;
}

KERNEL(count)
{
#if FILL
    uint first = start[i];
    uint last = start[i + 1u];
    bool kept = last - first <= TAUT_CONTACT_KEPT;
    for (uint k = first; k < last && kept; ++k)
    {
        uint code = found[count + i * TAUT_CONTACT_KEPT + (k - first)];
        put(k, i, code >> 4u, code & 15u);
    }
    if (!kept)
        walk(i, first, last);
#else
    Walk w = walk(i, 0u, 0xffffffffu);
    found[i] = w.at;
    compared[i] = w.tests;
    COUNT_EVENT_IF(w.more, lost, TAUT_CONTACT_CUT);
#endif
}
