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
    real weight_a, weight_b, weight_c, weight_d;
    rvec3 way;
    real squared; // of `way`, m^2
    rbool inside; // within the triangle, or within both edges: not on a border
};

INLINE Closest pair_at(rvec3 way, real weight_a, real weight_b, real weight_c, real weight_d)
{
    Closest answer;
    answer.weight_a = weight_a;
    answer.weight_b = weight_b;
    answer.weight_c = weight_c;
    answer.weight_d = weight_d;
    answer.way = way;
    answer.squared = dot(way, way);
    answer.inside = rbool(false);
    return answer;
}

/// The second of two pairs of points where `second` says so.
INLINE Closest closest_of_two(rbool second, Closest a, Closest b)
{
    Closest answer;
    answer.weight_a = SELECT(second, b.weight_a, a.weight_a);
    answer.weight_b = SELECT(second, b.weight_b, a.weight_b);
    answer.weight_c = SELECT(second, b.weight_c, a.weight_c);
    answer.weight_d = SELECT(second, b.weight_d, a.weight_d);
    answer.way = SELECT(second, b.way, a.way);
    answer.squared = SELECT(second, b.squared, a.squared);
    answer.inside = (second && b.inside) || (!second && a.inside);
    return answer;
}

INLINE Closest nearer_of(Closest a, Closest b)
{
    return closest_of_two(b.squared < a.squared, a, b);
}

/// Where `to` projects on the line from 0 along `side`, held within [0, 1].
INLINE real share_along(rvec3 side, rvec3 to)
{
    real squared = dot(side, side);
    return SELECT(squared > real(0), min(max(dot(side, to) / squared, real(0)), real(1)), real(0));
}

/// The vertex 0 and the triangle a, b, c, places relative to the vertex.
INLINE Closest closest_vertex_triangle(rvec3 a, rvec3 b, rvec3 c)
{
    rvec3 ab = b - a;
    rvec3 ac = c - a;
    rvec3 bc = c - b;
    real t = share_along(ab, -a);
    Closest best = pair_at(-(a + ab * t), real(1), t - real(1), -t, real(0));
    t = share_along(bc, -b);
    best = nearer_of(best, pair_at(-(b + bc * t), real(1), real(0), t - real(1), -t));
    t = share_along(ac, -a);
    best = nearer_of(best, pair_at(-(a + ac * t), real(1), t - real(1), real(0), -t));
    rvec3 normal = cross(ab, ac);
    real squared = dot(normal, normal);
    real divisor = SELECT(squared > real(0), squared, real(1));
    real v = dot(cross(ac, a), normal) / divisor;
    real w = dot(cross(a, ab), normal) / divisor;
    real u = (real(1) - v) - w;
    rbool within = squared > real(0) && u > real(0) && v > real(0) && w > real(0);
    // Across the plane the way is along the normal: of the difference only that part is left.
    rvec3 way = normal * (-dot(normal, a) / divisor);
    if (ANY(within))
    {
        Closest across = pair_at(way, real(1), -u, -v, -w);
        best = closest_of_two(within && across.squared < best.squared, best, across);
    }
    best.inside = within; // above a border both candidates are the same to rounding
    return best;
}

/// The edges from 0 to p and from q to r, places relative to the first's beginning.
INLINE Closest closest_edges(rvec3 p, rvec3 q, rvec3 r)
{
    rvec3 side = r - q;
    real t = share_along(side, -q);
    Closest best = pair_at(-(q + side * t), real(1), real(0), t - real(1), -t);
    t = share_along(side, p - q);
    best = nearer_of(best, pair_at(p - (q + side * t), real(0), real(1), t - real(1), -t));
    real s = share_along(p, q);
    best = nearer_of(best, pair_at(p * s - q, real(1) - s, s, real(-1), real(0)));
    s = share_along(p, r);
    best = nearer_of(best, pair_at(p * s - r, real(1) - s, s, real(0), real(-1)));
    rvec3 normal = cross(p, side);
    real squared = dot(normal, normal);
    real divisor = SELECT(squared > real(0), squared, real(1));
    s = dot(cross(q, side), normal) / divisor;
    t = dot(cross(q, p), normal) / divisor;
    rbool within = squared > real(0) && s > real(0) && s < real(1) && t > real(0) && t < real(1);
    rvec3 way = normal * (-dot(normal, q) / divisor);
    if (ANY(within))
    {
        Closest across = pair_at(way, real(1) - s, s, t - real(1), -t);
        best = closest_of_two(within && across.squared < best.squared, best, across);
    }
    best.inside = within;
    return best;
}

/// Of a vertex and a triangle, or of two edges: corners b, c and d relative to a.
INLINE Closest closest_of_pair(rbool edges, rvec3 e1, rvec3 e2, rvec3 e3)
{
    Closest answer = pair_at(rvec3(real(0)), real(0), real(0), real(0), real(0));
    if (ANY(!edges))
        answer = closest_vertex_triangle(e1, e2, e3);
    if (ANY(edges))
        answer = closest_of_two(edges, answer, closest_edges(e1, e2, e3));
    return answer;
}

#endif
