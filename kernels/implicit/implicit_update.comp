// Takes a Newton step: displacement += step, and clears the solver's vector for the next. With SEARCH the
// step is the first of the trials that does not raise the incremental potential; where all do, none is taken.
// One group per chunk of vertices; every group decides alike.
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed. 2006, 3.1 (backtracking).
// Departures: trials are evaluated in passes (shared/line_search.glsl), and any decrease will do. Where no
//   trial is a number the shortest is taken: a step that is none is seen and counted (finish.comp).
// Bytes per vertex: 28 read, 28 written (float).
//! variant search SEARCH=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/reduce.glsl"
#include "shared/line_search.glsl"

PARAMS
{
    uint count; // vertices
    uint chunk; // of them a group
    uint groups;
    uint trials; // with SEARCH, at most TAUT_TRIALS
    uint parts;
    float lift; // as in implicit_force
};

UPDATE(0, rvec4, delta); // m
UPDATE(1, real, x);      // the step, lifted
#if SEARCH
READ(2, real, partials); // of implicit_trial
SHARED(real, sum, TAUT_LINEAR_GROUP);
SHARED(real, rise, TAUT_TRIALS);
#endif

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    real share = real(1);
#if SEARCH
    SUM_TRIALS(rise, sum, partials, trials, parts * groups, tried, found)
    bool number = false;
    for (uint trial = 0u; trial < tried; ++trial)
        number = number || IS_FINITE(rise[trial]);
    share = found || !number ? trial_share(tried - 1u) : real(0);
#endif
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    EACH_BEGIN(begin, end)
    uint v = uint(i);
    rvec3 s = rvec3(x[3u * v], x[3u * v + 1u], x[3u * v + 2u]);
    delta[v] = delta[v] + rvec4(s * (share / real(lift)), real(0));
    x[3u * v] = real(0);
    x[3u * v + 1u] = real(0);
    x[3u * v + 2u] = real(0);
    EACH_END
}
