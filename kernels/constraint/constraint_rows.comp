// Rows of the system of implicit constraints: the unit direction of each constrained spring and what the
// step would leave of its length, before (further = 0) or after (1) the displacement that is there already.
//
// Based on:
//   Hong, Choi, Jung, Welch, Trapp. An Improved Simulation Method of Deformable Objects Using Implicit
//   Constraint Enforcement (docs/methods/implicit_constraints.md): C(x) + J dx = 0 at the end of the step.
//   Goldenthal et al. Efficient Simulation of Inextensible Cloth. SIGGRAPH 2007: `further`, C and J at the
//   new places (fast projection).
// Departures: a spring of finite stiffness keeps alpha / h^2 on the diagonal (direction.w), and a damper
//   c makes that alpha / (h^2 (1 + c alpha / h)), which is implicit Euler of spring and damper along the
//   row; coincident ends make an empty row and are counted.
// Bytes per row (float): 88 read (92 with KEPT), 20 written.
//! variant kept KEPT=1
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // rows
    uint chunk; // of them a group
    uint further;
    uint report; // 1: count degenerate rows
    uint swing;  // 1: count rows whose ends move apart by more than 0.3 lengths across them
};

READ(0, Spring, row); // stiffness 0 = rigid
READ(1, rvec4, position);
READ(2, rvec4, delta); // displacement of the substep so far, m
READ_ONE(3, StepValues, step_values);
COUNTERS(4, events);
WRITE(5, rvec4, direction); // of unit length, or 0; w = what the spring's own compliance adds to A, 1/kg
WRITE(6, real, b);          // m
#if KEPT
READ(7, real, multiplier); // kg m, of the solves of this substep so far
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    real rate = step_values[0].inverse_substep;
    EACH_BEGIN(begin, end)
    Spring s = row[i];
    rvec3 apart = rvec3(position[s.a]) - rvec3(position[s.b]);
    rvec3 moved = rvec3(delta[s.a]) - rvec3(delta[s.b]);
    rvec3 d = further != 0u ? apart + moved : apart;
    real len = length(d);
    bool usable = len > REAL(1e-18) && len < REAL(1e18); // squares stay normal numbers in float
    rvec3 n = d / (usable ? len : real(1));
    n = usable ? n : rvec3(real(0));
    real compliance = s.stiffness > real(0) ? real(1) / s.stiffness : real(0);
    real damped = (s.damping * compliance) * rate;
    real share = real(1) + damped;
    real scaled = min(compliance * (rate * rate), REAL(1e30));
    real along = dot(n, moved);
    real value = len - s.rest_length;
    value = further != 0u ? value : value + along;
    value += damped * along;
    // Beyond this the direction at the start says little about the length at the end.
    rvec3 across = moved - n * along;
    real limit = REAL(0.3) * s.rest_length;
#if KEPT
    value -= further != 0u ? scaled * multiplier[i] : real(0);
#endif
    direction[i] = rvec4(n, scaled / share);
    b[i] = usable ? value / share : real(0);
    if (report != 0u && !usable && s.rest_length > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    if (swing != 0u && usable && dot(across, across) > limit * limit)
        COUNT_EVENT(events, TAUT_EVENT_SPEED_CLAMP);
    EACH_END
}
