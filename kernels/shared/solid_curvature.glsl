// dP/dF of an elastic tetrahedron, a symmetric 9 x 9 matrix, its negative eigenvalues made positive.
//
// Based on, Departures: implicit_solids.comp.
#ifndef TAUT_SHARED_SOLID_CURVATURE_GLSL
#define TAUT_SHARED_SOLID_CURVATURE_GLSL

#include "shared/singular.glsl"

// Of a negative eigenvalue, what is added in multiples of its size: a sixteenth of it is left with the other
// sign. With none left a direction has its inertia alone, and a Newton step along it is as long as the body
// is stiff (docs/decisions.md, 74).
#define TAUT_TURNED real(1.0625)

/// Blocks by columns of F: 00, 11, 22 by their diagonal d and what is beside it, o (xy, xz, yz); 01, 02, 12
/// by rows p, q, r.
struct Curvature
{
    rvec3 d0, o0, d1, o1, d2, o2;
    rvec3 p0, p1, p2;
    rvec3 q0, q1, q2;
    rvec3 r0, r1, r2;
};

/// Adds size e e^T, e by columns of F.
void raise(INOUT(Curvature) k, real size, rvec3 e0, rvec3 e1, rvec3 e2)
{
    rvec3 s0 = e0 * size;
    rvec3 s1 = e1 * size;
    rvec3 s2 = e2 * size;
    k.d0 += s0 * e0;
    k.d1 += s1 * e1;
    k.d2 += s2 * e2;
    k.o0 += rvec3(s0.x * e0.y, s0.x * e0.z, s0.y * e0.z);
    k.o1 += rvec3(s1.x * e1.y, s1.x * e1.z, s1.y * e1.z);
    k.o2 += rvec3(s2.x * e2.y, s2.x * e2.z, s2.y * e2.z);
    k.p0 += e1 * s0.x;
    k.p1 += e1 * s0.y;
    k.p2 += e1 * s0.z;
    k.q0 += e2 * s0.x;
    k.q1 += e2 * s0.y;
    k.q2 += e2 * s0.z;
    k.r0 += e2 * s1.x;
    k.r1 += e2 * s1.y;
    k.r2 += e2 * s1.z;
}

/// The same for an e that is given in the frames of the singular vectors, u v^T + w z^T, of length sqrt(2),
/// and whose eigenvalue is -size.
void raise_pair(INOUT(Curvature) k, real size, rvec3 u, rvec3 v, rvec3 w, rvec3 z)
{
    if (size > real(0))
        raise(k, real(0.5) * (size * TAUT_TURNED), u * v.x + w * z.x, u * v.y + w * z.y, u * v.z + w * z.z);
}

/// What three directions of scaling have that is negative, raised beyond zero. a: an eigenvector in the
/// frames.
void raise_scaling(INOUT(Curvature) k, Singular d, real value, rvec3 a)
{
    if (value < real(0))
    {
        rvec3 u0 = d.u0 * a.x;
        rvec3 u1 = d.u1 * a.y;
        rvec3 u2 = d.u2 * a.z;
        raise(k, -value * TAUT_TURNED, (u0 * d.v0.x + u1 * d.v1.x) + u2 * d.v2.x,
              (u0 * d.v0.y + u1 * d.v1.y) + u2 * d.v2.y, (u0 * d.v0.z + u1 * d.v1.z) + u2 * d.v2.z);
    }
}

/// units: volume h^2 scale. The result is that times what Smith et al. call the Hessian.
Curvature curvature_of(SolidTetrahedron t, Deformation f, real units)
{
    real shear = (t.mu * f.share) * units;
    real bulk = t.lambda * units;
    real inverse = real(1) / (f.square + real(1));
    real soft = ((real(2) * t.log_term) * (t.mu * units)) * (inverse * inverse);
    real push = t.mu > real(0) ? (f.volume - t.rest) * bulk : real(0);
    Curvature k;
    rvec3 same = rvec3(shear, shear, shear);
    rvec3 none = rvec3(real(0));
    k.d0 = same;
    k.d1 = same;
    k.d2 = same;
    k.o0 = none;
    k.o1 = none;
    k.o2 = none;
    // det F differentiated twice: cross products with the third column.
    rvec3 x = f.f0 * push;
    rvec3 y = f.f1 * push;
    rvec3 z = f.f2 * push;
    k.p0 = rvec3(real(0), z.z, -z.y);
    k.p1 = rvec3(-z.z, real(0), z.x);
    k.p2 = rvec3(z.y, -z.x, real(0));
    k.q0 = rvec3(real(0), -y.z, y.y);
    k.q1 = rvec3(y.z, real(0), -y.x);
    k.q2 = rvec3(-y.y, y.x, real(0));
    k.r0 = rvec3(real(0), x.z, -x.y);
    k.r1 = rvec3(-x.z, real(0), x.x);
    k.r2 = rvec3(x.y, -x.x, real(0));
    raise(k, soft, f.f0, f.f1, f.f2);
    raise(k, bulk, cross(f.f1, f.f2), cross(f.f2, f.f0), cross(f.f0, f.f1));
    if (push != real(0))
    {
        Singular d = singular_of(f.f0, f.f1, f.f2);
        rvec3 turn = d.s * push; // of twists shear + turn, of flips shear - turn
        raise_pair(k, -(shear + turn.x), d.u1, d.v2, -d.u2, d.v1);
        raise_pair(k, -(shear + turn.y), d.u2, d.v0, -d.u0, d.v2);
        raise_pair(k, -(shear + turn.z), d.u0, d.v1, -d.u1, d.v0);
        raise_pair(k, turn.x - shear, d.u1, d.v2, d.u2, d.v1);
        raise_pair(k, turn.y - shear, d.u2, d.v0, d.u0, d.v2);
        raise_pair(k, turn.z - shear, d.u0, d.v1, d.u1, d.v0);
        rvec3 g = rvec3(d.s.y * d.s.z, d.s.x * d.s.z, d.s.x * d.s.y);
        rvec3 own = same + ((d.s * d.s) * soft + (g * g) * bulk);
        rvec3 mixed = rvec3((d.s.y * d.s.z) * soft + (g.y * g.z) * bulk,
                            (d.s.x * d.s.z) * soft + (g.x * g.z) * bulk,
                            (d.s.x * d.s.y) * soft + (g.x * g.y) * bulk) + turn;
        Spectrum e = spectrum_of(own, mixed);
        raise_scaling(k, d, e.value.x, e.v0);
        raise_scaling(k, d, e.value.y, e.v1);
        raise_scaling(k, d, e.value.z, e.v2);
    }
    return k;
}

#endif
