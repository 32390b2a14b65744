// Whether a vertex and a triangle, or two edges, may come within their gap before the next search
// (contact_search says by which rule; GUARD: by that of the guarantee).
#ifndef TAUT_SHARED_CONTACT_NEAR_GLSL
#define TAUT_SHARED_CONTACT_NEAR_GLSL

#include "shared/closest.glsl"

/// A corner and its displacement in the first substep.
struct Corner
{
    rvec3 x;   // m
    rvec3 way; // m
    real size; // GUARD: of the way, m
};

/// A vertex a and a triangle b, c, d, or two edges, a-b and c-d.
struct Meeting
{
    Corner a, b, c, d;
    bool edges;
};

INLINE Closest nearest_of(bool edges, rvec3 eb, rvec3 ec, rvec3 ed)
{
    if (edges)
        return closest_edges(eb, ec, ed);
    return closest_vertex_triangle(eb, ec, ed);
}

#if GUARD
/// How far a corner may stray in a substep from the mean way.
INLINE real stray(Corner c, rvec3 mean)
{
    return length(c.way - mean) + sway() * c.size;
}

INLINE rvec3 across(rvec3 x, rvec3 direction)
{
    return x - direction * dot(x, direction);
}

/// `pair_reach`: both radii and the skin, m. `substeps`: until the next search.
INLINE bool could_meet(Meeting m, real pair_reach, real substeps)
{
    rvec3 mean = ((m.a.way + m.b.way) + (m.c.way + m.d.way)) * real(0.25);
    real first = stray(m.a, mean);
    real other = stray(m.b, mean);
    real second = max(stray(m.c, mean), stray(m.d, mean));
    if (m.edges)
        first = max(first, other);
    else
        second = max(second, other);
    real reached = pair_reach + (first + second) * substeps;
    real speed = length(mean);
    real all = reached + speed * substeps;
    rvec3 eb = m.b.x - m.a.x; // relative to the first corner: nothing depends on where the scene lies
    rvec3 ec = m.c.x - m.a.x;
    rvec3 ed = m.d.x - m.a.x;
    real squared = nearest_of(m.edges, eb, ec, ed).squared;
    bool comes = squared < all * all;
    // No projection is longer than the distance: what is within `reached` need not be projected.
    if (comes && squared >= reached * reached && speed > real(0))
    {
        rvec3 u = mean / speed;
        comes = nearest_of(m.edges, across(eb, u), across(ec, u), across(ed, u)).squared < reached * reached;
    }
    return comes;
}
#else
/// Without the guarantee nothing goes beside its way.
real sway()
{
    return real(0);
}

INLINE real apart_squared(Corner a, Corner b)
{
    rvec3 d = a.way - b.way;
    return dot(d, d);
}

/// `pair_reach`: both radii and the skin, m. `substeps`: until the next search.
INLINE bool could_meet(Meeting m, real pair_reach, real substeps)
{
    real motion = max(apart_squared(m.a, m.c), apart_squared(m.a, m.d));
    if (m.edges)
        motion = max(motion, max(apart_squared(m.b, m.c), apart_squared(m.b, m.d)));
    else
        motion = max(motion, apart_squared(m.a, m.b));
    real reached = pair_reach + sqrt(motion) * substeps;
    return nearest_of(m.edges, m.b.x - m.a.x, m.c.x - m.a.x, m.d.x - m.a.x).squared < reached * reached;
}
#endif

#endif
