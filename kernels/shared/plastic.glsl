// What plastic flow of springs and tetrahedra shares. No logarithms, exponentials or powers: executors round
// those differently.
#ifndef TAUT_SHARED_PLASTIC_GLSL
#define TAUT_SHARED_PLASTIC_GLSL

#define TAUT_PLASTIC_SPRING 4u // reals a spring: rest length at first, yield, creep, limit
#define TAUT_PLASTIC_SOLID 12u // reals a tetrahedron: B at first by rows (9), yield, creep, limit
#define TAUT_PLASTIC_STATE 6u  // reals a tetrahedron: xx, yy, zz, yz, xz, xy of the inverse plastic stretch

/// The share of the strain beyond the yield that flows in x = creep * substep: 1 - exp(-x), by 1 over the
/// first terms of exp(x). Wrong by x^4/24, and 1 for an infinite creep.
real plastic_share(real x)
{
    real most = min(x, REAL(1e6));
    real grown = most * (real(1) + most * (real(0.5) + most / real(6)));
    return grown / (real(1) + grown);
}

/// For x from 1e-3 to 1e3, by Halley's method.
real cube_root(real x)
{
    real y = real(1);
    for (uint k = 0u; k < 8u; ++k)
    {
        real cube = (y * y) * y;
        y = y * ((cube + (x + x)) / ((cube + cube) + x));
    }
    return y;
}

#endif
