// Whether this substep begins with a search: because a vertex is not where the last one expected it
// (contact_stray), or has used up half of what the guarantee allows it (guarantee_filter). Group counts of
// the passes of a search, or none. One invocation.
//
// Based on: Verlet. Computer "Experiments" on Classical Fluids. Physical Review 159, 1967 (lists that last).
// Departures: indirect dispatches of no groups where they last.
// Bytes: 16 read, 92 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact_rows.h"

PARAMS
{
    uint count;     // 1
    uint triangles; // groups over triangles
    uint vertices;  // groups over vertices
    uint level_0;   // groups over the levels of the tree, from the leaves up; 0 beyond the root
    uint level_1;
    uint level_2;
    uint level_3;
};

READ(0, uint, lost);
UPDATE(1, uint, control);

KERNEL(count)
{
    uint strayed = lost[TAUT_CONTACT_STRAYED];
    uint open = strayed != control[TAUT_CONTACT_STRAYED_SEEN] ? 1u : 0u;
    control[TAUT_CONTACT_STRAYED_SEEN] = strayed;
    control[TAUT_CONTACT_GATE_TRIANGLES] = open * triangles;
    control[TAUT_CONTACT_GATE_VERTICES] = open * vertices;
    control[TAUT_CONTACT_GATE_ONE] = open;
    control[TAUT_CONTACT_GATE_PAIRS] = 0u; // contact_scan says how many, if there is a search
    control[TAUT_CONTACT_GATE_LEVELS] = open * level_0;
    control[TAUT_CONTACT_GATE_LEVELS + 4] = open * level_1;
    control[TAUT_CONTACT_GATE_LEVELS + 8] = open * level_2;
    control[TAUT_CONTACT_GATE_LEVELS + 12] = open * level_3;
    control[TAUT_CONTACT_SEARCHED] += open;
    control[TAUT_CONTACT_SINCE] = open == 0u ? control[TAUT_CONTACT_SINCE] + 1u : 1u;
}
