// Words that host and kernels agree on of contact between surfaces.
#ifndef TAUT_SHARED_CONTACT_ROWS_H
#define TAUT_SHARED_CONTACT_ROWS_H

/// ContactTriangle::owns: bit k, the corner k is this triangle's to look after; bit 3 + k, the side from
/// corner k to the next one is. Every vertex and side of a surface belongs to one triangle.
#define TAUT_CONTACT_OWNS_SIDE 3u
#define TAUT_CONTACT_OWNS_VERTICES 7u
#define TAUT_CONTACT_OWNS_ANY 63u
/// From this bit on: how many levels above the leaves the largest patch of the triangle begins that cannot
/// meet itself while it faces one way, 0 where there is none; patches begin TAUT_CONTACT_PATCH levels above.
#define TAUT_CONTACT_OWNS_PATCH 8u
#define TAUT_CONTACT_PATCH 5u

/// Bits of directions that a node faces (contact_refit): to faces and corners of a cube, to its edges.
#define TAUT_CONTACT_CORNER_BITS 0x3fffu
#define TAUT_CONTACT_EDGE_BITS 0xfffu

/// Pairs of a triangle that a search keeps while it counts, so that it need not look for them again.
#define TAUT_CONTACT_KEPT 16u

/// ContactPair::kind.
#define TAUT_CONTACT_VERTEX 0u // a against the triangle b, c, d
#define TAUT_CONTACT_EDGES 1u  // a-b against c-d

/// How the coefficients of two surfaces that rub make one: FrictionMix of scene/options.hpp in order.
#define TAUT_CONTACT_MIX_MEAN 0u
#define TAUT_CONTACT_MIX_MINIMUM 1u
#define TAUT_CONTACT_MIX_MAXIMUM 2u
#define TAUT_CONTACT_MIX_PRODUCT 3u
#define TAUT_CONTACT_MIX_GEOMETRIC_MEAN 4u

/// Words of the control buffer: group counts of the passes over pairs, then of those over vertices; pairs
/// listed; of the last search: pairs found, triangles compared. Over the whole run: pairs found and not
/// listed. With the guarantee: whether all stand still until the next search, because the last one did not
/// list everything; what was counted of searches cut short when they were looked at last. Then vertices that
/// stray, when they were looked at last; searches over the whole run; group counts of the passes of a search,
/// which are 0 in substeps without; substeps.
#define TAUT_CONTACT_PAIR_GROUPS 0
#define TAUT_CONTACT_VERTEX_GROUPS 4
#define TAUT_CONTACT_LISTED 8
#define TAUT_CONTACT_FOUND 9
#define TAUT_CONTACT_COMPARED 10
#define TAUT_CONTACT_MISSING 11
#define TAUT_CONTACT_HOLDS 12
#define TAUT_CONTACT_CUT_SEEN 13
#define TAUT_CONTACT_STRAYED_SEEN 14
#define TAUT_CONTACT_SEARCHED 15
#define TAUT_CONTACT_GATE_TRIANGLES 16
#define TAUT_CONTACT_SINCE 19 // substeps begun since the last search, with its own
#define TAUT_CONTACT_GATE_VERTICES 20
#define TAUT_CONTACT_GATE_ONE 24
#define TAUT_CONTACT_GATE_PAIRS 28
#define TAUT_CONTACT_GATE_LEVELS 32 // of the tree, 4 words each
#define TAUT_CONTACT_MOST_LEVELS 4
#define TAUT_CONTACT_WORDS 48

/// Words of the counters of what was left out: queries that were cut short, vertices with too many corners of
/// pairs; and of vertices that are not where the last search knew them to be, which make the next one.
#define TAUT_CONTACT_CUT 0
#define TAUT_CONTACT_CROWDED 1
#define TAUT_CONTACT_STRAYED 2 // with the guarantee those, too, that have used up half of what it lets them
#define TAUT_CONTACT_LOST_WORDS 3

/// With the guarantee more, a vertex and substep each: ways that were cut, vertices and pairs for which what
/// is held leaves no place, vertices that stood still because a pair of theirs could not be told apart or the
/// lists were too short.
#define TAUT_CONTACT_FILTERED 3
#define TAUT_CONTACT_PINCHED 4
#define TAUT_CONTACT_HELD 5
#define TAUT_CONTACT_GUARDED_LOST_WORDS 6

/// With the guarantee: how much of what a search reaches beyond a forecast each of two vertices may use up,
/// less than half of it. In percent: compilers agree on what 45 / 100 is, in float and in double.
#define TAUT_GUARANTEE_ROOM 45

/// Trips of a query's loop, and corners of pairs at one vertex, that a device can be trusted with.
#define TAUT_CONTACT_TRIPS 28000u
#define TAUT_CONTACT_CROWD 1000u

/// Invocations of a work group of the passes over pairs and vertices (runtime: kGroupSize).
#define TAUT_CONTACT_GROUP 64u

/// Lanes of the passes that refit the tree.
#define TAUT_CONTACT_REFIT 64

#endif
