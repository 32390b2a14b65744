// How the force of a spring with a damper changes with its ends, over a substep of backward Euler.
//
// Based on:
//   Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, 3 and 4.
//   Choi, Ko. Stable but Responsive Cloth. SIGGRAPH 2002, 4.2: what a compressed spring would push its ends
//   apart sideways is left out, and the matrix stays positive semidefinite at every length.
// Departures: the damper acts along the spring, and how its direction turns is left out.
#ifndef TAUT_SHARED_IMPLICIT_SPRING_GLSL
#define TAUT_SHARED_IMPLICIT_SPRING_GLSL

/// h^2 K + h D of a spring: across I + more n n^T, kg, for one end and itself; negative for one end and the
/// other.
struct SpringBlock
{
    rvec3 n; // from end b to end a; 0 where ends coincide
    real across;
    real more; // along the spring
};

/// Coincident ends have no direction: nothing at all, but the whole stiffness where the rest length is 0.
bool spring_has_derivative(rvec3 d, real rest_length)
{
    return dot(d, d) > real(0) || rest_length == real(0);
}

/// d: from end b to end a, m; h: s. Every factor is a substep's: h^2 stiffness, h damping.
SpringBlock spring_derivative(real rest_length, real stiffness, real damping, rvec3 d, real h)
{
    real len = length(d);
    bool directed = len > real(0);
    real inverse = directed ? real(1) / len : real(0);
    // PRECISE: drivers take common factors out of differences, and executors differ in the last bit.
    PRECISE real whole = (h * stiffness) * h;
    PRECISE real loose = rest_length * inverse;
    PRECISE real share = max(real(0), real(1) - loose);
    share = directed ? share : (rest_length == real(0) ? real(1) : real(0));
    PRECISE real across = whole * share;
    PRECISE real more = (whole - across) + h * damping;
    SpringBlock block;
    block.n = d * inverse;
    block.across = across;
    block.more = directed ? more : real(0);
    return block;
}

rvec3 spring_product(SpringBlock block, rvec3 p)
{
    PRECISE real along = block.more * dot(block.n, p);
    PRECISE rvec3 product = p * block.across + block.n * along;
    return product;
}

/// The force on end a, N. v: velocity of a against b, m/s.
rvec3 spring_pull(real rest_length, real stiffness, real damping, rvec3 d, rvec3 v)
{
    real len = length(d);
    bool directed = len > real(0);
    real inverse = directed ? real(1) / len : real(0);
    real pull = stiffness * (len - rest_length) + damping * (dot(v, d) * inverse);
    return d * (-pull * inverse);
}

#endif
