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
#include "elements/spring.glsl"
#include "elements/hinge.glsl"
#include "elements/volume.glsl"

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

/// Of an element of four corners.
rvec3 row_gradient(ElementRow row, uint corner)
{
    rvec3 first_two = corner == 0u ? row.g0 : row.g1;
    rvec3 last_two = corner == 2u ? row.g2 : row.g3;
    return corner < 2u ? first_two : last_two;
}

// What an element wants of one of its corners, per inverse mass; its first corner counts it if it has no
// gradient. `entry`: an entry of `at`.

rvec3 spring_wants(uint entry)
{
    bool is_a = entry % 2u == 0u;
    DistanceConstraint c = spring[entry / 2u];
    rvec4 x0 = position[c.a];
    rvec4 x1 = position[c.b];
    ElementRow row = spring_row(c, rvec3((x1 - x0) + (delta[c.b] - delta[c.a])));
    RowPush push = row_push(row, row_weight(row, x0.w, x1.w), real(stretch_share));
    if (report != 0u && is_a && !push.usable && row.counted && x0.w + x1.w > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    rvec3 p0 = row.g0 * push.scale;
    return is_a ? p0 : -p0;
}

#if HINGES
rvec3 hinge_wants(uint entry)
{
    uint corner = entry % 4u;
    BendingConstraint c = hinge[entry / 4u];
    rvec4 x0 = position[c.edge0];
    rvec4 x1 = position[c.edge1];
    rvec4 x2 = position[c.wing0];
    rvec4 x3 = position[c.wing1];
    rvec4 d0 = delta[c.edge0];
    rvec3 e1 = rvec3((x1 - x0) + (delta[c.edge1] - d0));
    rvec3 e2 = rvec3((x2 - x0) + (delta[c.wing0] - d0));
    rvec3 e3 = rvec3((x3 - x0) + (delta[c.wing1] - d0));
    ElementRow row = hinge_row(c, e1, e2, e3);
    RowPush push = row_push(row, row_weight(row, x0.w, x1.w, x2.w, x3.w), real(bend_share));
    real masses = x0.w + x1.w + x2.w + x3.w;
    if (report != 0u && corner == 0u && !push.usable && row.counted && masses > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    rvec3 wanted = row_gradient(row, corner) * push.scale;
    return wanted;
}
#endif

#if VOLUMES
rvec3 tetrahedron_wants(uint entry)
{
    uint corner = entry % 4u;
    VolumeConstraint c = tetrahedron[entry / 4u];
    rvec4 x0 = position[c.a];
    rvec4 x1 = position[c.b];
    rvec4 x2 = position[c.c];
    rvec4 x3 = position[c.d];
    rvec4 d0 = delta[c.a];
    rvec3 e1 = rvec3((x1 - x0) + (delta[c.b] - d0));
    rvec3 e2 = rvec3((x2 - x0) + (delta[c.c] - d0));
    rvec3 e3 = rvec3((x3 - x0) + (delta[c.d] - d0));
    ElementRow row = volume_row(c, e1, e2, e3);
    RowPush push = row_push(row, row_weight(row, x0.w, x1.w, x2.w, x3.w), real(volume_share));
    push = bounded_push(push, row, x0.w, x1.w, x2.w, x3.w, e1, e2, e3);
    real masses = x0.w + x1.w + x2.w + x3.w;
    if (report != 0u && corner == 0u && !push.usable && row.counted && masses > real(0))
        COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
    rvec3 wanted = row_gradient(row, corner) * push.scale;
    return wanted;
}
#endif

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    uint constraints = at[i + 1u] - at[i];
    for (uint j = at[i]; j < at[i + 1u]; ++j)
        sum += spring_wants(at[j]);
#if HINGES
    uint bends = hinges_at + i;
    constraints += at[bends + 1u] - at[bends];
    for (uint j = at[bends]; j < at[bends + 1u]; ++j)
        sum += hinge_wants(at[j]);
#endif
#if VOLUMES
    uint volumes = volumes_at + i;
    constraints += at[volumes + 1u] - at[volumes];
    for (uint j = at[volumes]; j < at[volumes + 1u]; ++j)
        sum += tetrahedron_wants(at[j]);
#endif
    rvec4 better = jacobi_step(delta[i], sum, constraints, position[i].w);
#if CHEBYSHEV
    better = chebyshev_step(better, next[i], position[i].w);
#endif
    next[i] = better;
}
