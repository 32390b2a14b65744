// Adds what a solve came to, once it has ended, to the counts of a run. One invocation.
//
// Based on: shared/cg_state.glsl, whose last state this reads.
// Departures: a solve that still went on when its room ended counts as one that ended at its limit, as
//   ConjugateGradient::outcome() says of it.
// Bytes (float): 104 read, 24 read and written.
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count; // 1
};

READ(0, CgState, state);
UPDATE(1, SolveLog, run_log);

KERNEL(count)
{
    uint status = state[i].status;
    uint iterations = state[i].iteration;
    bool limited = status == uint(TAUT_CG_RUNNING) || status == uint(TAUT_CG_ITERATION_LIMIT);
    bool nothing = status == uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE);
    bool good = nothing || limited || status == uint(TAUT_CG_CONVERGED);
    SolveLog counts = run_log[i];
    counts.solves += nothing ? 0u : 1u;
    counts.iterations += iterations;
    counts.most = max(counts.most, iterations);
    counts.limited += limited ? 1u : 0u;
    counts.failed += good ? 0u : 1u;
    counts.last_status = limited ? uint(TAUT_CG_ITERATION_LIMIT) : status;
    run_log[i] = counts;
}
