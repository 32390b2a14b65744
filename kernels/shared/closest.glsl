// The nearest points of a vertex and a triangle, and of two edges, as places relative to the first corner:
// differences are taken before anything is multiplied, so that nothing depends on where the scene lies.
//
// Based on: Ericson. Real-Time Collision Detection. 2004, 5.1 (projections on triangles and segments).
// Departures: no region is told by signs. Every candidate (the projection within, and those on the borders)
//   is a pair of points of the two, so that none is nearer than the truth; the nearest wins, the first of
//   equals. Weights within come from N = e0 x e1, not from dot products, which lose the square of the sine.
#ifndef TAUT_SHARED_CLOSEST_GLSL
#define TAUT_SHARED_CLOSEST_GLSL

/// `way` = sum weight_k corner_k is the vector from the point of the second to that of the first, m; the
/// weights add up to 0.
struct Closest
{
    rvec4 weight;
    rvec3 way;
    real squared; // of `way`, m^2
    bool inside;  // within the triangle, or within both edges: not on a border
};

/// Of two pairs of points the nearer one.
INLINE Closest nearer_of(Closest a, Closest b)
{
    bool second = b.squared < a.squared;
    Closest answer;
    answer.weight = second ? b.weight : a.weight;
    answer.way = second ? b.way : a.way;
    answer.squared = second ? b.squared : a.squared;
    answer.inside = second ? b.inside : a.inside;
    return answer;
}

INLINE Closest pair_at(rvec3 way, rvec4 weight, bool inside)
{
    Closest answer;
    answer.weight = weight;
    answer.way = way;
    answer.squared = dot(way, way);
    answer.inside = inside;
    return answer;
}

/// Where `to` projects on the line from 0 along `side`, held within [0, 1].
INLINE real share_along(rvec3 side, rvec3 to)
{
    real squared = dot(side, side);
    return squared > real(0) ? min(max(dot(side, to) / squared, real(0)), real(1)) : real(0);
}

/// The vertex 0 and the triangle a, b, c, places relative to the vertex.
INLINE Closest closest_vertex_triangle(rvec3 a, rvec3 b, rvec3 c)
{
    rvec3 ab = b - a;
    rvec3 ac = c - a;
    rvec3 bc = c - b;
    real t = share_along(ab, -a);
    Closest best = pair_at(-(a + ab * t), rvec4(real(1), t - real(1), -t, real(0)), false);
    t = share_along(bc, -b);
    best = nearer_of(best, pair_at(-(b + bc * t), rvec4(real(1), real(0), t - real(1), -t), false));
    t = share_along(ac, -a);
    best = nearer_of(best, pair_at(-(a + ac * t), rvec4(real(1), t - real(1), real(0), -t), false));
    rvec3 normal = cross(ab, ac);
    real squared = dot(normal, normal);
    real divisor = squared > real(0) ? squared : real(1);
    real v = dot(cross(ac, a), normal) / divisor;
    real w = dot(cross(a, ab), normal) / divisor;
    real u = (real(1) - v) - w;
    bool within = squared > real(0) && u > real(0) && v > real(0) && w > real(0);
    // Across the plane the way is along the normal: of the difference only that part is left.
    rvec3 way = normal * (-dot(normal, a) / divisor);
    if (within)
        best = nearer_of(best, pair_at(way, rvec4(real(1), -u, -v, -w), true));
    best.inside = within; // above a border both candidates are the same to rounding
    return best;
}

/// The edges from 0 to p and from q to r, places relative to the first's beginning.
INLINE Closest closest_edges(rvec3 p, rvec3 q, rvec3 r)
{
    rvec3 side = r - q;
    real t = share_along(side, -q);
    Closest best = pair_at(-(q + side * t), rvec4(real(1), real(0), t - real(1), -t), false);
    t = share_along(side, p - q);
    best = nearer_of(best, pair_at(p - (q + side * t), rvec4(real(0), real(1), t - real(1), -t), false));
    real s = share_along(p, q);
    best = nearer_of(best, pair_at(p * s - q, rvec4(real(1) - s, s, real(-1), real(0)), false));
    s = share_along(p, r);
    best = nearer_of(best, pair_at(p * s - r, rvec4(real(1) - s, s, real(0), real(-1)), false));
    rvec3 normal = cross(p, side);
    real squared = dot(normal, normal);
    real divisor = squared > real(0) ? squared : real(1);
    s = dot(cross(q, side), normal) / divisor;
    t = dot(cross(q, p), normal) / divisor;
    bool within = squared > real(0) && s > real(0) && s < real(1) && t > real(0) && t < real(1);
    rvec3 way = normal * (-dot(normal, q) / divisor);
    if (within)
        best = nearer_of(best, pair_at(way, rvec4(real(1) - s, s, t - real(1), -t), true));
    best.inside = within;
    return best;
}

#endif
