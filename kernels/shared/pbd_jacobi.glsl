// The end of a Jacobi iteration at one vertex, for pbd_node and pbd_average: the corrections that its
// constraints want are averaged, and the iterates accelerated. Wants the parameters `relaxation` and `omega`.
//
// Based on: Macklin, Mueller, Chentanez, Kim. Unified Particle Physics for Real-Time Applications. 2014:
//   averaging with over-relaxation.
//   Wang. A Chebyshev Semi-Iterative Approach for Accelerating Projective and Position-Based Dynamics. 2015.
// Departures: the weights of Chebyshev's recurrence come from the host, one a pass.
#ifndef TAUT_SHARED_PBD_JACOBI_GLSL
#define TAUT_SHARED_PBD_JACOBI_GLSL

/// `sum`: what the constraints of a vertex want of it, per inverse mass `w`; the vertex has `constraints`.
rvec4 jacobi_step(rvec4 here, rvec3 sum, uint constraints, real w)
{
    real factor = constraints > 0u ? w * real(relaxation) / real(constraints) : real(0);
    return here + rvec4(sum * factor, real(0));
}

/// x <- omega (x - before) + before; `before` is the iterate two back. Held vertices keep their place.
rvec4 chebyshev_step(rvec4 better, rvec4 before, real w)
{
    rvec3 change = rvec3(better - before) * real(omega);
    return w > real(0) ? rvec4(rvec3(before) + change, better.w) : better;
}

#endif
