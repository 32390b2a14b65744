// What position-based dynamics does to a spring, a hinge and a tetrahedron, for its coloured and its Jacobi
// kernels.
//
// Based on: Mueller, Heidelberger, Hennix, Ratcliff. Position Based Dynamics. VRIPHYS 2006 / JVCIR 18(2),
//   2007: section 4.1 (stretch) and 4.4 (bending).
//   Va, Choi, Hong. Efficient Simulation of Volumetric Deformable Objects in Unity3D: GPU-Accelerated
//   Position-Based Dynamics. Electronics 12(10), 2023: the volume of each tetrahedron.
// Departures: `share` is the part of a correction that one iteration makes, 1 - (1 - k)^(1/n); the angle of a
//   hinge comes from shared/hinge.glsl, not from acos; places are differences plus displacements; no corner
//   of a tetrahedron goes further at once than its longest edge from the first corner.
#ifndef TAUT_SHARED_PBD_GLSL
#define TAUT_SHARED_PBD_GLSL

#include "shared/hinge.glsl"

/// Displacement per inverse mass of end a (end b has its negative); zero where there is no direction.
struct SpringPush
{
    rvec4 push; // kg m, w = 0
    rbool usable;
};

SpringPush spring_push(DistanceConstraint c, rvec4 xa, rvec4 xb, rvec4 da, rvec4 db, real share)
{
    SpringPush out_push;
    rvec4 d = (xa - xb) + (da - db);
    real len = length(rvec3(d));
    real denominator = (xa.w + xb.w) * len;
    out_push.usable = denominator > REAL(1e-30); // coincident or held ends have none; smaller would overflow
    real scale = (c.rest_length - len) * share / denominator;
    scale = SELECT(out_push.usable, scale, real(0));
    out_push.push = d * scale;
    out_push.push.w = real(0);
    return out_push;
}

/// Displacements per inverse mass of the four corners.
struct HingePush
{
    rvec3 edge0, edge1, wing0, wing1; // kg m
    rbool shaped;
};

HingePush hinge_push(BendingConstraint c, rvec4 p0, rvec4 p1, rvec4 p2, rvec4 p3,
                     rvec4 d0, rvec4 d1, rvec4 d2, rvec4 d3, real share)
{
    HingePush out_push;
    HingeShape hinge = hinge_shape(rvec3(p1 - p0) + rvec3(d1 - d0), rvec3(p2 - p0) + rvec3(d2 - d0),
                                   rvec3(p3 - p0) + rvec3(d3 - d0));
    real weight = p0.w * dot(hinge.edge0, hinge.edge0) + p1.w * dot(hinge.edge1, hinge.edge1) +
                  p2.w * dot(hinge.wing0, hinge.wing0) + p3.w * dot(hinge.wing1, hinge.wing1);
    rbool usable = hinge.shaped && weight > real(0); // held vertices alone may carry the gradient
    real scale = angle_difference(hinge.angle, c.rest_angle) * -share / SELECT(usable, weight, real(1));
    scale = SELECT(usable, scale, real(0));
    out_push.edge0 = hinge.edge0 * scale;
    out_push.edge1 = hinge.edge1 * scale;
    out_push.wing0 = hinge.wing0 * scale;
    out_push.wing1 = hinge.wing1 * scale;
    out_push.shaped = hinge.shaped;
    return out_push;
}

/// Displacements per inverse mass of the four corners of a tetrahedron.
struct VolumePush
{
    rvec3 a, b, c, d; // kg m
    rbool usable;
};

/// A nearly collapsed tetrahedron has hardly a gradient and would be thrown far beyond the body: its corners
/// go no further than its longest edge, so that it grows back over several iterations.
VolumePush volume_push(VolumeConstraint c, rvec4 p0, rvec4 p1, rvec4 p2, rvec4 p3,
                       rvec4 d0, rvec4 d1, rvec4 d2, rvec4 d3, real share)
{
    VolumePush out_push;
    rvec3 e1 = rvec3((p1 - p0) + (d1 - d0));
    rvec3 e2 = rvec3((p2 - p0) + (d2 - d0));
    rvec3 e3 = rvec3((p3 - p0) + (d3 - d0));
    // Six times the gradients, of six times the volume.
    rvec3 g1 = cross(e2, e3);
    rvec3 g2 = cross(e3, e1);
    rvec3 g3 = cross(e1, e2);
    rvec3 g0 = -((g1 + g2) + g3);
    real s0 = dot(g0, g0);
    real s1 = dot(g1, g1);
    real s2 = dot(g2, g2);
    real s3 = dot(g3, g3);
    real weight = ((p0.w * s0 + p1.w * s1) + p2.w * s2) + p3.w * s3;
    // Squares, since drivers have an instruction of their own for a quotient by a root.
    real fastest = max(max((p0.w * p0.w) * s0, (p1.w * p1.w) * s1),
                       max((p2.w * p2.w) * s2, (p3.w * p3.w) * s3));
    real reach = max(dot(e1, e1), max(dot(e2, e2), dot(e3, e3)));
    out_push.usable = weight > REAL(1e-30) && fastest > REAL(1e-30); // smaller would overflow
    real missing = c.rest_volume * real(6) - dot(e1, g1);
    real scale = missing * share / SELECT(out_push.usable, weight, real(1));
    real limit = sqrt(reach / SELECT(out_push.usable, fastest, real(1)));
    scale = SELECT(out_push.usable, min(max(scale, -limit), limit), real(0));
    out_push.a = g0 * scale;
    out_push.b = g1 * scale;
    out_push.c = g2 * scale;
    out_push.d = g3 * scale;
    return out_push;
}

#endif
