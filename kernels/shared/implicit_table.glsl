// Which elements meet at a vertex, and where their blocks lie in the matrix: one table of words. Two words a
// vertex and two more, {first word of its entries, place of its diagonal block}; the entries of vertex i end
// where those of i + 1 begin. An entry is one word that says which element and which of its corners, then for
// every other corner the place of the block of this vertex and that corner. A vertex that is not solved for
// (held, or without elements) has no entries.
#ifndef TAUT_SHARED_IMPLICIT_TABLE_GLSL
#define TAUT_SHARED_IMPLICIT_TABLE_GLSL

/// Of an element's word: this vertex counts it where it is degenerate. Of a place: the block holds nothing
/// yet.
#define TAUT_IMPLICIT_FIRST 0x80000000u
/// The place of a block that is not stored: its column is not solved for.
#define TAUT_IMPLICIT_NOWHERE 0xffffffffu
/// From one entry of a 3 x 3 block to the next (shared/bcsr3.h).
#define TAUT_IMPLICIT_STRIDE 32u

#define TAUT_IMPLICIT_BEGIN(i) table[2u * (i)]
#define TAUT_IMPLICIT_DIAGONAL(i) table[2u * (i) + 1u]

#endif
