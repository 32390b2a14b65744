// Second half of a constraint-centric Jacobi iteration of PBD: one invocation per vertex averages what its
// constraints wrote into their slots (pbd_stretch and pbd_bend, variant `slots`), in fixed order.
//
// Based on: the averaging pass of the laboratory's GPU solver as described in seed-methods.md 3.5 (sum of the
//   corrections over their number, times 1.5).
// Departures: slots and a gather instead of compare-and-swap additions of floats, so that runs repeat bit for
//   bit; the factor is a setting.
// Bytes per element: 48 read, 16 written, 20 per spring and per hinge (float).
//! variant hinges HINGES=1
//! variant chebyshev CHEBYSHEV=1
//! variant hinges_chebyshev HINGES=1 CHEBYSHEV=1
#include "shared/portable.glsl"

PARAMS
{
    uint count;       // vertices
    float relaxation; // each average times this
    float omega;      // Chebyshev's weight of this iteration
};

READ(0, rvec4, position); // w = inverse mass 1/kg
READ(1, rvec4, delta);    // displacement since the start of the substep, m
#if CHEBYSHEV
UPDATE(2, rvec4, next); // before: the iterate before `delta`
#else
WRITE(2, rvec4, next);
#endif
READ(3, rvec4, spring_correction); // displacement of end a per inverse mass, kg m
// Of vertex v: spring_at[j] = 2 * spring + end, for j from spring_at[v] up to spring_at[v + 1].
READ(4, uint, spring_at);
#if HINGES
READ(5, rvec4, hinge_correction);
READ(6, uint, hinge_at); // the same, 4 * hinge + corner
#endif

#include "shared/pbd_jacobi.glsl"

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    uint constraints = spring_at[i + 1u] - spring_at[i];
    for (uint j = spring_at[i]; j < spring_at[i + 1u]; ++j)
    {
        uint entry = spring_at[j];
        rvec3 wanted = rvec3(spring_correction[entry / 2u]);
        sum += entry % 2u == 0u ? wanted : -wanted;
    }
#if HINGES
    constraints += hinge_at[i + 1u] - hinge_at[i];
    for (uint j = hinge_at[i]; j < hinge_at[i + 1u]; ++j)
        sum += rvec3(hinge_correction[hinge_at[j]]);
#endif
    rvec4 better = jacobi_step(delta[i], sum, constraints, position[i].w);
#if CHEBYSHEV
    better = chebyshev_step(better, next[i], position[i].w);
#endif
    next[i] = better;
}
