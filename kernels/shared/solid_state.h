// What a Newton step of implicit Euler keeps of an elastic tetrahedron: its stress and how that changes with
// F, both times volume, h^2 and the system's unit of mass. Reals, in this order: the stress by columns (9),
// then of the symmetric 9 x 9 matrix dP/dF the blocks by columns of F: 00, 11, 22 (xx, xy, xz, yy, yz, zz
// each), 01, 02, 12 (by rows).
#ifndef TAUT_SHARED_SOLID_STATE_H
#define TAUT_SHARED_SOLID_STATE_H

#define TAUT_SOLID_STATE 54u

#endif
