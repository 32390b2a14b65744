// What the groups of vbd_rise, vbd_carry, vbd_frame and vbd_drift leave of their rows (body_parts.h), and
// what vbd_touch keeps of vertices: kernels and host.
#ifndef TAUT_SHARED_VBD_PARTS_H
#define TAUT_SHARED_VBD_PARTS_H

/// Reals that a group leaves, for vbd_choose: the rise but for what the mean does, inertia, inertia times
/// displacement (3) and times guess (3), nothing (2), the displacement of the row that the body's groups
/// share (3). For vbd_limit the rise is that of the elements and, of a body with something held or carried,
/// the work of gravity taken off; the guess is what the velocity brought; and instead of nothing inertia
/// times the squares of both. Of a carried body all ways are as seen from what carries it.
#define TAUT_VBD_SUMS 13u
/// Reals that a group leaves for vbd_shift, all with the inertia as weight: 1, what lacks (3), place from the
/// body's first row (3), place x what lacks (3), squares of the place's components (3) and their products
/// (yz, zx, xy). As many for vbd_frame, with the depth of the guess below a surface as weight, and its way
/// for what lacks.
#define TAUT_VBD_LACK 1u
#define TAUT_VBD_PLACE 4u
#define TAUT_VBD_TURN 7u
#define TAUT_VBD_SQUARE 10u
#define TAUT_VBD_MIXED 13u
#define TAUT_VBD_DRIFT 16u
/// Behind these, of bodies that colliders may touch: what they pushed after the sweeps of the substep before,
/// with the inertia as weight, N (3). Feet are vertices that were pushed in the sweeps, or else whose guess
/// goes below a surface, which count as if they were pushed out alone: the pushes, N (3), the sum of their
/// sizes, and that of friction times size where it holds; the number of feet, the sums of their places (3),
/// squares (3) and products (3).
#define TAUT_VBD_PUSHED 0u
#define TAUT_VBD_PUSH 3u
#define TAUT_VBD_SIZE 6u
#define TAUT_VBD_HOLD 7u
#define TAUT_VBD_COUNT 8u
#define TAUT_VBD_FEET 9u
#define TAUT_VBD_FEET_SQUARE 12u
#define TAUT_VBD_FEET_MIXED 15u
#define TAUT_VBD_TOUCH 18u
/// Behind these: with the size of the push as weight slip (3) and place x slip (3); friction times that size
/// along the slip of the guess, where it does not hold (3), place x that (3); with the inertia as weight the
/// displacement as seen from what carries the body (3), place x that (3); with the size as weight the height
/// over the surface.
#define TAUT_VBD_SLIP 0u
#define TAUT_VBD_SLIP_TURN 3u
#define TAUT_VBD_RUB 6u
#define TAUT_VBD_RUB_TURN 9u
#define TAUT_VBD_MOVED 12u
#define TAUT_VBD_MOVED_TURN 15u
#define TAUT_VBD_HEIGHT 18u
#define TAUT_VBD_RUBBING 19u
#define TAUT_VBD_PARTS (TAUT_VBD_DRIFT + TAUT_VBD_TOUCH + TAUT_VBD_RUBBING)
/// What a group says of what carries its body (shared/vbd_frame.glsl): 1 where something does, the way of the
/// middle of its contacts (3), that place from the body's first row (3), the turn about it (3).
#define TAUT_VBD_FRAME 10u
/// Behind the groups: the way of gravity in a substep (3), written by vbd_choose.
#define TAUT_VBD_FALL 3u
/// What vbd_touch keeps of a vertex, four reals each: the plane in its way (n, least n . displacement, m),
/// the way of the surface, m, with its friction, and what vbd_solve leaves of its push (N).
#define TAUT_VBD_PLANE 0u
#define TAUT_VBD_DRAG 1u
#define TAUT_VBD_REACTION 2u
#define TAUT_VBD_CONTACT 3u

#endif
