// A spring whose force grows with the cube of its stretch: C = s |s|, s = |x1 - x0| - L, so that
// C^2 / (2 a) = s^4 / (2 a).
//
// Based on: the law of Duffing's oscillator without its linear part.
// Departures: none.
//! corners 2
//! methods xpbd pbd mass_spring implicit_euler vbd

LAYOUT_STRUCT(CubicSpring)
{
    uint a;
    uint b;
    real rest_length; // m
    real compliance;  // m^4/J
};

#define cubic_spring_record CubicSpring
#define cubic_spring_v0(e) (e).a
#define cubic_spring_v1(e) (e).b

INLINE ElementRow cubic_spring_row(CubicSpring c, rvec3 e1)
{
    ElementRow row;
    real len = length(e1);
    real stretch = len - c.rest_length;
    real slope = real(2) * abs(stretch); // dC / d len
    row.value = stretch * abs(stretch);
    row.compliance = c.compliance;
    row.divisor = len;
    row.shaped = len > real(0);
    row.counted = c.rest_length > real(0) && !row.shaped;
    row.g1 = e1 * slope;
    row.g0 = -row.g1;
    row.s0 = slope * slope;
    row.s1 = row.s0;
    return row;
}
