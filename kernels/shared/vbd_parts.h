// What the groups of vbd_rise and vbd_drift leave of their rows (body_parts.h): kernels and host.
#ifndef TAUT_SHARED_VBD_PARTS_H
#define TAUT_SHARED_VBD_PARTS_H

/// Reals that a group leaves, for vbd_choose: the rise but for what the mean does, inertia, inertia times
/// displacement (3) and times guess (3), nothing (2), the displacement of the row that the body's groups
/// share (3). For vbd_limit the rise is that of the elements and, of a body with something held, the work of
/// gravity taken off; the guess is what the velocity brought; and instead of nothing inertia times the
/// squares of both.
#define TAUT_VBD_SUMS 13u
/// Reals that a group leaves for vbd_shift, all with the inertia as weight: 1, what lacks (3), place from the
/// body's first row (3), place x what lacks (3), products of the place's components (xx, yy, zz, yz, zx, xy),
/// what contacts pushed in the substep before (3).
#define TAUT_VBD_DRIFT 19u
/// Behind the groups: the way of gravity in a substep (3), written by vbd_choose.
#define TAUT_VBD_FALL 3u

#endif
