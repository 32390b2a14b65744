// Spring between two vertices: C = |x1 - x0| - L.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006, section 4.1.
// Departures: the gradients are given undivided, as the difference of the ends: one division serves both.
//! corners 2
//! methods xpbd xpbd_hub pbd pbd_hub
//! with dampers

#define spring_record DistanceConstraint
#define spring_v0(e) (e).a
#define spring_v1(e) (e).b

/// Coincident ends have no direction. e1: from end 0 to end 1, m.
INLINE ElementRow spring_row(DistanceConstraint c, rvec3 e1)
{
    ElementRow row;
    real len = length(e1);
    row.value = len - c.rest_length;
    row.compliance = c.compliance;
    row.divisor = len;
    row.shaped = len > real(0);
    row.counted = c.rest_length > real(0);
    row.g0 = -e1;
    row.g1 = e1;
    row.s0 = real(1);
    row.s1 = real(1);
    return row;
}
