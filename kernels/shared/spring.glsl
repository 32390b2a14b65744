// The force of a spring with a damper on its end `a`.
//
// Based on: Provot. Deformation Constraints in a Mass-Spring Model to Describe Rigid Cloth Behavior. GI 1995,
//   equation 2, with the damper along the spring.
// Departures: the direction is d / |d| by one quotient, so that the other end's force is this one's negative
//   to the last bit; ends that coincide have no direction and no force.
#ifndef TAUT_SHARED_SPRING_GLSL
#define TAUT_SHARED_SPRING_GLSL

/// Whether the spring has a direction. d: from end b to end a, m.
bool spring_has_direction(rvec3 d) { return dot(d, d) > real(0); }

/// N. v: velocity of a against b, m/s. Zero without a direction.
rvec3 spring_force(real rest_length, real stiffness, real damping, rvec3 d, rvec3 v)
{
    real len = length(d);
    bool usable = len > real(0);
    len = usable ? len : real(1);
    real pull = stiffness * (len - rest_length) + damping * (dot(v, d) / len);
    return usable ? d * (-pull / len) : rvec3(real(0));
}

#endif
