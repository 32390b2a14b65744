// The motion of a body as a whole that its contacts allow: of the momentum that the sweeps of vertex block
// descent took from it, what contacts cannot have taken by Coulomb's law is given back, and what friction
// takes besides is taken. Behind shared/rigid_turn.glsl.
//
// Based on: Goyal, Ruina, Papadopoulos. Planar sliding with dry friction. Wear 143, 1991: the forces and
//   torques that the contacts of a body can bear together are the sums of what each can.
// Departures: force, torque about the normal n and torque across it are taken one by one, about the middle p
//   of the feet. N is what the body was held up by, in shares as the sweeps pushed. Contacts that slip bring
//   mu N against where their guess slips, the others may bring as much in any direction: a disc of forces, an
//   interval of torques about n (with the root mean square of the distance from p). Across n the middle of
//   the pushes may go to the edge of the evenly loaded rectangle that has the moments of the feet.
#ifndef TAUT_SHARED_VBD_WRENCH_GLSL
#define TAUT_SHARED_VBD_WRENCH_GLSL

/// Means of places, of their components' squares and products (yz, zx, xy), m and m^2.
struct Moments
{
    rvec3 middle, square, mixed;
};

/// Means over the rows of a body, with the inertia as weight: what lacks, m; place x what lacks, m^2; the
/// displacement as seen from what carries it, m; place x that.
struct Whole
{
    rvec3 lack, turn, moved, moved_turn;
    rvec3 middle, square, mixed; // of places
};

/// Of its feet: the sum of the pushes on them, N, and of their sizes; of friction times size where they hold,
/// N; with the size as weight the means of the height over the surface and of slip, m, and place x slip, m^2;
/// the sums of friction times size along the slip of the guess, N, and of place x that, N m.
struct Feet
{
    rvec3 push;
    real size, hold, height;
    rvec3 slip, slip_turn, rub, rub_turn;
    rvec3 middle, square, mixed; // of places
};

/// A rigid motion: `way` of the point `centre`, m, and a turn about it. Places are from the body's first row.
struct Shift
{
    rvec3 way, centre, turn;
};

Moments moments_of(rvec3 middle, rvec3 square, rvec3 mixed)
{
    Moments m;
    m.middle = middle;
    m.square = square;
    m.mixed = mixed;
    return m;
}

/// Of places from `at`.
Moments moments_about(Moments m, rvec3 at)
{
    rvec3 a = rvec3(at.y, at.z, at.x), b = rvec3(at.z, at.x, at.y);
    rvec3 k = rvec3(m.middle.y, m.middle.z, m.middle.x), l = rvec3(m.middle.z, m.middle.x, m.middle.y);
    PRECISE rvec3 middle = m.middle - at;
    PRECISE rvec3 square = m.square + at * (at - m.middle * real(2));
    PRECISE rvec3 mixed = m.mixed + a * b - a * l - k * b;
    return moments_of(middle, square, mixed);
}

/// The mean of (u . place)^2.
real spread_along(Moments m, rvec3 u)
{
    PRECISE real mixed = u.y * u.z * m.mixed.x + u.z * u.x * m.mixed.y + u.x * u.y * m.mixed.z;
    PRECISE real spread = dot(u * u, m.square) + real(2) * mixed;
    return max(spread, real(0));
}

/// The mean of |u x place|^2.
real spread_about(Moments m, rvec3 u)
{
    PRECISE real spread = (m.square.x + m.square.y + m.square.z) - spread_along(m, u);
    return max(spread, real(0));
}

rvec3 within(rvec3 v, real most)
{
    PRECISE real size = length(v);
    PRECISE rvec3 part = v * (size > most ? most / size : real(1));
    return part;
}

rvec3 direction_of(rvec3 v)
{
    PRECISE real size = length(v);
    PRECISE rvec3 u = v * (size > real(0) ? real(1) / size : real(0));
    return u;
}

/// Without what is along n.
rvec3 across_part(rvec3 v, rvec3 n)
{
    PRECISE rvec3 part = v - n * dot(v, n);
    return part;
}

/// By how much a slip counts: no more than the body as a whole takes part in, for feet may tremble.
/// agrees: slip . that of the body; square: slip . slip.
real shared_slip(real agrees, real square)
{
    return agrees > real(0) && square > real(0) ? min(agrees / square, real(1)) : real(0);
}

rvec3 turn_of(Moments m, rvec3 angular) { return rigid_turn(angular, m.middle, m.square, m.mixed); }

/// What takes up the momentum that a body lacks, and the angular momentum about its centre of mass.
Shift free_shift(Whole body)
{
    PRECISE rvec3 turn = body.turn - cross(body.middle, body.lack);
    Shift s;
    s.way = body.lack;
    s.centre = body.middle;
    s.turn = turn_of(moments_of(body.middle, body.square, body.mixed), turn);
    return s;
}

/// What friction leaves of a way along the surface, or of a turn about its normal, that lacks. What slips
/// takes `rub`, the others bear up to `hold` in any direction. It ends a slip, but does not turn it around:
/// no more than `room` against the rub.
rvec3 left_by_friction(rvec3 lack, rvec3 rub, real hold, real room)
{
    PRECISE rvec3 rest = lack - rub;
    PRECISE rvec3 left = rest - within(rest, hold);
    rvec3 u = direction_of(rub);
    PRECISE real beyond = max(-dot(left, u) - room, real(0));
    PRECISE rvec3 kept = left + u * beyond;
    return kept;
}

/// How far friction may take a slip back, along u.
real room_of(rvec3 slip, rvec3 moved, rvec3 rub)
{
    PRECISE real way = dot(slip, direction_of(rub));
    return max(way * shared_slip(dot(slip, moved), dot(slip, slip)), real(0));
}

/// The part about the normal n of an angular momentum over the mass that friction leaves. own: of the body,
/// from its centre of mass; body_turn: how it turned; way_of_push: m / N.
rvec3 left_spin(Feet feet, Moments own, rvec3 n, real twist, rvec3 body_turn, real way_of_push)
{
    real round =
        spread_about(moments_about(moments_of(feet.middle, feet.square, feet.mixed), feet.middle), n);
    PRECISE rvec3 slip_turn = feet.slip_turn - cross(feet.middle, feet.slip);
    PRECISE rvec3 rub_turn = feet.rub_turn - cross(feet.middle, feet.rub);
    PRECISE rvec3 spin = n * (round > real(0) ? dot(slip_turn, n) / round : real(0));
    PRECISE rvec3 body_spin = n * dot(body_turn, n);
    PRECISE rvec3 rub = n * (dot(rub_turn, n) * way_of_push);
    PRECISE real hold = feet.hold * way_of_push * sqrt(round);
    PRECISE real room = room_of(spin, body_spin, rub) * spread_about(own, n);
    return left_by_friction(n * twist, rub, hold, room);
}

/// The part of an angular momentum over the mass about axes across n that N, m, cannot bear. under: of the
/// feet, about their middle.
rvec3 left_tip(Moments under, rvec3 n, rvec3 tip, real carried)
{
    // Moments along two axes of the surface, and the axis u on which they are greatest.
    bool upright = abs(n.x) < real(0.6);
    PRECISE rvec3 across = cross(n, rvec3(upright ? real(1) : real(0), upright ? real(0) : real(1), real(0)));
    PRECISE rvec3 t = across / length(across);
    PRECISE rvec3 w = cross(n, t);
    PRECISE real a = spread_along(under, t), b = spread_along(under, w);
    PRECISE real both = (spread_along(under, t + w) - a - b) * real(0.5);
    PRECISE real mean = (a + b) * real(0.5), skew = (a - b) * real(0.5);
    PRECISE real radius = sqrt(skew * skew + both * both);
    PRECISE real forward = skew > real(0) ? skew + radius : both;
    PRECISE real aside = skew > real(0) ? both : radius - skew;
    PRECISE real size = sqrt(forward * forward + aside * aside);
    PRECISE rvec3 u = size > real(0) ? (t * forward + w * aside) / size : t;
    PRECISE rvec3 v = cross(n, u);
    PRECISE real long_half = carried * sqrt(real(3) * (mean + radius));
    PRECISE real short_half = carried * sqrt(real(3) * max(mean - radius, real(0)));
    PRECISE rvec3 lever = cross(n, tip);
    PRECISE real far = dot(lever, u), near = dot(lever, v);
    PRECISE rvec3 beyond = u * (far - clamp(far, -long_half, long_half)) +
                           v * (near - clamp(near, -short_half, short_half));
    PRECISE rvec3 left = cross(beyond, n);
    return left;
}

/// How a body turns that rests on the surface at `arm` from its centre of mass, with what stands still: the
/// moments about that centre, and those of the way along n that this place makes it go.
Moments resting_moments(Moments own, rvec3 a)
{
    PRECISE real half_square = dot(a, a) * real(0.5);
    PRECISE rvec3 square = own.square + (rvec3(half_square, half_square, half_square) - a * a);
    PRECISE rvec3 mixed = own.mixed - rvec3(a.y * a.z, a.z * a.x, a.x * a.y);
    return moments_of(rvec3(real(0)), square, mixed);
}

/// For a body with contacts. None where these oppose each other, as in a grip or a groove: no sum says what
/// they bear.
Shift supported_shift(Whole body, Feet feet)
{
    PRECISE real pushes = length(feet.push);
    Shift s;
    s.way = s.turn = rvec3(real(0));
    s.centre = body.middle;
    if (pushes < real(0.9) * feet.size)
        return s;
    PRECISE rvec3 n = feet.push / pushes;
    PRECISE rvec3 arm = feet.middle - body.middle;
    PRECISE rvec3 down = n * dot(arm, n);
    PRECISE rvec3 aside = cross(arm, n);
    Moments own = moments_about(moments_of(body.middle, body.square, body.mixed), body.middle);
    Moments under = moments_about(moments_of(feet.middle, feet.square, feet.mixed), feet.middle);
    Moments resting = resting_moments(own, aside);
    PRECISE real away = dot(body.lack, n);
    PRECISE real fall = clamp(-away, real(0), feet.height); // until the feet are on the surface
    PRECISE real stopped = max(-away - fall, real(0));
    PRECISE rvec3 along = body.lack - n * away;
    // Without friction: what tips, and the push that is left where the body falls about its feet.
    PRECISE rvec3 lack_turn = body.turn - cross(feet.middle, body.lack);
    PRECISE rvec3 tip = across_part(lack_turn + cross(arm, along), n);
    PRECISE rvec3 tips = left_tip(under, n, tip, stopped);
    rvec3 turns = turn_of(resting, tips);
    PRECISE real carried = max(stopped - dot(turns, aside), real(0));
    PRECISE real way_of_push = carried / pushes;
    PRECISE rvec3 rub = across_part(feet.rub, n) * way_of_push;
    PRECISE rvec3 body_turn = turn_of(own, body.moved_turn - cross(body.middle, body.moved));
    // Friction ends the slip of the feet, as the sweeps and that leave it.
    PRECISE real free = length(tip) > real(0) ? length(tips) / length(tip) : real(0);
    PRECISE rvec3 u = direction_of(rub + along);
    PRECISE real light = real(1) + free * max(dot(u, cross(turn_of(resting, cross(arm, u)), down)), real(0));
    PRECISE rvec3 ends = (along + cross(turns, down)) / light;
    PRECISE real room = room_of(across_part(feet.slip, n), body.moved + cross(body_turn, arm), rub) / light;
    PRECISE rvec3 way = along - (ends - left_by_friction(ends, rub, feet.hold * way_of_push, room));
    PRECISE rvec3 left = lack_turn + cross(arm, way);
    PRECISE real twist = dot(left, n);
    tips = left_tip(under, n, left - n * twist, carried);
    rvec3 spins = left_spin(feet, own, n, twist, body_turn, way_of_push);
    PRECISE rvec3 turn = turn_of(resting, tips + spins);
    PRECISE rvec3 all = way + n * (max(away, real(0)) - (fall + dot(turn, aside))); // feet do not pull
    s.turn = turn;
    s.way = all;
    return s;
}

/// The energy over the mass, m^2, that a shift about the centre of mass adds. fall: the way of gravity.
real energy_of(Shift s, Whole body, rvec3 fall)
{
    Moments own = moments_about(moments_of(body.middle, body.square, body.mixed), body.middle);
    PRECISE rvec3 momentum = body.moved_turn - cross(body.middle, body.moved);
    PRECISE real square = dot(s.turn, s.turn);
    PRECISE real spin = square * (own.square.x + own.square.y + own.square.z) - spread_along(own, s.turn);
    PRECISE real linear = dot(s.way, body.moved - fall) + dot(s.turn, momentum);
    PRECISE real added = linear + real(0.5) * (dot(s.way, s.way) + spin);
    return added;
}

#endif
