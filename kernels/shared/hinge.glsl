// The angle between two triangles at their common edge, and how it changes with each corner.
//
// Based on: Bridson, Marino, Fedkiw. Simulation of Clothing with Folds and Wrinkles. SCA 2003: the four
//   gradients.
// Departures: the angle itself, by a two-argument arctangent (acos loses half the digits near flat and has a
//   singular gradient there); a wing whose height is below 1e-6 of its edges has no usable normal.
#ifndef TAUT_SHARED_HINGE_GLSL
#define TAUT_SHARED_HINGE_GLSL

#include "shared/angle.glsl"

struct HingeShape
{
    rbool shaped;               // both triangles have an area; otherwise the rest is finite and means nothing
    real angle;                 // rad, in (-pi, pi]; 0 = flat
    rvec3 edge0, edge1;         // its gradients, rad/m
    rvec3 wing0, wing1;
};

/// e, a, b: from the first end of the edge to its second end and to the two wings, m.
HingeShape hinge_shape(rvec3 e, rvec3 a, rvec3 b)
{
    HingeShape hinge;
    rvec3 n1 = cross(e, a);
    rvec3 n2 = cross(b, e);
    real e2 = dot(e, e);
    real area1 = dot(n1, n1);
    real area2 = dot(n2, n2);
    hinge.shaped = area1 > REAL(1e-12) * e2 * dot(a, a) && area2 > REAL(1e-12) * e2 * dot(b, b);
    // Safe stand-ins keep every invocation on one path.
    e2 = SELECT(hinge.shaped, e2, real(1));
    area1 = SELECT(hinge.shaped, area1, real(1));
    area2 = SELECT(hinge.shaped, area2, real(1));
    real edge = sqrt(e2);
    hinge.angle = angle_of(dot(cross(n1, n2), e) / edge, dot(n1, n2));
    hinge.wing0 = n1 * (-edge / area1);
    hinge.wing1 = n2 * (-edge / area2);
    real s2 = dot(a, e) / e2;
    real s3 = dot(b, e) / e2;
    hinge.edge0 = hinge.wing0 * (s2 - real(1)) + hinge.wing1 * (s3 - real(1));
    hinge.edge1 = hinge.wing0 * -s2 + hinge.wing1 * -s3;
    return hinge;
}

/// A difference of two angles, brought to (-pi, pi].
real angle_difference(real angle, real rest_angle)
{
    real value = angle - rest_angle;
    value = SELECT(value > REAL(3.14159265358979323846), value - REAL(6.28318530717958647693), value);
    return SELECT(value < REAL(-3.14159265358979323846), value + REAL(6.28318530717958647693), value);
}

#endif
