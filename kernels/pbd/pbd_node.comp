// One Jacobi iteration of PBD, node-centric: one invocation per vertex works out what each of its springs,
// hinges and tetrahedra wants of it and takes the average. Each constraint is worked out at every one of its
// vertices; nothing is scattered, and the next iterate goes to a second buffer.
//
// Based on: Va, Choi, Hong. Efficient Simulation of Volumetric Deformable Objects in Unity3D: GPU-Accelerated
//   Position-Based Dynamics. Electronics 12(10), 2023: the node-centric scheme.
// Departures: the average goes over all constraints together; sums run by ascending constraint, springs
//   first, then hinges, as in pbd_average, so the two schemes agree bit for bit.
// Bytes per element: 48 read, 16 written, 20 + 64 per spring, 28 + 128 per hinge or tetrahedron (float).
//! variant hinges HINGES=1
//! variant volumes VOLUMES=1
//! variant hinges_volumes HINGES=1 VOLUMES=1
//! variant chebyshev CHEBYSHEV=1
//! variant hinges_chebyshev HINGES=1 CHEBYSHEV=1
//! variant volumes_chebyshev VOLUMES=1 CHEBYSHEV=1
//! variant hinges_volumes_chebyshev HINGES=1 VOLUMES=1 CHEBYSHEV=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/pbd.glsl"

PARAMS
{
    uint count;          // vertices
    float stretch_share; // of a correction that one iteration makes
    float bend_share;
    float volume_share;
    float relaxation; // each average times this
    float omega;      // Chebyshev's weight of this iteration
    uint report;      // 1: count degenerate constraints
    uint hinges_at;   // where in `at` the list of hinges begins
    uint volumes_at;  // and that of tetrahedra
};

READ(0, rvec4, position); // xyz m, w = inverse mass 1/kg
READ(1, rvec4, delta);    // displacement since the start of the substep, m
#if CHEBYSHEV
UPDATE(2, rvec4, next); // before: the iterate before `delta`
#else
WRITE(2, rvec4, next);
#endif
COUNTERS(3, events);
READ(4, DistanceConstraint, spring);
// Of vertex v: at[j] = 2 * spring + end, for j from at[v] up to at[v + 1]; from at[hinges_at + v] on the
// same, 4 * hinge + corner, and from at[volumes_at + v] on 4 * tetrahedron + corner.
READ(5, uint, at);
#if VOLUMES
READ(6, VolumeConstraint, tetrahedron);
#if HINGES
READ(7, BendingConstraint, hinge);
#endif
#elif HINGES
READ(6, BendingConstraint, hinge);
#endif

#include "shared/pbd_jacobi.glsl"

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    uint constraints = at[i + 1u] - at[i];
    for (uint j = at[i]; j < at[i + 1u]; ++j)
    {
        uint entry = at[j];
        DistanceConstraint c = spring[entry / 2u];
        rvec4 xa = position[c.a];
        rvec4 xb = position[c.b];
        SpringPush wanted = spring_push(c, xa, xb, delta[c.a], delta[c.b], real(stretch_share));
        bool is_a = entry % 2u == 0u;
        sum += is_a ? rvec3(wanted.push) : -rvec3(wanted.push);
        if (report != 0u && is_a && !wanted.usable && xa.w + xb.w > real(0) && c.rest_length > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
#if HINGES
    uint bends = hinges_at + i;
    constraints += at[bends + 1u] - at[bends];
    for (uint j = at[bends]; j < at[bends + 1u]; ++j)
    {
        uint entry = at[j];
        uint corner = entry % 4u;
        BendingConstraint c = hinge[entry / 4u];
        rvec4 p0 = position[c.edge0];
        rvec4 p1 = position[c.edge1];
        rvec4 p2 = position[c.wing0];
        rvec4 p3 = position[c.wing1];
        HingePush wanted = hinge_push(c, p0, p1, p2, p3, delta[c.edge0], delta[c.edge1], delta[c.wing0],
                                      delta[c.wing1], real(bend_share));
        rvec3 at_edge = corner == 0u ? wanted.edge0 : wanted.edge1;
        rvec3 at_wing = corner == 2u ? wanted.wing0 : wanted.wing1;
        sum += corner < 2u ? at_edge : at_wing;
        if (report != 0u && corner == 0u && !wanted.shaped && p0.w + p1.w + p2.w + p3.w > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
#endif
#if VOLUMES
    uint volumes = volumes_at + i;
    constraints += at[volumes + 1u] - at[volumes];
    for (uint j = at[volumes]; j < at[volumes + 1u]; ++j)
    {
        uint entry = at[j];
        uint corner = entry % 4u;
        VolumeConstraint c = tetrahedron[entry / 4u];
        rvec4 p0 = position[c.a];
        rvec4 p1 = position[c.b];
        rvec4 p2 = position[c.c];
        rvec4 p3 = position[c.d];
        VolumePush wanted = volume_push(c, p0, p1, p2, p3, delta[c.a], delta[c.b], delta[c.c], delta[c.d],
                                        real(volume_share));
        rvec3 first_two = corner == 0u ? wanted.a : wanted.b;
        rvec3 last_two = corner == 2u ? wanted.c : wanted.d;
        sum += corner < 2u ? first_two : last_two;
        if (report != 0u && corner == 0u && !wanted.usable && p0.w + p1.w + p2.w + p3.w > real(0))
            COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    }
#endif
    rvec4 better = jacobi_step(delta[i], sum, constraints, position[i].w);
#if CHEBYSHEV
    better = chebyshev_step(better, next[i], position[i].w);
#endif
    next[i] = better;
}
