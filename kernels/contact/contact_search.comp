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
// Departures: in the full binary tree the next node to visit is in the number of the last one. FILL walks no
//   further than the pairs that were counted: not at all where there are none.
// Bytes per triangle: 20 + 32 a node visited, 20 + 96 a triangle compared; FILL 20 a pair written (float).
//! variant fill FILL=1
//! variant guarded GUARD=1
//! variant guarded_fill GUARD=1 FILL=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"
#include "shared/closest.glsl"
#if GUARD
#include "shared/guarantee.glsl"
#endif

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
#else
WRITE(5, uint, found);    // pairs of each triangle
WRITE(6, uint, compared); // triangles whose boxes meet its own
COUNTERS(7, lost);
#endif

uint corner_of(ContactTriangle t, uint k)
{
    return k == 0u ? t.a : (k == 1u ? t.b : t.c);
}

#if GUARD
rvec3 way_of(uint v)
{
    return sound_way(rvec3(position[v]), rvec3(delta[v]));
}

/// How far a corner may stray in a substep from the mean way.
real stray(rvec3 d, rvec3 mean)
{
    return length(d - mean) + sway() * length(d);
}

rvec3 across(rvec3 x, rvec3 direction)
{
    return x - direction * dot(x, direction);
}

/// Whether the four, places relative to the first, could meet until the next search.
bool could_meet(uint kind, uint a, uint b, uint c, uint d, rvec3 eb, rvec3 ec, rvec3 ed, real gap)
{
    rvec3 p = way_of(a);
    rvec3 q = way_of(b);
    rvec3 r = way_of(c);
    rvec3 s = way_of(d);
    rvec3 mean = ((p + q) + (r + s)) * real(0.25);
    real first = stray(p, mean);
    real second = max(stray(r, mean), stray(s, mean));
    if (kind == TAUT_CONTACT_EDGES)
        first = max(first, stray(q, mean));
    else
        second = max(second, stray(q, mean));
    real reached = (gap + real(skin)) + (first + second) * real(substeps);
    real speed = length(mean);
    real all = reached + speed * real(substeps);
    Closest near = closest_vertex_triangle(eb, ec, ed);
    if (kind == TAUT_CONTACT_EDGES)
        near = closest_edges(eb, ec, ed);
    bool comes = near.squared < all * all;
    if (comes && speed > real(0))
    {
        rvec3 u = mean / speed;
        if (kind == TAUT_CONTACT_EDGES)
            near = closest_edges(across(eb, u), across(ec, u), across(ed, u));
        else
            near = closest_vertex_triangle(across(eb, u), across(ec, u), across(ed, u));
        comes = near.squared < reached * reached;
    }
    return comes;
}
#else
/// The greatest square of the differences of how two corners and two others are displaced.
real apart(uint a, uint b, uint c, uint d)
{
    rvec3 ac = rvec3(delta[a]) - rvec3(delta[c]);
    rvec3 ad = rvec3(delta[a]) - rvec3(delta[d]);
    rvec3 bc = rvec3(delta[b]) - rvec3(delta[c]);
    rvec3 bd = rvec3(delta[b]) - rvec3(delta[d]);
    return max(max(dot(ac, ac), dot(ad, ad)), max(dot(bc, bc), dot(bd, bd)));
}

bool is_near(real squared, real motion, real gap)
{
    real reached = (gap + real(skin)) + sqrt(motion) * real(substeps);
    return squared < reached * reached;
}
#endif

/// Whether the way of a corner, or of a side with two, comes within reach of a box.
bool reaches(uint a, uint b, rvec4 least, rvec4 most)
{
    rvec3 p = rvec3(position[a]);
    rvec3 q = rvec3(position[b]);
#if GUARD
    rvec3 d = way_of(a) * real(substeps);
    rvec3 e = way_of(b) * real(substeps);
    rvec3 m = rvec3(max(length(d), length(e)) * sway() + real(reach));
    rvec3 l = min(min(p, q), min(p + d, q + e)) - m;
    rvec3 h = max(max(p, q), max(p + d, q + e)) + m;
#else
    rvec3 r = p + rvec3(delta[a]) * real(substeps);
    rvec3 s = q + rvec3(delta[b]) * real(substeps);
    rvec3 l = min(min(p, q), min(r, s)) - rvec3(real(reach));
    rvec3 h = max(max(p, q), max(r, s)) + rvec3(real(reach));
#endif
    return l.x <= most.x && l.y <= most.y && l.z <= most.z && h.x >= least.x && h.y >= least.y &&
           h.z >= least.z;
}

bool vertex_meets(uint v, ContactTriangle t, real gap)
{
    if (v == t.a || v == t.b || v == t.c)
        return false;
    rvec4 x = position[v];
    rvec4 a = position[t.a];
    rvec4 b = position[t.b];
    rvec4 c = position[t.c];
    bool moves = x.w + ((a.w + b.w) + c.w) > real(0);
    rvec3 o = rvec3(x);
#if GUARD
    return moves && could_meet(TAUT_CONTACT_VERTEX, v, t.a, t.b, t.c, rvec3(a) - o, rvec3(b) - o,
                               rvec3(c) - o, gap);
#else
    Closest near = closest_vertex_triangle(rvec3(a) - o, rvec3(b) - o, rvec3(c) - o);
    return moves && is_near(near.squared, max(apart(v, v, t.a, t.b), apart(v, v, t.c, t.c)), gap);
#endif
}

bool edges_meet(uint p, uint q, uint r, uint s, real gap)
{
    if (p == r || p == s || q == r || q == s)
        return false;
    rvec4 a = position[p];
    rvec4 b = position[q];
    rvec4 c = position[r];
    rvec4 d = position[s];
    bool moves = (a.w + b.w) + (c.w + d.w) > real(0);
    rvec3 o = rvec3(a);
#if GUARD
    return moves &&
           could_meet(TAUT_CONTACT_EDGES, p, q, r, s, rvec3(b) - o, rvec3(c) - o, rvec3(d) - o, gap);
#else
    Closest near = closest_edges(rvec3(b) - o, rvec3(c) - o, rvec3(d) - o);
    return moves && is_near(near.squared, apart(p, q, r, s), gap);
#endif
}

/// Puts the pair down if there is a place for it, and gives the next place.
uint put(uint at, uint a, uint b, uint c, uint d, uint kind)
{
#if FILL
    if (at < capacity)
    {
        ContactPair entry;
        entry.a = a;
        entry.b = b;
        entry.c = c;
        entry.d = d;
        entry.kind = kind;
        pair[at] = entry;
    }
#endif
    return at + 1u;
}

/// The pairs of one triangle's own vertices and sides with another, in the box `least` to `most`; edges once
/// for both.
uint compare(uint at, ContactTriangle t, ContactTriangle u, rvec4 least, rvec4 most, bool edges, real gap)
{
    for (uint k = 0u; k < 3u; ++k)
    {
        uint v = corner_of(t, k);
        if ((t.owns & (1u << k)) != 0u && reaches(v, v, least, most) && vertex_meets(v, u, gap))
            at = put(at, v, u.a, u.b, u.c, TAUT_CONTACT_VERTEX);
    }
    for (uint k = 0u; k < 3u && edges; ++k)
    {
        uint a = corner_of(t, k);
        uint b = corner_of(t, k == 2u ? 0u : k + 1u);
        bool comes = (t.owns & (1u << (TAUT_CONTACT_OWNS_SIDE + k))) != 0u && reaches(a, b, least, most);
        for (uint l = 0u; l < 3u && comes; ++l)
        {
            uint c = corner_of(u, l);
            uint d = corner_of(u, l == 2u ? 0u : l + 1u);
            if ((u.owns & (1u << (TAUT_CONTACT_OWNS_SIDE + l))) != 0u && edges_meet(a, b, c, d, gap))
                at = put(at, a, b, c, d, TAUT_CONTACT_EDGES);
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

KERNEL(count)
{
    ContactTriangle t = triangle[i];
    ContactBody own = body[t.body];
    rvec4 margin = rvec4(rvec3(real(reach)), real(0));
    rvec4 least = node[2u * (leaves + i)] - margin;
    rvec4 most = node[2u * (leaves + i) + 1u] + margin;
#if FILL
    uint first = start[i];
    uint last = start[i + 1u];
#else
    uint first = 0u;
    uint last = 0xffffffffu; // as many as there are
#endif
#if GUARD
    uint spared = 0u;
#else
    uint spared = patch_of(i, t.owns);
#endif
    uint at = first;
    uint tests = 0u;
    uint trips = 0u;
    uint k = 1u;
    bool more = true;
    while (more && at < last && trips < TAUT_CONTACT_TRIPS)
    {
        rvec4 l = node[2u * k];
        rvec4 h = node[2u * k + 1u];
        bool meets = k != spared && l.x <= most.x && l.y <= most.y && l.z <= most.z && h.x >= least.x &&
                     h.y >= least.y && h.z >= least.z;
        trips += 1u;
        if (meets && k >= leaves && k != leaves + i)
        {
            ContactTriangle u = triangle[k - leaves];
            bool same = u.body == t.body;
            ContactBody other = body[u.body];
            bool passes = (own.meets & other.group) == 0u || (other.meets & own.group) == 0u;
            if (same ? own.self != 0u : !passes)
            {
                at = compare(at, t, u, l, h, k - leaves > i, own.radius + other.radius);
                tests += 1u;
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
            more = k > 1u;
        }
    }
#if !FILL
    found[i] = at - first;
    compared[i] = tests;
    COUNT_EVENT_IF(more, lost, TAUT_CONTACT_CUT);
#endif
}
