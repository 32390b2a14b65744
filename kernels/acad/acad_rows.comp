// The rows of the springs that are constraints, side by side, as the passes of a solve want them.
//
// Based on: docs/methods/acad.md; Tournier, Nesme, Gilles, Faure. Stable Constrained Dynamics. ACM TOG 34(4),
//   2015 (the force of a constraint across its direction is explicit, and unstable from a size on).
// Departures: rows far beyond what they aim at are softened until that force is small enough, never below the
//   spring itself, and come back no faster than the spring would pull; Tournier adds the stiffness across.
//   What is small enough goes by the shorter of length and aim: force over length is what acts across.
// Bytes per row (float): 88 read, 32 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // most rows there may be
    uint chunk; // of them a group
    uint further; // 1: not the first solve of the substep, so it starts from 0
};

READ(0, uint, row_list); // how many, then 2 * spring, and 1 more for a compressed one
// Two a spring: the constraint (rest_length: what it aims at when stretched, and as far below the length at
// rest when compressed; stiffness 0: rigid), and the spring, with the inverse of the constraint's diagonal
// [kg] as damping and the most springs at one of its ends as kind.
READ(1, Spring, candidate);
READ(2, real, multiplier); // kg m, a spring
WRITE(3, Spring, row);
WRITE(4, real, x);
WRITE(5, real, inverse);  // kg
READ(6, rvec4, position); // m, at the start of the substep
READ_ONE(7, StepValues, step_values);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint rows = min(count, row_list[0]);
    uint begin = min(group * chunk, rows);
    uint end = min(begin + chunk, rows);
    real rate = step_values[0].inverse_substep;
    real rates = rate * rate;
    EACH_BEGIN(begin, end)
    uint entry = row_list[i + 1u];
    uint s = entry >> 1u;
    bool pressed = (entry & 1u) != 0u;
    Spring r = candidate[2u * s];
    Spring own = candidate[2u * s + 1u];
    real found = own.damping;
    rvec4 a = position[r.a];
    rvec4 b = position[r.b];
    real weight = a.w + b.w;
    real len = length(rvec3(a) - rvec3(b));
    PRECISE real mirrored = own.rest_length - (r.rest_length - own.rest_length);
    r.rest_length = pressed ? mirrored : r.rest_length;
    real nearest = max(len, REAL(1e-6) * r.rest_length);
    real over = (pressed ? r.rest_length / nearest : len / r.rest_length) - real(1);
    if (over > REAL(0.02) && weight > real(0))
    {
        // Of the way back, in a substep.
        PRECISE real share = min(sqrt(own.stiffness * weight) / rate, real(1));
        PRECISE real give = ((real(0.5) * real(own.kind)) * (share * weight)) * (over + REAL(0.2));
        PRECISE real both = own.stiffness / share + rates / give;
        real stiff = r.stiffness > real(0) ? min(both, r.stiffness) : both; // N/m
        PRECISE real held = (own.stiffness * (r.rest_length - own.rest_length)) / stiff; // m
        PRECISE real aim = (len - share * (len - r.rest_length)) - held;
        PRECISE real diagonal = weight + rates / (stiff + r.damping * rate);
        r.rest_length = aim;
        r.stiffness = stiff;
        found = real(1) / diagonal;
    }
    row[i] = r;
    x[i] = further != 0u ? real(0) : multiplier[s];
    inverse[i] = found;
    EACH_END
}
