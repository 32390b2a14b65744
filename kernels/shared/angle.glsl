// The angle of the vector (x, y) in (-pi, pi], for float and double alike: GLSL has no double atan,
// and one polynomial on every device keeps executors equal.
//
// Based on: S. L. Moshier, Cephes Math Library, atan and atanf (range reduction at tan(pi/8), rational
//   and polynomial approximation).
// Departures: one reduction to |t| <= tan(pi/8) for both precisions; (0, 0) gives 0.
#ifndef TAUT_SHARED_ANGLE_GLSL
#define TAUT_SHARED_ANGLE_GLSL

real small_arctangent(real t)
{
    real z = t * t;
#if TAUT_REAL_DOUBLE
    real p = (((REAL(-8.750608600031904122785e-1) * z + REAL(-1.615753718733365076637e1)) * z +
               REAL(-7.500855792314704667340e1)) * z + REAL(-1.228866684490136173410e2)) * z +
             REAL(-6.485021904942025371773e1);
    real q = ((((z + REAL(2.485846490142306297962e1)) * z + REAL(1.650270098316988542046e2)) * z +
               REAL(4.328810604912902668951e2)) * z + REAL(4.853903996359136964868e2)) * z +
             REAL(1.945506571482613964425e2);
    return t + t * (z * p / q);
#else
    real p = ((REAL(8.05374449538e-2) * z - REAL(1.38776856032e-1)) * z + REAL(1.99777106478e-1)) * z -
             REAL(3.33329491539e-1);
    return t + t * (z * p);
#endif
}

real angle_of(real y, real x)
{
    real ax = abs(x);
    real ay = abs(y);
    real large = max(ax, ay);
    real small = min(ax, ay);
    real t = SELECT(large > real(0), small / large, real(0));
    rbool fold = t > REAL(0.41421356237309504880);
    real reduced = SELECT(fold, (t - real(1)) / (t + real(1)), t);
    real angle = small_arctangent(reduced) + SELECT(fold, REAL(0.78539816339744830962), real(0));
    angle = SELECT(ay > ax, REAL(1.57079632679489661923) - angle, angle);
    angle = SELECT(x < real(0), REAL(3.14159265358979323846) - angle, angle);
    return SELECT(y < real(0), -angle, angle);
}

#endif
