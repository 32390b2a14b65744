// Where the gradient of a row of constraints at one of its vertices lies: 2 * row + end for rows of springs,
// TAUT_CORNER_ROW + 4 * row + corner for rows of four corners.
#ifndef TAUT_SHARED_CORNER_ADDRESS_H
#define TAUT_SHARED_CORNER_ADDRESS_H

#define TAUT_CORNER_ROW 0x80000000u

#endif
