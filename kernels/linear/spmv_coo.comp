// Entries one by one, sorted by row: A x but for the rows that entries of several groups make up. Of those
// each group leaves its share in `carries`, for coo_carry, which also clears rows without entries.
//
// Based on: Bell, Garland. Implementing Sparse Matrix-Vector Multiplication on Throughput-Oriented
//   Processors. SC 2009 (COO: segmented reduction with carries).
// Departures: no atomics, and one fixed order: a lane adds SHARE neighbours from left to right, a scan over
//   the lanes joins what runs across them, and a carry runs from tile to tile.
// Bytes per entry (float): 12 read, 16 with low words; per row 4 written (pairs 8).
//! variant residual_pairs PAIRS=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/two_float.glsl"

PARAMS
{
    uint count; // entries, below 2^31
    uint chunk; // of them a group
    uint groups;
    uint low_words; // 0: `low` may be anything
};

READ(0, uint, row); // ascending
READ(1, uint, column);
READ(2, real, values);
READ(3, real, x); // PAIRS: high and low word in turn, as all that follows
#undef PUT
#undef ROWS
#if PAIRS
UPDATE(4, real, sums);
#define PUT(buffer, at, term) buffer[2u * (at)] = (term).high; buffer[2u * (at) + 1u] = (term).low;
#define ROWS sums
#else
UPDATE(4, real, y);
#define PUT(buffer, at, term) buffer[at] = term;
#define ROWS y
#endif
WRITE(5, real, carries); // of each group: of the row that began before; then of the row that goes on behind
#if PAIRS
READ(6, real, low);
#endif

#define TERMS_ONLY 1
#include "shared/row_terms.glsl"

#define SHARE 7u // entries of a lane; odd, so that lanes meet different banks of shared memory
#define TILE (7 * TAUT_LINEAR_GROUP)
#define NO_ROW 0xFFFFFFFFu

SHARED(Term, products, TILE);
SHARED(uint, place, TILE + 1);              // rows of the products, and of the entry behind
SHARED(Term, head, TAUT_LINEAR_GROUP);      // the first row that ends in a lane: this lane's part of it
SHARED(uint, head_row, TAUT_LINEAR_GROUP);
SHARED(Term, open_sum, 2 * TAUT_LINEAR_GROUP);  // of the row that goes on behind the lane; two copies
SHARED(uint, cut, 2 * TAUT_LINEAR_GROUP);       // 1: that row does not go back to the lane before
SHARED(Term, carry, 1);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint begin = min(group * chunk, count);
    uint end = min(begin + chunk, count);
    uint first_row = NO_ROW; // where it began before this group
    if (begin > 0u && begin < end && row[begin - 1u] == row[begin])
        first_row = row[begin];
    LANES_BEGIN(1)
    carry[0] = no_term();
    LANES_END
    for (uint tile = begin; tile < end; tile += uint(TILE))
    {
        uint stop = min(tile + uint(TILE), end);
        EACH_BEGIN(tile, stop)
        products[i - tile] = term(i, column[i]);
        place[i - tile] = row[i];
        EACH_END
        LANES_BEGIN(1)
        place[stop - tile] = stop < count ? row[stop] : NO_ROW;
        LANES_END
        PHASE_BEGIN
        uint from = min(lane * SHARE, stop - tile);
        uint to = min(from + SHARE, stop - tile);
        Term s = no_term();
        uint ended = NO_ROW;
        for (uint k = from; k < to; ++k)
        {
            s = add_term(s, products[k]);
            uint at = place[k];
            if (place[k + 1u] != at)
            {
                if (ended == NO_ROW)
                {
                    head[lane] = s;
                    ended = at;
                }
                else
                {
                    PUT(ROWS, at, s)
                }
                s = no_term();
            }
        }
        head_row[lane] = ended;
        if (lane == 0u && ended == NO_ROW)
            s = add_term(carry[0], s);
        open_sum[lane] = s;
        cut[lane] = ended == NO_ROW ? 0u : 1u;
        PHASE_END
        uint now = 0u;
        for (uint width = 1u; width < uint(TAUT_LINEAR_GROUP); width *= 2u)
        {
            uint other = uint(TAUT_LINEAR_GROUP) - now;
            PHASE_BEGIN
            Term s = open_sum[now + lane];
            uint is_cut = cut[now + lane];
            if (lane >= width && is_cut == 0u)
            {
                s = add_term(open_sum[now + lane - width], s);
                is_cut = cut[now + lane - width];
            }
            open_sum[other + lane] = s;
            cut[other + lane] = is_cut;
            PHASE_END
            now = other;
        }
        PHASE_BEGIN
        uint at = head_row[lane];
        if (at != NO_ROW)
        {
            Term before = carry[0];
            if (lane > 0u)
                before = open_sum[now + lane - 1u];
            Term s = add_term(before, head[lane]);
            if (at == first_row)
            {
                PUT(carries, group, s)
            }
            else
            {
                PUT(ROWS, at, s)
            }
        }
        PHASE_END
        LANES_BEGIN(1)
        carry[0] = open_sum[now + uint(TAUT_LINEAR_GROUP) - 1u];
        LANES_END
    }
    LANES_BEGIN(1)
    if (begin < end && end < count && row[end] == row[end - 1u])
    {
        uint at = row[end] == first_row ? group : groups + group;
        PUT(carries, at, carry[0])
    }
    LANES_END
}
