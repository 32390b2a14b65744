// Rows of tetrahedra in the system of implicit constraints: the gradient of each volume and what the step
// would leave of its change, before (further = 0) or after (1) the displacement that is there already.
//
// Based on:
//   Va, Choi, Hong. Real-time Volume Preserving Constraints for Volumetric Model on GPU. CMC 73(1), 2022: a
//     row a tetrahedron beside the rows of its edges, C = V - V0.
//   Hong et al. and Goldenthal et al., as constraint_rows.
// Departures: compliance alpha / h^2 stays on the diagonal; a tetrahedron collapsed to a line makes an empty
//   row and is counted.
// Bytes per row (float): 24 + 128 read (132 with KEPT), 52 written.
//! variant kept KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/compliance.glsl"

PARAMS
{
    uint count; // tetrahedra
    uint chunk; // of them a group
    uint first; // row of the first of them: rows of springs come before
    uint further;
    uint report; // 1: count degenerate rows
};

READ(0, VolumeConstraint, tetrahedron);
READ(1, rvec4, position);
READ(2, rvec4, delta); // displacement of the substep so far, m
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
WRITE(5, rvec4, gradient); // m^2, 3 a tetrahedron: of its corners b, c, d; w = what compliance adds to A
WRITE(6, real, b);         // m^3
#if KEPT
READ(7, real, multiplier); // a row, of the solves of this substep so far
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    real rate = step_values[0].inverse_substep;
    EACH_BEGIN(begin, end)
    VolumeConstraint t = tetrahedron[i];
    rvec3 m1 = rvec3(delta[t.b]) - rvec3(delta[t.a]);
    rvec3 m2 = rvec3(delta[t.c]) - rvec3(delta[t.a]);
    rvec3 m3 = rvec3(delta[t.d]) - rvec3(delta[t.a]);
    rvec3 e1 = rvec3(position[t.b]) - rvec3(position[t.a]);
    rvec3 e2 = rvec3(position[t.c]) - rvec3(position[t.a]);
    rvec3 e3 = rvec3(position[t.d]) - rvec3(position[t.a]);
    e1 = further != 0u ? e1 + m1 : e1;
    e2 = further != 0u ? e2 + m2 : e2;
    e3 = further != 0u ? e3 + m3 : e3;
    rvec3 g1 = cross(e2, e3) * REAL(0.16666666666666666667);
    rvec3 g2 = cross(e3, e1) * REAL(0.16666666666666666667);
    rvec3 g3 = cross(e1, e2) * REAL(0.16666666666666666667);
    real square = (dot(g1, g1) + dot(g2, g2)) + dot(g3, g3);
    bool usable = square > real(0) && square < REAL(1e36);
    real soft = scaled_compliance(t.compliance, rate);
    real value = dot(e1, g1) - t.rest_volume;
    value += further != 0u ? real(0) : (dot(g1, m1) + dot(g2, m2)) + dot(g3, m3);
#if KEPT
    value -= further != 0u ? soft * multiplier[first + uint(i)] : real(0);
#endif
    gradient[3u * i] = usable ? rvec4(g1, soft) : rvec4(rvec3(real(0)), soft);
    gradient[3u * i + 1u] = usable ? rvec4(g2, soft) : rvec4(rvec3(real(0)), soft);
    gradient[3u * i + 2u] = usable ? rvec4(g3, soft) : rvec4(rvec3(real(0)), soft);
    b[first + uint(i)] = usable ? value : real(0);
    if (report != 0u && !usable)
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    EACH_END
}
