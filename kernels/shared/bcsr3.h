// Where 3 x 3 blocks lie, for kernels and host alike. Block rows stand in slices of 32; all block rows of a
// slice hold as many blocks as the longest of them, some of them zero. Slice s owns the steps
// slice_start[s]..slice_start[s + 1] - 1; step t holds one block of each of the 32 block rows r.
#ifndef TAUT_SHARED_BCSR3_H
#define TAUT_SHARED_BCSR3_H

#define TAUT_BCSR3_SLICE 32

/// Index of a block among the block columns.
#define TAUT_BCSR3_BLOCK(t, r) ((t) * 32u + (r))
/// Index of entry e = 3 i + j (row i, column j of the block) among the values.
#define TAUT_BCSR3_VALUE(t, e, r) (((t) * 9u + (e)) * 32u + (r))

#endif
