// Rows of hinges in the system of implicit constraints: the gradients of each dihedral angle and what the
// step would leave of its change, before (further = 0) or after (1) the displacement that is there already.
// Angle and gradients are times a length, so that the row is one of metres like those of springs.
//
// Based on:
//   Bridson, Marino, Fedkiw 2003 (shared/hinge.glsl): the gradients.
//   Hong et al. and Goldenthal et al., as constraint_rows.
// Departures: compliance alpha / h^2 stays on the diagonal; a hinge without an angle (no edge, a wing without
//   a height) makes an empty row and is counted, one whose gradients lie on held corners alone is not; a
//   gradient beyond 1e9 / m is none, since its squares leave float.
// Bytes per row (float): 24 + 128 read (132 with KEPT), 52 written.
//! variant kept KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"
#include "shared/hinge.glsl"

PARAMS
{
    uint count; // hinges
    uint chunk; // of them a group
    uint before; // rows of four corners before them
    uint first; // row of the first of them in b
    uint further;
    uint report; // 1: count degenerate rows
    float scale; // m
};

READ(0, BendingConstraint, hinge); // behind `before` others; compliance of the scaled row, m^2/J
READ(1, rvec4, position);          // w = inverse mass
READ(2, rvec4, delta);             // displacement of the substep so far, m
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
WRITE(5, rvec4, gradient); // 3 a row: of its corners edge1, wing0, wing1; w = what compliance adds to A
WRITE(6, real, b);         // m
#if KEPT
READ(7, real, multiplier); // a row, of the solves of this substep so far
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    real rate = step_values[0].inverse_substep;
    EACH_BEGIN(begin, end)
    uint at = before + uint(i);
    uint row = first + uint(i);
    BendingConstraint c = hinge[at];
    rvec4 p0 = position[c.edge0];
    rvec4 p1 = position[c.edge1];
    rvec4 p2 = position[c.wing0];
    rvec4 p3 = position[c.wing1];
    rvec3 m1 = rvec3(delta[c.edge1]) - rvec3(delta[c.edge0]);
    rvec3 m2 = rvec3(delta[c.wing0]) - rvec3(delta[c.edge0]);
    rvec3 m3 = rvec3(delta[c.wing1]) - rvec3(delta[c.edge0]);
    rvec3 e1 = rvec3(p1) - rvec3(p0);
    rvec3 e2 = rvec3(p2) - rvec3(p0);
    rvec3 e3 = rvec3(p3) - rvec3(p0);
    e1 = further != 0u ? e1 + m1 : e1;
    e2 = further != 0u ? e2 + m2 : e2;
    e3 = further != 0u ? e3 + m3 : e3;
    HingeShape s = hinge_shape(e1, e2, e3);
    real square = (dot(s.edge1, s.edge1) + dot(s.wing0, s.wing0)) + dot(s.wing1, s.wing1);
    bool shaped = s.shaped && square < REAL(1e18);
    real weight = (p0.w * dot(s.edge0, s.edge0) + p1.w * dot(s.edge1, s.edge1)) +
                  (p2.w * dot(s.wing0, s.wing0) + p3.w * dot(s.wing1, s.wing1));
    bool usable = shaped && weight > real(0);
    real soft = scaled_compliance(c.compliance, rate);
    rvec3 g1 = s.edge1 * real(scale);
    rvec3 g2 = s.wing0 * real(scale);
    rvec3 g3 = s.wing1 * real(scale);
    real value = angle_difference(s.angle, c.rest_angle) * real(scale);
    value += further != 0u ? real(0) : (dot(g1, m1) + dot(g2, m2)) + dot(g3, m3);
#if KEPT
    value -= further != 0u ? soft * multiplier[row] : real(0);
#endif
    gradient[3u * at] = usable ? rvec4(g1, soft) : rvec4(rvec3(real(0)), soft);
    gradient[3u * at + 1u] = usable ? rvec4(g2, soft) : rvec4(rvec3(real(0)), soft);
    gradient[3u * at + 2u] = usable ? rvec4(g3, soft) : rvec4(rvec3(real(0)), soft);
    b[row] = usable ? value : real(0);
    if (report != 0u && !shaped && (p0.w + p1.w) + (p2.w + p3.w) > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    EACH_END
}
