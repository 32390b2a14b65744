// Singular values of a 3 x 3 matrix, by Jacobi's rotations.
//
// Based on: Golub, Van Loan. Matrix Computations, 4th ed. 2013, 8.5 (cyclic Jacobi).
// Departures: five rounds always, after which the rest is rounding; U and V are rotations, so the least value
//   bears the sign of the determinant.
#ifndef TAUT_SHARED_SINGULAR_GLSL
#define TAUT_SHARED_SINGULAR_GLSL

/// A symmetric matrix on its way to its eigenvalues. Vectors are columns.
struct Spectrum
{
    rvec3 value; // xx, yy, zz
    rvec3 mixed; // yz, xz, xy
    rvec3 v0, v1, v2;
};

/// cos and sin of the rotation that takes pq out.
rvec3 rotation_of(real pp, real qq, real pq)
{
    real t = real(0);
    if (abs(pq) > REAL(1e-30) * (abs(pp) + abs(qq)))
    {
        real tau = (qq - pp) / (real(2) * pq);
        real root = sqrt(real(1) + tau * tau);
        t = tau >= real(0) ? real(1) / (tau + root) : real(-1) / (root - tau);
    }
    // PRECISE: drivers would take the common factor out of differences of products with the two.
    PRECISE real c = real(1) / sqrt(real(1) + t * t);
    PRECISE real s = t * c;
    return rvec3(c, s, t);
}

/// Eigenvalues and eigenvectors, in no order. d: xx, yy, zz; m: yz, xz, xy.
Spectrum spectrum_of(rvec3 d, rvec3 m)
{
    Spectrum s;
    s.value = d;
    s.mixed = m;
    s.v0 = rvec3(real(1), real(0), real(0));
    s.v1 = rvec3(real(0), real(1), real(0));
    s.v2 = rvec3(real(0), real(0), real(1));
    for (uint round = 0u; round < 5u; ++round)
    {
        rvec3 r = rotation_of(s.value.x, s.value.y, s.mixed.z);
        rvec3 v = s.v0;
        real step = r.z * s.mixed.z;
        s.value = rvec3(s.value.x - step, s.value.y + step, s.value.z);
        s.mixed = rvec3(r.y * s.mixed.y + r.x * s.mixed.x, r.x * s.mixed.y - r.y * s.mixed.x, real(0));
        s.v0 = v * r.x - s.v1 * r.y;
        s.v1 = v * r.y + s.v1 * r.x;

        r = rotation_of(s.value.x, s.value.z, s.mixed.y);
        v = s.v0;
        step = r.z * s.mixed.y;
        s.value = rvec3(s.value.x - step, s.value.y, s.value.z + step);
        s.mixed = rvec3(r.y * s.mixed.z + r.x * s.mixed.x, real(0), r.x * s.mixed.z - r.y * s.mixed.x);
        s.v0 = v * r.x - s.v2 * r.y;
        s.v2 = v * r.y + s.v2 * r.x;

        r = rotation_of(s.value.y, s.value.z, s.mixed.x);
        v = s.v1;
        step = r.z * s.mixed.x;
        s.value = rvec3(s.value.x, s.value.y - step, s.value.z + step);
        s.mixed = rvec3(real(0), r.y * s.mixed.z + r.x * s.mixed.y, r.x * s.mixed.z - r.y * s.mixed.y);
        s.v1 = v * r.x - s.v2 * r.y;
        s.v2 = v * r.y + s.v2 * r.x;
    }
    return s;
}

/// F = U diag(s) V^T with rotations U and V; s.x >= s.y >= |s.z|.
struct Singular
{
    rvec3 s;
    rvec3 u0, u1, u2;
    rvec3 v0, v1, v2;
};

/// Some unit vector at right angles to a unit vector.
rvec3 aside(rvec3 n)
{
    rvec3 axis = abs(n.x) < real(0.75) ? rvec3(real(1), real(0), real(0)) : rvec3(real(0), real(1), real(0));
    rvec3 a = cross(n, axis);
    return a / length(a);
}

/// By columns.
Singular singular_of(rvec3 f0, rvec3 f1, rvec3 f2)
{
    Spectrum c = spectrum_of(rvec3(dot(f0, f0), dot(f1, f1), dot(f2, f2)),
                             rvec3(dot(f1, f2), dot(f0, f2), dot(f0, f1)));
    rvec3 most = c.value.x >= c.value.y ? c.v0 : c.v1;
    rvec3 next = c.value.x >= c.value.y ? c.v1 : c.v0;
    real large = max(c.value.x, c.value.y);
    real small = min(c.value.x, c.value.y);
    if (c.value.z > large)
    {
        next = most;
        most = c.v2;
    }
    else if (c.value.z > small)
        next = c.v2;
    Singular d;
    d.v0 = most;
    d.v1 = next;
    d.v2 = cross(most, next);
    rvec3 a = (f0 * most.x + f1 * most.y) + f2 * most.z;
    rvec3 b = (f0 * next.x + f1 * next.y) + f2 * next.z;
    rvec3 e = (f0 * d.v2.x + f1 * d.v2.y) + f2 * d.v2.z;
    real len = length(a);
    d.u0 = len > real(0) ? a / len : most;
    b -= d.u0 * dot(d.u0, b);
    real wide = length(b);
    bool thin = wide <= REAL(1e-6) * len;
    d.u1 = thin ? aside(d.u0) : b / wide;
    d.u2 = cross(d.u0, d.u1);
    d.s = rvec3(len, thin ? real(0) : wide, dot(d.u2, e));
    return d;
}

#endif
