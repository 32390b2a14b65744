// By how much a Newton step, whole and halved again and again, would raise h^2 times the energy of one kind
// of element: partial sums for every trial, one of the parts that implicit_trial.comp forms.
//
// Based on: implicit_trial.comp; shared/element_rise.glsl.
// Departures: none.
// Bytes per element: its record, and 44 a corner (float).
//! each element of implicit_euler
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/line_search.glsl"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"
#include "shared/element_rise.glsl"

PARAMS
{
    uint count; // elements
    uint chunk; // of them a group
    uint groups;
    uint first;  // trial of this pass; beyond 0 only where all trials before raise the potential
    uint trials; // one more than the last of this pass
    uint part;   // of all parts: which sums to write
    uint parts;
    float scale; // as in implicit_force
    float lift;
};

READ(0, rvec4, position); // m, w = inverse mass 1/kg
READ(1, rvec4, delta);    // m
READ(2, real, x);         // the step, lifted
UPDATE(3, real, partials); // trials of all passes * parts * groups
READ(4, OF_ELEMENT(record), constraint);
READ_ONE(5, StepValues, step_values);

SHARED(real, sum, TAUT_LINEAR_GROUP);
SHARED(real, risen, TAUT_TRIALS);

/// Of the whole step, lifted.
rvec3 step_of(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

rvec3 way(uint from, uint to, real share)
{
    return (step_of(to) - step_of(from)) * (share / real(lift));
}

real rise_of(uint k, real share)
{
    OF_ELEMENT(record) c = constraint[k];
    real h = step_values[0].substep;
    uint v0 = OF_ELEMENT(v0)(c);
    uint v1 = OF_ELEMENT(v1)(c);
    rvec3 e1 = between(v0, v1);
    rvec3 w1 = way(v0, v1, share);
#if ELEMENT_CORNERS == 2
    real rise = element_rise(c, e1, w1, real(lift));
#else
    uint v2 = OF_ELEMENT(v2)(c);
    rvec3 e2 = between(v0, v2);
    rvec3 w2 = way(v0, v2, share);
#if ELEMENT_CORNERS == 3
    real rise = element_rise(c, e1, e2, w1, w2, real(lift));
#else
    uint v3 = OF_ELEMENT(v3)(c);
    rvec3 e3 = between(v0, v3);
    rvec3 w3 = way(v0, v3, share);
    real rise = element_rise(c, e1, e2, e3, w1, w2, w3, real(lift));
#endif
#endif
    return (h * rise) * h;
}

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    SUM_TRIALS(risen, sum, partials, first, parts * groups, tried, found)
    real share = trial_share(first);
    uint end_of_pass = found ? first : trials;
    for (uint trial = first; trial < end_of_pass; ++trial)
    {
        CLEAR_LANES(sum)
        EACH_BEGIN(begin, end)
        sum[lane] += rise_of(uint(i), share) * real(scale);
        EACH_END
        SUM_LANES(sum)
        LANES_BEGIN(1)
        if (group < groups)
            partials[(trial * parts + part) * groups + group] = sum[0];
        LANES_END
        share *= real(0.5);
    }
}
