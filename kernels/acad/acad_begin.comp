// Whether any spring is a constraint in this substep, or was in the last: then the passes that choose rows
// run, else none does, and nothing is solved. One invocation.
//
// Based on: docs/methods/acad.md.
// Departures: the count comes from the pass that forms the forces, which knows every spring's length anyway.
// Bytes: 40 read and written.
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/active_rows.h"

PARAMS
{
    uint count; // 1
    uint groups;
    uint springs;
};

UPDATE(0, uint, events);
UPDATE(1, uint, control);
UPDATE(2, uint, flags); // one a spring, then 1 where any may differ from TAUT_ACAD_SPRING

KERNEL(count)
{
    bool any = events[TAUT_EVENT_ACAD + i] != 0u;
    events[TAUT_EVENT_ACAD + i] = 0u;
    flags[springs + i] = any ? 1u : 0u;
    control[TAUT_ACAD_CHOOSE] = any ? groups : 0u;
    control[TAUT_ACAD_SCAN] = any ? 1u : 0u;
    if (!any)
    {
        control[TAUT_ACAD_SOLVE] = 0u;
        control[TAUT_ACAD_ONCE] = 0u;
        control[TAUT_ACAD_ROWS] = 0u;
        control[TAUT_ACAD_VERTICES] = 0u;
    }
}
