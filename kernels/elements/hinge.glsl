// Hinge of two triangles at their common edge: C = theta - theta0, wrapped to (-pi, pi]. Corners: the ends of
// the edge, then the two wings.
//
// Based on: Bridson, Marino, Fedkiw. Simulation of Clothing with Folds and Wrinkles. SCA 2003: the four
//   gradients.
// Departures: those of shared/hinge.glsl.
//! corners 4
//! methods xpbd pbd mass_spring implicit_euler
#include "shared/hinge.glsl"

#define hinge_record BendingConstraint
#define hinge_v0(e) (e).edge0
#define hinge_v1(e) (e).edge1
#define hinge_v2(e) (e).wing0
#define hinge_v3(e) (e).wing1

/// A wing without area has no angle.
INLINE ElementRow hinge_row(BendingConstraint c, rvec3 e1, rvec3 e2, rvec3 e3)
{
    ElementRow row;
    HingeShape hinge = hinge_shape(e1, e2, e3);
    row.value = angle_difference(hinge.angle, c.rest_angle);
    row.compliance = c.compliance;
    row.divisor = real(1);
    row.shaped = hinge.shaped;
    row.counted = !hinge.shaped;
    row.g0 = hinge.edge0;
    row.g1 = hinge.edge1;
    row.g2 = hinge.wing0;
    row.g3 = hinge.wing1;
    row.s0 = dot(row.g0, row.g0);
    row.s1 = dot(row.g1, row.g1);
    row.s2 = dot(row.g2, row.g2);
    row.s3 = dot(row.g3, row.g3);
    return row;
}
