// By how much the energy of an element differs between two shapes of it, formed as a difference from the
// start: the energies themselves may be far larger than what a step changes. For every method that compares
// the two.
#ifndef TAUT_SHARED_RISE_GLSL
#define TAUT_SHARED_RISE_GLSL

/// |d + w / lift| - |d|, lifted. `both`: the sum of the two lengths.
real lengthening(rvec3 d, rvec3 w, real both, real lift)
{
    // (after^2 - before^2) / (after + before).
    return both > real(0) ? (real(2) * dot(d, w) + dot(w, w) / lift) / both : real(0);
}

#if ELASTIC || SOLIDS
/// u - ln(1 + u), u > -1, whose difference has no digits for a small u. With q = u / (2 + u) the logarithm is
/// 2 (q + q^3/3 + q^5/5 + ...), and u - 2 q = u q. Roots bring a large u near; GLSL has no log of a double.
real beyond_log(real u)
{
    bool close = abs(u) < real(0.25);
    real whole = max(real(1) + u, REAL(1e-30));
    real factor = real(2);
    for (uint k = 0u; k < 10u; ++k)
    {
        bool far = whole <= REAL(0.8) || whole >= real(1.25);
        whole = far ? sqrt(whole) : whole;
        factor = far ? factor + factor : factor;
    }
    real q = close ? u / (real(2) + u) : (whole - real(1)) / (whole + real(1));
    real q2 = q * q;
    real tail = REAL(0.05882352941176470588); // 1/17
    tail = REAL(0.06666666666666666667) + q2 * tail;
    tail = REAL(0.07692307692307692308) + q2 * tail;
    tail = REAL(0.09090909090909090909) + q2 * tail;
    tail = REAL(0.11111111111111111111) + q2 * tail;
    tail = REAL(0.14285714285714285714) + q2 * tail;
    tail = REAL(0.2) + q2 * tail;
    tail = REAL(0.33333333333333333333) + q2 * tail;
    real cubes = q * (q2 * tail);
    return close ? u * q - real(2) * cubes : u - factor * (q + cubes);
}

/// Energy of a tetrahedron of volume 1 between F of the edges e and those of e + w / lift, lifted twice, by
/// the powers of W: the first is the stress, which is small near rest though its two parts are not.
real solid_rise(SolidTetrahedron t, Deformation f, rvec3 w1, rvec3 w2, rvec3 w3, real lift)
{
    // W and all that is linear in it lifted.
    Deformation w = deformation_of(t, w1, w2, w3);
    real down = real(1) / lift;
    rvec3 c0 = cross(f.f1, f.f2);
    rvec3 c1 = cross(f.f2, f.f0);
    rvec3 c2 = cross(f.f0, f.f1);
    real shear = t.mu * f.share;
    real push = t.lambda * (f.volume - t.rest);
    real first = (dot(f.f0 * shear + c0 * push, w.f0) + dot(f.f1 * shear + c1 * push, w.f1)) +
                 dot(f.f2 * shear + c2 * push, w.f2);
    real along = (dot(f.f0, w.f0) + dot(f.f1, w.f1)) + dot(f.f2, w.f2);
    real slope = (dot(c0, w.f0) + dot(c1, w.f1)) + dot(c2, w.f2);
    real second = (dot(f.f0, cross(w.f1, w.f2)) + dot(f.f1, cross(w.f2, w.f0))) +
                  dot(f.f2, cross(w.f0, w.f1));
    real more = second + w.volume * down; // of det F, beyond its slope
    real grown = slope + more * down;
    real u = ((real(2) * along) * down + (w.square * down) * down) / (f.square + real(1));
    real log_rise = t.log_term * (t.mu * ((beyond_log(u) * lift) * lift));
    return (first * lift + push * more) +
           real(0.5) * ((shear * w.square + t.lambda * (grown * grown)) + log_rise);
}
#endif

#endif
