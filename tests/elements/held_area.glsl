// Keeps the area of a triangle: C = A - A0, A = |e1 x e2| / 2.
//
// Based on: the gradients of a triangle's area, half its unit normal turned by its edges.
// Departures: none.
//! corners 3
//! methods xpbd pbd mass_spring implicit_euler vbd

LAYOUT_STRUCT(HeldArea)
{
    uint a;
    uint b;
    uint c;
    real rest_area;  // m^2
    real compliance; // m^4/J
};

#define held_area_record HeldArea
#define held_area_v0(e) (e).a
#define held_area_v1(e) (e).b
#define held_area_v2(e) (e).c

INLINE ElementRow held_area_row(HeldArea t, rvec3 e1, rvec3 e2)
{
    ElementRow row;
    rvec3 normal = cross(e1, e2);
    real twice = length(normal);
    row.value = real(0.5) * twice - t.rest_area;
    row.compliance = t.compliance;
    row.divisor = real(2) * twice;
    row.shaped = twice > real(0);
    row.counted = !row.shaped;
    row.g1 = cross(e2, normal);
    row.g2 = cross(normal, e1);
    row.g0 = -(row.g1 + row.g2);
    real inverse = real(1) / SELECT(row.shaped, row.divisor * row.divisor, real(1));
    row.s0 = dot(row.g0, row.g0) * inverse;
    row.s1 = dot(row.g1, row.g1) * inverse;
    row.s2 = dot(row.g2, row.g2) * inverse;
    return row;
}
