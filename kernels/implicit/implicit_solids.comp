// What a Newton step needs of elastic tetrahedra: the stress, and its derivative, negative eigenvalues made
// positive, one invocation per tetrahedron (layout: shared/solid_state.h). Vertices gather from it: the
// right-hand side, the matrix, and its products.
//
// Based on:
//   Smith, de Goes, Kim. Stable Neo-Hookean Flesh Simulation. ACM TOG 37(2), 2018, 4: derivative and
//     eigensystem.
//   Smith, de Goes, Kim. Analytic Eigensystems for Isotropic Distortion Energies. ACM TOG 38(1), 2019.
//   Chen, Liu, Levin, Zheng, Jacobson. Stabler Neo-Hookean Simulation: Absolute Eigenvalue Filtering for
//     Projected Newton. SIGGRAPH 2024.
// Departures: a negative eigenvalue becomes a sixteenth of its size (docs/decisions.md, 74). The derivative
//   is formed as it is, and what negative eigenvalues lack is added, so that where there is none (close to
//   rest) nothing depends on singular vectors. Without shear stiffness (volumes beside springs) only the
//   outer product of the determinant's slope is kept, as for hinges.
// Bytes per tetrahedron: 72 + 128 read, 216 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/solid.glsl"
#include "shared/solid_curvature.glsl"
#include "shared/solid_state.h"

PARAMS
{
    uint count;  // tetrahedra
    uint report; // 1: count collapsed ones
    float scale; // as in implicit_force
};

READ(0, rvec4, position); // m
READ(1, rvec4, delta);    // m
READ(2, SolidTetrahedron, solid);
READ_ONE(3, StepValues, step_values);
WRITE(4, real, state);
COUNTERS(5, events);

rvec3 between(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(delta[to] - delta[from]);
}

void put(uint at, rvec3 v)
{
    state[at] = v.x;
    state[at + 1u] = v.y;
    state[at + 2u] = v.z;
}

KERNEL(count)
{
    SolidTetrahedron t = solid[i];
    real h = step_values[0].substep;
    real units = ((h * t.volume) * h) * real(scale);
    Deformation f = deformation_of(t, between(t.a, t.b), between(t.a, t.c), between(t.a, t.d));
    real shear = (t.mu * f.share) * units;
    real push = (t.lambda * (f.volume - t.rest)) * units;
    rvec3 c0 = cross(f.f1, f.f2);
    rvec3 c1 = cross(f.f2, f.f0);
    rvec3 c2 = cross(f.f0, f.f1);
    uint at = TAUT_SOLID_STATE * uint(i);
    put(at, f.f0 * shear + c0 * push);
    put(at + 3u, f.f1 * shear + c1 * push);
    put(at + 6u, f.f2 * shear + c2 * push);
    Curvature k = curvature_of(t, f, units);
    put(at + 9u, rvec3(k.d0.x, k.o0.x, k.o0.y));
    put(at + 12u, rvec3(k.d0.y, k.o0.z, k.d0.z));
    put(at + 15u, rvec3(k.d1.x, k.o1.x, k.o1.y));
    put(at + 18u, rvec3(k.d1.y, k.o1.z, k.d1.z));
    put(at + 21u, rvec3(k.d2.x, k.o2.x, k.o2.y));
    put(at + 24u, rvec3(k.d2.y, k.o2.z, k.d2.z));
    put(at + 27u, k.p0);
    put(at + 30u, k.p1);
    put(at + 33u, k.p2);
    put(at + 36u, k.q0);
    put(at + 39u, k.q1);
    put(at + 42u, k.q2);
    put(at + 45u, k.r0);
    put(at + 48u, k.r1);
    put(at + 51u, k.r2);
    if (report != 0u)
        COUNT_EVENT_IF(is_collapsed(f), events, TAUT_EVENT_DEGENERATE);
}
