// The deformation of an elastic tetrahedron and what depends on it, for every method that has one
// (src/plan/solid.hpp says which energy).
#ifndef TAUT_SHARED_SOLID_GLSL
#define TAUT_SHARED_SOLID_GLSL

/// F by columns, what multiplies F in the stress, and det F.
struct Deformation
{
    rvec3 f0, f1, f2;
    real square; // |F|^2
    real share;  // 1 - log/(|F|^2 + 1): of mu
    real volume; // det F
};

/// e1, e2, e3: from the first corner to the others, m.
Deformation deformation_of(SolidTetrahedron t, rvec3 e1, rvec3 e2, rvec3 e3)
{
    Deformation d;
    d.f0 = (e1 * t.b00 + e2 * t.b10) + e3 * t.b20;
    d.f1 = (e1 * t.b01 + e2 * t.b11) + e3 * t.b21;
    d.f2 = (e1 * t.b02 + e2 * t.b12) + e3 * t.b22;
    d.square = (dot(d.f0, d.f0) + dot(d.f1, d.f1)) + dot(d.f2, d.f2);
    d.share = real(1) - t.log_term / (d.square + real(1));
    d.volume = dot(d.f0, cross(d.f1, d.f2));
    return d;
}

/// Collapsed to a point, or to a line as far as a float can tell: what force is left keeps it there, and the
/// element counts as degenerate.
rbool is_collapsed(Deformation d)
{
    rvec3 c0 = cross(d.f1, d.f2);
    rvec3 c1 = cross(d.f2, d.f0);
    rvec3 c2 = cross(d.f0, d.f1);
    real area = (dot(c0, c0) + dot(c1, c1)) + dot(c2, c2); // squares of the products of two stretches, added
    return d.square < REAL(1e-6) || area < (REAL(1e-13) * d.square) * d.square;
}

/// m0, m1, m2: columns of a matrix M; the gradients of the corners b, c, d are the columns of M B^T.
rvec3 gradient_b(SolidTetrahedron t, rvec3 m0, rvec3 m1, rvec3 m2)
{
    return (m0 * t.b00 + m1 * t.b01) + m2 * t.b02;
}
rvec3 gradient_c(SolidTetrahedron t, rvec3 m0, rvec3 m1, rvec3 m2)
{
    return (m0 * t.b10 + m1 * t.b11) + m2 * t.b12;
}
rvec3 gradient_d(SolidTetrahedron t, rvec3 m0, rvec3 m1, rvec3 m2)
{
    return (m0 * t.b20 + m1 * t.b21) + m2 * t.b22;
}

#endif
