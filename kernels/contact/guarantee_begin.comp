// Which vertices cannot go all their way in this substep, before pairs are asked: those that would leave the
// bound about their anchor, and those that are to stand still. What `finish` would not take becomes standing
// still, so that everything behind may rely on it. One invocation per vertex.
//
// Based on: guarantee_anchor's bound.
// Departures: none.
// Bytes per vertex: 80 read, 8 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/guarantee.glsl"

PARAMS
{
    uint count; // vertices
};

READ(0, rvec4, position);
READ(1, rvec4, low);
READ(2, rvec4, anchor);  // as guarantee_anchor says
UPDATE(3, rvec4, delta); // m, as the substep would end
WRITE(4, uint, asked);   // above 0: has to keep to its planes; one more word
WRITE(5, uint, next);    // 0; one more word
COUNTERS(6, events);

KERNEL(count)
{
    rvec4 wanted = delta[i];
    rvec4 rest = low[i];
    bool sound = is_sound(rvec3(position[i]), rvec3(wanted));
    if (!sound)
        delta[i] = rvec4(rvec3(rest), wanted.w);
    COUNT_EVENT_IF(!sound, events, TAUT_EVENT_NON_FINITE);
    rvec4 from = anchor[2u * i];
    rvec3 end = rvec3(from) + (sound ? rvec3(wanted) - rvec3(rest) : rvec3(real(0)));
    bool held = from.w < real(-1.5);
    bool inside = keeps_to(end, rvec3(anchor[2u * i + 1u]), from.w);
    asked[i] = held || inside ? 0u : 1u;
    next[i] = 0u;
    if (i == 0u)
    {
        asked[count] = 0u;
        next[count] = 0u;
    }
}
