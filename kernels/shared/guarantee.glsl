// What the kernels of the guarantee share: which ways count, how far from them is how far, and directions
// that tell the two of a pair apart.
//
// Based on: the separating axis theorem for convex polytopes (Gottschalk, Lin, Manocha. OBBTree. SIGGRAPH
//   1996, section 5): normals of faces and cross products of edges are enough.
// Departures: the way between the nearest points comes first, since it is the widest; every direction is
//   judged by what it does to all four corners, so none has to be right.
#ifndef TAUT_SHARED_GUARANTEE_GLSL
#define TAUT_SHARED_GUARANTEE_GLSL

/// Half an ulp of 1.
real rounding_unit()
{
#if TAUT_REAL_DOUBLE
    return REAL(1.1102230246251565e-16);
#else
    return REAL(5.9604644775390625e-8);
#endif
}

/// Whether `finish` will take the displacement d of a vertex at x.
INLINE rbool is_sound(rvec3 x, rvec3 d)
{
    real size = abs(d.x) + abs(d.y) + abs(d.z) + abs(x.x) + abs(x.y) + abs(x.z);
    return size < REAL(1e18);
}

/// The displacement of a vertex at x, or none where it will not be taken.
INLINE rvec3 sound_way(rvec3 x, rvec3 d)
{
    return SELECT(is_sound(x, d), d, rvec3(real(0)));
}

/// Beside its forecast a vertex may go so much further from it, times the forecast.
real sway()
{
    return REAL(0.1);
}

/// From the line of a forecast, which begins at 0, to p.
INLINE real beyond_forecast(rvec3 p, rvec3 forecast)
{
    real squared = dot(forecast, forecast);
    real share = SELECT(squared > real(0), min(max(dot(p, forecast) / squared, real(0)), real(1)), real(0));
    return length(p - forecast * share);
}

/// Whether a way that ends at p keeps to the bound of guarantee_anchor; below 0 there is none to keep to.
INLINE rbool keeps_to(rvec3 p, rvec3 forecast, real bound)
{
    return bound >= real(0) && beyond_forecast(p, forecast) <= bound;
}

INLINE real greatest_of(rvec3 v)
{
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

/// A direction from the second of a pair to the first, and the heights of the corners along it, that of the
/// corner a being 0.
struct Separator
{
    rvec3 normal; // unit, or 0
    real height_b, height_c, height_d; // m
    real low;  // of the first, m
    real high; // of the second, m
    real gap;  // low - high, m
};

INLINE Separator separator_of_two(rbool second, Separator a, Separator b)
{
    Separator answer;
    answer.normal = SELECT(second, b.normal, a.normal);
    answer.height_b = SELECT(second, b.height_b, a.height_b);
    answer.height_c = SELECT(second, b.height_c, a.height_c);
    answer.height_d = SELECT(second, b.height_d, a.height_d);
    answer.low = SELECT(second, b.low, a.low);
    answer.high = SELECT(second, b.high, a.high);
    answer.gap = SELECT(second, b.gap, a.gap);
    return answer;
}

INLINE Separator wider_of(Separator a, Separator b)
{
    return separator_of_two(b.gap > a.gap, a, b);
}

/// The pair along an axis, the way round that parts it further.
INLINE Separator separator_along(rvec3 axis, rvec3 e1, rvec3 e2, rvec3 e3, rbool edges)
{
    real size = length(axis);
    rbool shaped = size > real(0);
    rvec3 normal = SELECT(shaped, axis / SELECT(shaped, size, real(1)), rvec3(real(0)));
    real hb = dot(normal, e1);
    real hc = dot(normal, e2);
    real hd = dot(normal, e3);
    real least = min(hc, hd);
    real most = max(hc, hd);
    real first_low = SELECT(edges, min(real(0), hb), real(0));
    real first_high = SELECT(edges, max(real(0), hb), real(0));
    real second_low = SELECT(edges, least, min(hb, least));
    real second_high = SELECT(edges, most, max(hb, most));
    rbool ahead = first_low - second_high >= second_low - first_high;
    Separator answer;
    answer.normal = SELECT(ahead, normal, -normal);
    answer.height_b = SELECT(ahead, hb, -hb);
    answer.height_c = SELECT(ahead, hc, -hc);
    answer.height_d = SELECT(ahead, hd, -hd);
    answer.low = SELECT(ahead, first_low, -first_high);
    answer.high = SELECT(ahead, second_high, -second_low);
    answer.gap = answer.low - answer.high;
    return answer;
}

/// The part of v across an edge.
INLINE rvec3 across_edge(rvec3 v, rvec3 edge)
{
    real squared = dot(edge, edge);
    real divisor = SELECT(squared > real(0), squared, real(1));
    return SELECT(squared > real(0), v - edge * (dot(edge, v) / divisor), v);
}

/// The widest of the directions that may tell a vertex from a triangle, both relative to the vertex.
INLINE Separator separator_of_vertex(rvec3 way, rvec3 a, rvec3 b, rvec3 c)
{
    rvec3 ab = b - a;
    rvec3 bc = c - b;
    rvec3 ca = a - c;
    rvec3 normal = cross(ab, c - a);
    Separator best = separator_along(normal, a, b, c, rbool(false));
    best = wider_of(best, separator_along(across_edge(way, ab), a, b, c, rbool(false)));
    best = wider_of(best, separator_along(across_edge(way, bc), a, b, c, rbool(false)));
    best = wider_of(best, separator_along(across_edge(way, ca), a, b, c, rbool(false)));
    best = wider_of(best, separator_along(cross(ab, normal), a, b, c, rbool(false)));
    best = wider_of(best, separator_along(cross(bc, normal), a, b, c, rbool(false)));
    return wider_of(best, separator_along(cross(ca, normal), a, b, c, rbool(false)));
}

/// The same of the edges from 0 to p and from q to r.
INLINE Separator separator_of_edges(rvec3 way, rvec3 p, rvec3 q, rvec3 r)
{
    rvec3 side = r - q;
    rvec3 normal = cross(p, side);
    Separator best = separator_along(normal, p, q, r, rbool(true));
    best = wider_of(best, separator_along(across_edge(way, p), p, q, r, rbool(true)));
    best = wider_of(best, separator_along(across_edge(way, side), p, q, r, rbool(true)));
    best = wider_of(best, separator_along(across_edge(across_edge(way, p), side), p, q, r, rbool(true)));
    best = wider_of(best, separator_along(cross(p, normal), p, q, r, rbool(true)));
    return wider_of(best, separator_along(cross(side, normal), p, q, r, rbool(true)));
}

#endif
