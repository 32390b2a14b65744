// The rigid motion of what carries a body in a substep, as vbd_frame leaves it in `sums`. Behind that buffer.
#ifndef TAUT_SHARED_VBD_FRAME_GLSL
#define TAUT_SHARED_VBD_FRAME_GLSL

/// Whether anything does. at: where in `sums` a group's frame is.
bool is_carried(uint at) { return sums[at] > real(0); }

/// The way that it goes at r, m from the body's first row: w + t x (r - p).
rvec3 carried_way(uint at, rvec3 r)
{
    rvec3 way = rvec3(sums[at + 1u], sums[at + 2u], sums[at + 3u]);
    rvec3 place = rvec3(sums[at + 4u], sums[at + 5u], sums[at + 6u]);
    rvec3 turn = rvec3(sums[at + 7u], sums[at + 8u], sums[at + 9u]);
    return way + cross(turn, r - place);
}

#endif
