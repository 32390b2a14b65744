// Where backward Euler starts a substep: vertices that are solved for stand still, so that the first Newton
// step takes forces and their derivatives from the places at its start; the solver is offered the inertial
// guess. Others keep the displacement that they have. One invocation per vertex.
//
// Based on: Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, eq. 16, in displacements.
// Departures: none.
// Bytes per element: 36 read, 28 written (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
    float lift; // power of two: the solver's unknowns are displacements times this
};

READ(0, rvec4, low);       // m; the displacement of a vertex that stands still
READ(1, uint, held);       // three words a vertex; not 0: not solved for
READ(2, rvec4, predicted); // m
UPDATE(3, rvec4, delta);   // m
WRITE(4, real, guess);     // three a vertex

KERNEL(count)
{
    bool solved = held[3u * i] == 0u;
    rvec4 still = low[i];
    rvec3 way = rvec3(predicted[i] - still) * real(lift);
    if (solved)
        delta[i] = still;
    guess[3u * i] = solved ? way.x : real(0);
    guess[3u * i + 1u] = solved ? way.y : real(0);
    guess[3u * i + 2u] = solved ? way.z : real(0);
}
