// Second half of a constraint-centric Jacobi iteration of PBD: one invocation per vertex averages what its
// constraints wrote into their slots (pbd_stretch, pbd_bend, pbd_volume, variant `slots`), in fixed order.
//
// Based on: constraint-centric Jacobi as GPU solvers of position-based dynamics average it (sum of the
//   corrections over their number, times 1.5).
// Departures: slots and a gather instead of compare-and-swap additions of floats, so that runs repeat bit for
//   bit; the factor is a setting.
// Bytes per element: 48 read, 16 written, 20 per spring, hinge and tetrahedron (float).
//! variant hinges HINGES=1
//! variant volumes VOLUMES=1
//! variant hinges_volumes HINGES=1 VOLUMES=1
//! variant chebyshev CHEBYSHEV=1
//! variant hinges_chebyshev HINGES=1 CHEBYSHEV=1
//! variant volumes_chebyshev VOLUMES=1 CHEBYSHEV=1
//! variant hinges_volumes_chebyshev HINGES=1 VOLUMES=1 CHEBYSHEV=1
#include "shared/portable.glsl"

PARAMS
{
    uint count;       // vertices
    float relaxation; // each average times this
    float omega;      // Chebyshev's weight of this iteration
    uint hinges_at;   // where in `at` the list of hinges begins
    uint volumes_at;  // and that of tetrahedra
};

READ(0, rvec4, position); // w = inverse mass 1/kg
READ(1, rvec4, delta);    // displacement since the start of the substep, m
#if CHEBYSHEV
UPDATE(2, rvec4, next); // before: the iterate before `delta`
#else
WRITE(2, rvec4, next);
#endif
READ(3, rvec4, spring_correction); // displacement of end a per inverse mass, kg m
// Of vertex v: at[j] = 2 * spring + end, for j from at[v] up to at[v + 1]; from at[hinges_at + v] on the
// same, 4 * hinge + corner, and from at[volumes_at + v] on 4 * tetrahedron + corner.
READ(4, uint, at);
#if VOLUMES
READ(5, rvec4, volume_correction);
#if HINGES
READ(6, rvec4, hinge_correction);
#endif
#elif HINGES
READ(5, rvec4, hinge_correction);
#endif

#include "shared/pbd_jacobi.glsl"

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    uint constraints = at[i + 1u] - at[i];
    for (uint j = at[i]; j < at[i + 1u]; ++j)
    {
        uint entry = at[j];
        rvec3 wanted = rvec3(spring_correction[entry / 2u]);
        sum += entry % 2u == 0u ? wanted : -wanted;
    }
#if HINGES
    uint bends = hinges_at + i;
    constraints += at[bends + 1u] - at[bends];
    for (uint j = at[bends]; j < at[bends + 1u]; ++j)
        sum += rvec3(hinge_correction[at[j]]);
#endif
#if VOLUMES
    uint volumes = volumes_at + i;
    constraints += at[volumes + 1u] - at[volumes];
    for (uint j = at[volumes]; j < at[volumes + 1u]; ++j)
        sum += rvec3(volume_correction[at[j]]);
#endif
    rvec4 better = jacobi_step(delta[i], sum, constraints, position[i].w);
#if CHEBYSHEV
    better = chebyshev_step(better, next[i], position[i].w);
#endif
    next[i] = better;
}
