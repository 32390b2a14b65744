// The second pass of the prefix sum: where rows, and vertices of rows, of each group begin. One group.
// It also sets the group counts of what follows, clears the sums of the solver to which groups without rows
// add nothing, and fills the last group of rows up with empty ones.
//
// Based on: docs/methods/acad.md; shared/scan.glsl.
// Departures: none.
// Bytes per group of rows (float): 16 read and written, 20 written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"
#include "shared/scan.glsl"

PARAMS
{
    uint count; // springs: most rows there may be
    uint chunk; // rows a group
    uint groups;
};

UPDATE(0, uint, sums); // groups of each: rows, vertices; afterwards where they begin
UPDATE(1, uint, control);
UPDATE(2, uint, solver_control);
UPDATE(3, uint, row_list); // [0]: how many
UPDATE(4, uint, list);     // [0]: how many vertices
UPDATE(5, Spring, row);
WRITE(6, real, partials);   // 3 a group
WRITE(7, real, curvatures); // 1 a group

SHARED(uint, rows_before, TAUT_LINEAR_GROUP);
SHARED(uint, vertices_before, TAUT_LINEAR_GROUP);
SHARED(uint, other, TAUT_LINEAR_GROUP);

GROUP_KERNEL(TAUT_LINEAR_GROUP)
{
    uint each = (groups + uint(TAUT_LINEAR_GROUP) - 1u) / uint(TAUT_LINEAR_GROUP);
    PHASE_BEGIN
    uint first = min(lane * each, groups);
    uint last = group == 0u ? min(first + each, groups) : first;
    uint rows = 0u;
    uint vertices = 0u;
    for (uint k = first; k < last; ++k)
    {
        rows += sums[k];
        vertices += sums[groups + k];
    }
    rows_before[lane] = rows;
    vertices_before[lane] = vertices;
    PHASE_END
    SCAN_LANES(rows_before, other)
    SCAN_LANES(vertices_before, other)
    uint rows = rows_before[TAUT_LINEAR_GROUP - 1];
    uint vertices = vertices_before[TAUT_LINEAR_GROUP - 1];
    uint used = (rows + chunk - 1u) / chunk;
    PHASE_BEGIN
    uint first = min(lane * each, groups);
    uint last = group == 0u ? min(first + each, groups) : first;
    uint row_at = lane > 0u ? rows_before[lane - min(lane, 1u)] : 0u;
    uint vertex_at = lane > 0u ? vertices_before[lane - min(lane, 1u)] : 0u;
    for (uint k = first; k < last; ++k)
    {
        uint row_count = sums[k];
        uint vertex_count = sums[groups + k];
        sums[k] = row_at;
        sums[groups + k] = vertex_at;
        row_at += row_count;
        vertex_at += vertex_count;
        for (uint p = 0u; p < 3u; ++p)
            partials[p * groups + k] = real(0);
        curvatures[k] = real(0);
    }
    PHASE_END
    uint filled = group == 0u ? min(used * chunk, count) : 0u;
    EACH_BEGIN(min(rows, filled), filled)
    // Member by member: the padding of a record in double stays what it was, the same on every device.
    row[i].a = 0u;
    row[i].b = 0u;
    row[i].rest_length = real(0);
    row[i].stiffness = real(0);
    row[i].damping = real(0);
    row[i].kind = 0u;
    EACH_END
    LANES_BEGIN(1)
    if (group == 0u)
    {
        control[TAUT_ACAD_SOLVE] = used;
        control[TAUT_ACAD_ONCE] = min(used, 1u);
        control[TAUT_ACAD_ROWS] = rows;
        control[TAUT_ACAD_VERTICES] = vertices;
        solver_control[TAUT_CONTROL_GROUPS] = used;
        row_list[0] = rows;
        list[0] = vertices;
    }
    LANES_END
}
