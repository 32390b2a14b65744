// What a solve by conjugate gradients decides, once an iteration and by every group alike.
//
// Based on:
//   Hestenes, Stiefel. Methods of Conjugate Gradients for Solving Linear Systems. 1952. (alpha, beta)
//   van der Vorst, Ye. Residual Replacement Strategies for Krylov Subspace Iterative Methods. SISC 2000, and
//   Clark et al. Solving Lattice QCD Systems of Equations using Mixed Precision Solvers on GPUs. CPC 2010,
//   section 4: the residual is formed anew when it has fallen by a set factor (reliable updates).
//   Steihaug. The Conjugate Gradient Method and Trust Regions. SINUM 1983: p.Mp by recurrence.
// Departures: nothing is accepted as converged before the residual was formed anew; a curvature that
//   rounding cannot tell from zero ends a direction instead of the solve, and the solve only if it comes
//   with the steepest descent of a residual just formed. Where r.M^-1 r underflows the solve has nothing left
//   to do: that is what a body at rest leaves, rounding alone, and no fault of the preconditioner.
#ifndef TAUT_SHARED_CG_STATE_GLSL
#define TAUT_SHARED_CG_STATE_GLSL

// Checks without progress before a solve is given up.
#define TAUT_CG_STALLS 3u
// An rr below which, times the diagonal of a stiff M^-1, float underflows: 2^-96, of |r| = 2^-48.
#define TAUT_CG_NOTHING 1.262177448e-29

/// Before a direction is made: `s` is what cg_step or cg_restart left, rz and rr are of the residual in hand.
/// On return s.status says whether to go on, `replace` whether the residual is wanted anew first, and
/// `keep` whether the step in hand may be added to x.
CgState cg_next(CgState s, real rz, real rr, real bb, INOUT(bool) replace, INOUT(bool) keep)
{
    replace = false;
    keep = true;
    // A residual formed anew that is far above what the recurrence had: the directions belong to another one.
    bool drifted = s.fresh != 0u && s.begun != 0u && rr > real(4) * s.rr;
    bool checked = s.fresh != 0u && s.begun != 0u;
    if (s.begun == 0u)
    {
        s.begun = 1u;
        s.bb = bb;
        s.peak = rr;
        s.lowest = rr;
        s.best = rr;
        s.growth_squared *= max(bb, rr);
    }
    s.rr = rr;
    if (s.status != uint(TAUT_CG_RUNNING))
        return s;
    if (!IS_FINITE(rr) || !IS_FINITE(rz) || !IS_FINITE(s.bb))
    {
        s.status = uint(TAUT_CG_NON_FINITE);
        keep = false;
    }
    else if (s.bb == real(0))
        s.status = uint(TAUT_CG_ZERO_RIGHT_HAND_SIDE);
    else if (rr > s.growth_squared)
    {
        s.status = uint(TAUT_CG_RAN_AWAY);
        keep = false;
    }
    else if (rr <= s.tolerance_squared * s.bb || (rz == real(0) && rr < real(TAUT_CG_NOTHING)))
    {
        if (s.fresh != 0u)
            s.status = uint(TAUT_CG_CONVERGED);
        replace = s.fresh == 0u;
    }
    else if (rz <= real(0))
    {
        s.status = uint(TAUT_CG_INDEFINITE_PRECONDITIONER);
        s.rz = rz;
    }
    else if (s.iteration >= s.iteration_limit)
    {
        if (s.fresh != 0u)
            s.status = uint(TAUT_CG_ITERATION_LIMIT);
        replace = s.fresh == 0u;
    }
    else if (s.exhausted != 0u)
    {
        if (s.direction == uint(TAUT_DIRECTION_STEEPEST))
            s.status = uint(TAUT_CG_EXHAUSTED);
        replace = s.status == uint(TAUT_CG_RUNNING);
        s.direction = uint(TAUT_DIRECTION_NONE);
    }
    else if (checked)
    {
        s.stalls = rr < real(0.25) * s.best ? 0u : s.stalls + 1u;
        if (s.stalls >= TAUT_CG_STALLS)
            s.status = uint(TAUT_CG_STALLED);
        if (drifted)
            s.direction = uint(TAUT_DIRECTION_NONE);
    }
    else if (rr < s.replacement_squared * s.peak || s.waited >= s.patience)
        replace = true;
    if (s.fresh != 0u)
    {
        s.peak = rr;
        s.lowest = rr;
        s.best = min(s.best, rr);
        s.waited = 0u;
    }
    s.peak = max(s.peak, rr);
    s.waited = rr < s.lowest ? 0u : s.waited + 1u;
    s.lowest = min(s.lowest, rr);
    return s;
}

/// After cg_next when a direction is made: returns beta.
real cg_turn(INOUT(CgState) s, real rz)
{
    bool alone = s.direction == uint(TAUT_DIRECTION_NONE);
    real beta = alone ? real(0) : rz / s.rz;
    s.rz = rz;
    s.pmp = rz + beta * beta * s.pmp;
    s.iteration += 1u;
    s.direction = alone && s.fresh != 0u ? uint(TAUT_DIRECTION_STEEPEST) : uint(TAUT_DIRECTION_CONJUGATE);
    s.fresh = 0u;
    return beta;
}

/// After q = A p: what to do with the curvature p.q. On return s.step is alpha, or 0 with the reason in
/// s.status or s.exhausted.
CgState cg_measure(CgState s, real curvature)
{
    s.curvature = curvature;
    s.step = real(0);
    real bend = abs(curvature);
    if (!IS_FINITE(curvature))
        s.status = uint(TAUT_CG_NON_FINITE);
    else
    {
        s.steepest = s.pmp > real(0) ? max(s.steepest, bend / s.pmp) : s.steepest;
        real doubt = s.epsilon * s.steepest * s.pmp;
        if (curvature < real(-256) * doubt)
            s.status = uint(TAUT_CG_INDEFINITE_MATRIX);
        else if (curvature > doubt && IS_FINITE(s.rz / curvature))
            s.step = s.rz / curvature;
        else
            s.exhausted = 1u;
    }
    return s;
}

/// An entry of the residual after a step along q = A p. Without a step q may be anything, infinite too.
real cg_advance(real residual, real step, real product)
{
    PRECISE real advanced = residual - step * product;
    return step != real(0) ? advanced : residual;
}

/// What the history tells of an iteration: the bits of |r| / |b|, 0 where b is 0.
uint cg_history_word(CgState s)
{
    return floatBitsToUint(s.bb > real(0) ? float(sqrt(s.rr / s.bb)) : 0.0f);
}

#endif
