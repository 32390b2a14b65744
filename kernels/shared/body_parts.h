// How the rows of bodies are dealt to groups, which form a body's sums part by part: kernels and host.
#ifndef TAUT_SHARED_BODY_PARTS_H
#define TAUT_SHARED_BODY_PARTS_H

/// Words of a group: a row of the body (every group of a body has the same), the first of the group's rows in
/// the list, their end, the body's first group, the one behind its last, 1: something of the body is held.
#define TAUT_BODY_PART 6u
/// Reals that a group leaves for momentum_turn, all with the mass as weight: 1, angular momentum that lacks
/// (3), place from the body's first row (3), squares of the place's components (3), their products (yz, zx,
/// xy).
#define TAUT_MOMENTUM_SUMS 13u

#endif
