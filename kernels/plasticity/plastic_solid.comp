// Elastic tetrahedra that keep a part of their change of shape: B = B_0 P, where P is the inverse of the
// plastic stretch, so that F_elastic = F P. One invocation per tetrahedron that can, at the end of a substep.
//
// Based on:
//   Irving, Teran, Fedkiw. Invertible Finite Elements for Robust Simulation of Large Deformation. SCA 2004,
//     section 7: F = F_e F_p, plastic flow along the principal stretches, of which the volume is taken out.
//   Mueller, Gross. Interactive Virtual Materials. Graphics Interface 2004, section 4.5: yield, creep, limit.
//   Perzyna. Fundamental Problems in Viscoplasticity. Advances in Applied Mechanics 9, 1966: what flows is
//     what is beyond the yield.
// Departures: with s the principal elastic stretches over the cube root of their product, the strain is
//   e = sqrt(2/3 sum (s - 1)^2), which in a bar of constant volume that is pulled is its strain, and what
//   flows is D = 1 + g (s - 1), g = share (e - yield) / e, det D made 1. P is kept symmetric: turning it
//   changes nothing in an isotropic material. Inverted tetrahedra, and ones of less than a thousandth or more
//   than a thousand times their volume, do not flow.
// Bytes per tetrahedron: 32 + 48 + 24 + 128 read; where it flows 24 and up to 4 x 36 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/solid.glsl"
#include "shared/singular.glsl"
#include "shared/plastic.glsl"

PARAMS
{
    uint count;
};

READ(0, uint, table); // 8 words: four corners; the records with each of them second, 0xffffffff = none
READ(1, real, rule);  // TAUT_PLASTIC_SOLID
UPDATE(2, real, state); // TAUT_PLASTIC_STATE
UPDATE(3, SolidTetrahedron, solid);
READ(4, rvec4, position); // m
READ(5, rvec4, low);      // m
READ_ONE(6, StepValues, step_values);

/// d: xx, yy, zz; m: yz, xz, xy of a symmetric matrix, times v.
rvec3 times(rvec3 d, rvec3 m, rvec3 v)
{
    return rvec3((d.x * v.x + m.z * v.y) + m.y * v.z, (m.z * v.x + d.y * v.y) + m.x * v.z,
                 (m.y * v.x + m.x * v.y) + d.z * v.z);
}

/// Sum of s v v^T over the vectors of a spectrum: its diagonal, and what is beside it.
rvec3 diagonal_of(Spectrum c, rvec3 s)
{
    return ((c.v0 * c.v0) * s.x + (c.v1 * c.v1) * s.y) + (c.v2 * c.v2) * s.z;
}
rvec3 beside_of(Spectrum c, rvec3 s)
{
    rvec3 a = rvec3(c.v0.y * c.v0.z, c.v0.x * c.v0.z, c.v0.x * c.v0.y) * s.x;
    rvec3 b = rvec3(c.v1.y * c.v1.z, c.v1.x * c.v1.z, c.v1.x * c.v1.y) * s.y;
    return (a + b) + rvec3(c.v2.y * c.v2.z, c.v2.x * c.v2.z, c.v2.x * c.v2.y) * s.z;
}

/// Stretches of which the volume is taken out.
rvec3 of_shape(rvec3 s)
{
    return s / cube_root((s.x * s.y) * s.z);
}

real strain_of(rvec3 s)
{
    rvec3 beyond = s - rvec3(real(1));
    return sqrt(dot(beyond, beyond) * REAL(0.66666666666666666667));
}

rvec3 roots(rvec3 squares)
{
    return rvec3(sqrt(max(squares.x, REAL(1e-8))), sqrt(max(squares.y, REAL(1e-8))),
                 sqrt(max(squares.z, REAL(1e-8))));
}

rvec3 edge(uint from, uint to)
{
    return rvec3(position[to] - position[from]) + rvec3(low[to] - low[from]);
}

/// The rows of the corners b, c, d.
void put_rows(uint k, rvec3 r1, rvec3 r2, rvec3 r3)
{
    if (k != 0xffffffffu)
    {
        solid[k].b00 = r1.x;
        solid[k].b01 = r1.y;
        solid[k].b02 = r1.z;
        solid[k].b10 = r2.x;
        solid[k].b11 = r2.y;
        solid[k].b12 = r2.z;
        solid[k].b20 = r3.x;
        solid[k].b21 = r3.y;
        solid[k].b22 = r3.z;
    }
}

KERNEL(count)
{
    uint own = 8u * uint(i);
    uint at = TAUT_PLASTIC_SOLID * uint(i);
    uint kept = TAUT_PLASTIC_STATE * uint(i);
    rvec3 pd = rvec3(state[kept], state[kept + 1u], state[kept + 2u]);
    rvec3 pm = rvec3(state[kept + 3u], state[kept + 4u], state[kept + 5u]);
    rvec3 b1 = rvec3(rule[at], rule[at + 1u], rule[at + 2u]);
    rvec3 b2 = rvec3(rule[at + 3u], rule[at + 4u], rule[at + 5u]);
    rvec3 b3 = rvec3(rule[at + 6u], rule[at + 7u], rule[at + 8u]);
    real start = rule[at + 9u];
    rvec3 r1 = times(pd, pm, b1);
    rvec3 r2 = times(pd, pm, b2);
    rvec3 r3 = times(pd, pm, b3);
    rvec3 e1 = edge(table[own], table[own + 1u]);
    rvec3 e2 = edge(table[own], table[own + 2u]);
    rvec3 e3 = edge(table[own], table[own + 3u]);
    rvec3 f0 = (e1 * r1.x + e2 * r2.x) + e3 * r3.x;
    rvec3 f1 = (e1 * r1.y + e2 * r2.y) + e3 * r3.y;
    rvec3 f2 = (e1 * r1.z + e2 * r2.z) + e3 * r3.z;
    real grown = dot(f0, cross(f1, f2));
    bool usable = grown > REAL(1e-3) && grown < REAL(1e3);
    real root = cube_root(usable ? grown : real(1));
    real scale = real(1) / (root * root);
    rvec3 cd = rvec3(dot(f0, f0), dot(f1, f1), dot(f2, f2)) * scale;
    rvec3 cm = rvec3(dot(f1, f2), dot(f0, f2), dot(f0, f1)) * scale;
    // (s^2 - 1)^2 is more than (s - 1)^2: where this is below the yield the strain is.
    rvec3 off = cd - rvec3(real(1));
    real bound = (dot(off, off) + real(2) * dot(cm, cm)) * REAL(0.66666666666666666667);
    if (usable && bound > start * start)
    {
        Spectrum elastic = spectrum_of(cd, cm);
        rvec3 s = of_shape(roots(elastic.value));
        real strain = strain_of(s);
        if (strain > start)
        {
            real share = plastic_share(rule[at + 10u] * step_values[0].substep);
            real flow = (share * (strain - start)) / strain;
            rvec3 d = of_shape(rvec3(real(1)) + (s - rvec3(real(1))) * flow);
            // P D^-2 P, its root the new P before the limit.
            rvec3 weak = rvec3(real(1)) / (d * d);
            rvec3 gd = diagonal_of(elastic, weak);
            rvec3 gm = beside_of(elastic, weak);
            rvec3 p0 = rvec3(pd.x, pm.z, pm.y);
            rvec3 p1 = rvec3(pm.z, pd.y, pm.x);
            rvec3 p2 = rvec3(pm.y, pm.x, pd.z);
            rvec3 q0 = times(gd, gm, p0);
            rvec3 q1 = times(gd, gm, p1);
            rvec3 q2 = times(gd, gm, p2);
            Spectrum plastic = spectrum_of(rvec3(dot(p0, q0), dot(p1, q1), dot(p2, q2)),
                                           rvec3(dot(p1, q2), dot(p0, q2), dot(p0, q1)));
            rvec3 stretch = of_shape(rvec3(real(1)) / roots(plastic.value));
            real all = strain_of(stretch);
            real within = min(real(1), rule[at + 11u] / max(all, REAL(1e-20)));
            stretch = of_shape(rvec3(real(1)) + (stretch - rvec3(real(1))) * within);
            rvec3 inverse = rvec3(real(1)) / stretch;
            pd = diagonal_of(plastic, inverse);
            pm = beside_of(plastic, inverse);
            state[kept] = pd.x;
            state[kept + 1u] = pd.y;
            state[kept + 2u] = pd.z;
            state[kept + 3u] = pm.x;
            state[kept + 4u] = pm.y;
            state[kept + 5u] = pm.z;
            r1 = times(pd, pm, b1);
            r2 = times(pd, pm, b2);
            r3 = times(pd, pm, b3);
            rvec3 r0 = -((r1 + r2) + r3);
            // As plan/vbd_rows.cpp turns them, each corner second.
            put_rows(table[own + 4u], r0, r2, r1);
            put_rows(table[own + 5u], r1, r2, r3);
            put_rows(table[own + 6u], r2, r3, r1);
            put_rows(table[own + 7u], r3, r1, r2);
        }
    }
}
