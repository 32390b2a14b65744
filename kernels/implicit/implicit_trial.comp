// By how much a Newton step, whole and halved again and again, would raise the incremental potential
// 1/2 |displacement - guess|_M^2 + h^2 (energy of springs, tetrahedra and other elements): partial sums for
// every trial, of vertices (no variant), springs, tetrahedra; those of others are implicit_euler_rise.comp's.
// Differences are formed element by element, so that they are not lost in the potential itself.
//
// Based on: Martin et al. Example-Based Elastic Materials. SIGGRAPH 2011, eq. 2.
// Departures: a damper counts with the direction that its spring has before the step.
// Bytes per vertex 60, per spring end 60 and a spring 24, per corner of a tetrahedron 44 and a tetrahedron 72
// (float).
//! variant springs SPRINGS=1
//! variant solids SOLIDS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/line_search.glsl"
#if SOLIDS
#include "shared/solid.glsl"
#endif
#include "shared/rise.glsl"

PARAMS
{
    uint count; // vertices, springs or tetrahedra
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
#if SPRINGS
READ(4, Spring, spring);
READ_ONE(5, StepValues, step_values);
READ(6, rvec4, low); // m
#elif SOLIDS
READ(4, SolidTetrahedron, solid);
READ_ONE(5, StepValues, step_values);
#else
READ(4, rvec4, predicted); // m
#endif

SHARED(real, sum, TAUT_LINEAR_GROUP);
SHARED(real, risen, TAUT_TRIALS);

/// Of the whole step, lifted.
rvec3 step_of(uint i) { return rvec3(x[3u * i], x[3u * i + 1u], x[3u * i + 2u]); }

#if SPRINGS
real rise_of(uint k, real share)
{
    Spring s = spring[k];
    real h = step_values[0].substep;
    rvec3 d = rvec3(position[s.a] - position[s.b]) + rvec3(delta[s.a] - delta[s.b]);
    rvec3 w = (step_of(s.a) - step_of(s.b)) * share;
    rvec3 before = rvec3(delta[s.a] - delta[s.b]) - rvec3(low[s.a] - low[s.b]);
    real len = length(d);
    real after = length(d + w / real(lift));
    real both = len + after;
    real longer = lengthening(d, w, both, real(lift));
    real stretch = ((both - s.rest_length) - s.rest_length) * real(lift);
    real elastic = real(0.5) * ((h * s.stiffness) * h) * (longer * stretch);
    real along = len > real(0) ? dot(d, w) / len : real(0);
    real gone = len > real(0) ? dot(d, before) / len * real(lift) : real(0);
    return elastic + (h * s.damping) * (along * (gone + real(0.5) * along));
}
#elif SOLIDS
rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

real rise_of(uint k, real share)
{
    SolidTetrahedron t = solid[k];
    real h = step_values[0].substep;
    Deformation f = deformation_of(t, between(t.a, t.b), between(t.a, t.c), between(t.a, t.d));
    rvec3 base = step_of(t.a);
    real rise = solid_rise(t, f, (step_of(t.b) - base) * share, (step_of(t.c) - base) * share,
                           (step_of(t.d) - base) * share, real(lift));
    return ((h * t.volume) * h) * rise;
}
#else
real rise_of(uint i, real share)
{
    real weight = position[i].w;
    rvec3 s = step_of(i) * share;
    rvec3 lag = rvec3(delta[i] - predicted[i]) * real(lift);
    return weight > real(0) ? (dot(lag, s) + real(0.5) * dot(s, s)) / weight : real(0);
}
#endif

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
