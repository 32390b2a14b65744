// Held volume of a tetrahedron: C = V - V0 with the signed volume V = e1 . (e2 x e3) / 6.
//
// Based on:
//   Mueller, Chentanez, Kim, Macklin. Strain Based Dynamics. SCA 2014, and Mueller, Heidelberger, Hennix,
//   Ratcliff. Position Based Dynamics. 2007: the gradients are a sixth of the cross products of edges.
// Departures: none.
//! corners 4
//! methods xpbd pbd
//! with bounds

#define volume_record VolumeConstraint
#define volume_v0(e) (e).a
#define volume_v1(e) (e).b
#define volume_v2(e) (e).c
#define volume_v3(e) (e).d

/// A tetrahedron collapsed to a line has no gradient; nor has one whose moving corners all lie in one plane
/// through an edge.
INLINE ElementRow volume_row(VolumeConstraint c, rvec3 e1, rvec3 e2, rvec3 e3)
{
    ElementRow row;
    row.g1 = cross(e2, e3);
    row.g2 = cross(e3, e1);
    row.g3 = cross(e1, e2);
    row.g0 = -((row.g1 + row.g2) + row.g3);
    row.value = dot(e1, row.g1) * REAL(0.16666666666666666667) - c.rest_volume;
    row.compliance = c.compliance;
    row.divisor = real(6);
    row.s0 = dot(row.g0, row.g0) * REAL(0.027777777777777777778);
    row.s1 = dot(row.g1, row.g1) * REAL(0.027777777777777777778);
    row.s2 = dot(row.g2, row.g2) * REAL(0.027777777777777777778);
    row.s3 = dot(row.g3, row.g3) * REAL(0.027777777777777777778);
    row.shaped = (row.s0 + row.s1) + (row.s2 + row.s3) > real(0);
    row.counted = row.divisor > real(0); // always
    return row;
}
