// What kernels/plate and src/plan/plate.cpp agree on.
#ifndef TAUT_SHARED_PLATE_RULE_H
#define TAUT_SHARED_PLATE_RULE_H

// Reals a hinge: rest angle, share of the first side, then k0, k1, k2 of the first and of the second side.
#define TAUT_PLATE_RULE 8u

#endif
