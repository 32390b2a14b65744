// Signed distances to a closed surface on a grid, swept over the substep so that vertices do not tunnel.
//
// Based on: Hart. Sphere tracing. The Visual Computer 12, 1996 (on a way, nothing is met within the
//   distance); Fuhrmann, Sobottka, Gross. Distance fields for rapid collision detection in physically based
//   modeling. Graphicon 2003 (the gradient is the way out).
// Departures: a step is at least 1/32 of the way, so a part of the shape that is thinner than that may be
//   passed; the gradient is that of differences over a cell, which does not jump between cells.
//
// In the frame of the grid, which may move and turn, the vertex goes from `a` to `e`, taken as a straight
// way. From outside: if `e` lies inside on the side where the vertex came in, within some 70 degrees, the
// distance there decides; if the way enters and ends on another side (round an edge of a box, too) or outside
// again, the point of entry does. Of ways below half a cell sides are no matter. From inside: the plane below
// `a` that phi says decides, so that the way out of the shape is as limited as it is out of a box.
//! collider each_substep values
#include "shared/turned.glsl"

#define distance_field_record DistanceFieldCollider
#define distance_field_slide slide_of_turned
#define distance_field_way way_of_turned

/// A coordinate in cells, moved into the grid. What is not a number becomes 0, so no index leaves `values`.
real into_grid(real at, uint points)
{
    real inner = SELECT(at > real(0), at, real(0));
    real last = real(points - 1u);
    return SELECT(inner < last, inner, last);
}

real between(real a, real b, real share) { return a + (b - a) * share; }

/// Linear along x from value `o` to the next, along y to the next row.
real in_layer(uint o, uint row, real x, real y)
{
    return between(between(values[o], values[o + 1u], x),
                   between(values[o + row], values[o + row + 1u], x), y);
}

/// phi(p), m: linear along each axis between the eight points round p. Beyond the grid, at q on its border,
/// sqrt((p - q)^2 + phi(q)^2): the surface is no nearer.
real distance_at(DistanceFieldCollider c, rvec3 p)
{
    rvec3 at = (p - rvec3(c.low_x, c.low_y, c.low_z)) / c.cell;
    rvec3 q = rvec3(into_grid(at.x, c.count_x), into_grid(at.y, c.count_y), into_grid(at.z, c.count_z));
    uint i = min(uint(q.x), c.count_x - 2u);
    uint j = min(uint(q.y), c.count_y - 2u);
    uint k = min(uint(q.z), c.count_z - 2u);
    rvec3 share = q - rvec3(real(i), real(j), real(k));
    uint layer = c.count_x * c.count_y;
    uint o = c.first + i + c.count_x * j + layer * k;
    real within = between(in_layer(o, c.count_x, share.x, share.y),
                          in_layer(o + layer, c.count_x, share.x, share.y), share.z);
    rvec3 off = (at - q) * c.cell;
    real beyond = dot(off, off);
    return SELECT(beyond > real(0), sqrt(beyond + within * within), within);
}

/// grad phi / |grad phi| by differences over a cell; upwards where they are 0.
rvec3 out_of_field(DistanceFieldCollider c, rvec3 p)
{
    real h = real(0.5) * c.cell;
    rvec3 x = rvec3(h, real(0), real(0)), y = rvec3(real(0), h, real(0)), z = rvec3(real(0), real(0), h);
    rvec3 slope = rvec3(distance_at(c, p + x) - distance_at(c, p - x),
                        distance_at(c, p + y) - distance_at(c, p - y),
                        distance_at(c, p + z) - distance_at(c, p - z));
    real size = length(slope);
    return SELECT(size > real(0), slope / size, rvec3(real(0), real(1), real(0)));
}

/// When the way from a, outside, comes to where phi is gap_kept; 2 = not before its end.
real entry_into(DistanceFieldCollider c, rvec3 a, rvec3 travel, real before, real gap_kept)
{
    real size = length(travel);
    real outside = real(0), t = real(0), last = before, height = before;
    bool enters = false;
    for (uint s = 0u; s < 32u && !enters && t < real(1); ++s)
    {
        outside = t;
        last = height;
        t = min(t + max(height / size, real(0.03125)), real(1));
        height = distance_at(c, a + travel * t) - gap_kept;
        enters = height <= real(0);
    }
    for (uint s = 0u; s < 40u && enters; ++s)
    {
        real middle = real(0.5) * (outside + t);
        real there = distance_at(c, a + travel * middle) - gap_kept;
        bool in_front = there > real(0);
        outside = in_front ? middle : outside;
        last = in_front ? there : last;
        t = in_front ? t : middle;
        height = in_front ? height : there;
    }
    real fall = last - height; // linear in what is left
    real entry = SELECT(fall > real(0), outside + (t - outside) * (max(last, real(0)) / fall), outside);
    return enters ? entry : real(2);
}

INLINE Contact distance_field_contact(DistanceFieldCollider c, DistanceFieldCollider next, rvec3 x, rvec3 d,
                                      real gap_kept)
{
    rvec3 here = x - CENTRE_OF(c), there = (x - CENTRE_OF(next)) + d;
    rvec3 a = INTO_FRAME(c, here);
    rvec3 e = INTO_FRAME(next, there);
    rvec3 travel = e - a;
    Contact met;
    met.before = distance_at(c, a) - gap_kept;
    met.gap = distance_at(c, e) - gap_kept;
    rvec3 own = rvec3(real(0), real(1), real(0));
    real size = length(travel);
    // Further off nothing is met, and the normal is of no matter.
    bool near = min(met.before, met.gap) < size + c.cell;
    if (near)
        own = out_of_field(c, met.before > real(0) ? e : a);
    if (near && met.before <= real(0))
        met.gap = met.before + dot(own, travel);
    else if (near && size > real(0.5) * c.cell)
    {
        real entry = entry_into(c, a, travel, met.before, gap_kept);
        rvec3 meets = a + travel * min(entry, real(1));
        rvec3 first = out_of_field(c, meets);
        if (entry <= real(1) && (met.gap >= real(0) || dot(first, own) <= real(0.3)))
        {
            own = first;
            met.gap = dot(first, e - meets);
        }
    }
    met.normal = OUT_OF_FRAME(next, own);
    met.motion = OUT_OF_FRAME(next, travel);
    met.friction = c.friction;
    return met;
}
