// The turn of a body as a whole that has a given angular momentum.
//
// Based on: Goldstein, Poole, Safko. Classical Mechanics, 3rd ed. 2002, 5.3 (the inertia tensor).
// Departures: none.
#ifndef TAUT_SHARED_RIGID_TURN_GLSL
#define TAUT_SHARED_RIGID_TURN_GLSL

/// w of I w = `angular`, I = sum m (r^2 1 - r r^T) / sum m about the centre of mass: the turn along its axis,
/// in rad for an angular momentum in m^2 rad. Given of places about a point of the body: their mean `centre`,
/// m; the means of their components' squares and products (yz, zx, xy), m^2. 0 of a body that lies on a line
/// or a point, where rounding would turn it.
rvec3 rigid_turn(rvec3 angular, rvec3 centre, rvec3 squares, rvec3 products)
{
    PRECISE rvec3 square = squares - centre * centre;
    // Half the trace of the moments about the centre of mass; small beside the centre's own it is rounding.
    PRECISE real trace = square.x + square.y + square.z;
    bool wide = trace > REAL(1e-4) * dot(centre, centre);
    PRECISE real scale = wide ? real(1) / trace : real(0); // torque and moments are taken in its unit
    PRECISE rvec3 turn = angular * scale;
    square *= scale;
    PRECISE real yz = (products.x - centre.y * centre.z) * scale;
    PRECISE real zx = (products.y - centre.z * centre.x) * scale;
    PRECISE real xy = (products.z - centre.x * centre.y) * scale;
    PRECISE real a = square.y + square.z, b = square.z + square.x, c = square.x + square.y;
    // The adjugate of the tensor (a, -xy, -zx; -xy, b, -yz; -zx, -yz, c), which is symmetric.
    PRECISE rvec3 first = rvec3(b * c - yz * yz, xy * c + yz * zx, xy * yz + b * zx);
    PRECISE rvec3 second = rvec3(first.y, a * c - zx * zx, a * yz + xy * zx);
    PRECISE rvec3 third = rvec3(first.z, second.z, a * b - xy * xy);
    PRECISE real determinant = a * first.x - xy * first.y - zx * first.z;
    bool solid = determinant > REAL(8e-6);
    PRECISE rvec3 out_turn = rvec3(dot(first, turn), dot(second, turn), dot(third, turn)) *
                             (solid ? real(1) / determinant : real(0));
    return out_turn;
}

#endif
