// Forces of one kind of element, one invocation per element: the force on each of its corners, the negative
// slope of its energy there, goes to a slot of its own. The pass `corner_sum` adds up what ends at each
// vertex.
//
// Based on: spring kernels of github.com/nakjun/Multi-Deformable-Objects-Simulation: slots for the
//   forces of springs, a second pass that sums them.
// Departures: any element (shared/element_form.glsl); the slots of all kinds of a scene are one buffer.
// Bytes per element: its record, 32 read and 16 written a corner (float).
//! each element of mass_spring
//! lanes
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/element.glsl"
#include TAUT_ELEMENT
#include "shared/element_form.glsl"

PARAMS
{
    uint count;
    uint first;  // slot of the first element's corner 0
    uint report; // 1: count elements without a shape
};

READ(0, OF_ELEMENT(record), constraint);
READ(1, rvec4, position); // xyz m, w = inverse mass 1/kg
READ(2, rvec4, low);      // m, what position lost to rounding
WRITE(3, rvec4, slot);    // N: slot[first + corners * element + corner]
COUNTERS(4, events);

INLINE void pull(ELEMENT k)
{
    OF_ELEMENT(record) c = constraint[k];
    rvec4 x0 = position[OF_ELEMENT(v0)(c)];
    rvec4 l0 = low[OF_ELEMENT(v0)(c)];
    rvec3 e1 = rvec3(position[OF_ELEMENT(v1)(c)] - x0) + rvec3(low[OF_ELEMENT(v1)(c)] - l0);
#if ELEMENT_CORNERS > 2
    rvec3 e2 = rvec3(position[OF_ELEMENT(v2)(c)] - x0) + rvec3(low[OF_ELEMENT(v2)(c)] - l0);
#endif
#if ELEMENT_CORNERS > 3
    rvec3 e3 = rvec3(position[OF_ELEMENT(v3)(c)] - x0) + rvec3(low[OF_ELEMENT(v3)(c)] - l0);
#endif
    ElementForm form = element_form(c, ELEMENT_EDGES);
#ifdef ELEMENT_WITH_ENERGY
    form.f0 = slope_of_first(form);
#endif
    slot[uint(ELEMENT_CORNERS) * k + first] = rvec4(-form.f0, real(0));
    slot[uint(ELEMENT_CORNERS) * k + (first + 1u)] = rvec4(-form.f1, real(0));
#if ELEMENT_CORNERS > 2
    slot[uint(ELEMENT_CORNERS) * k + (first + 2u)] = rvec4(-form.f2, real(0));
#endif
#if ELEMENT_CORNERS > 3
    slot[uint(ELEMENT_CORNERS) * k + (first + 3u)] = rvec4(-form.f3, real(0));
#endif
    if (report != 0u)
        COUNT_EVENT_IF(!form.shaped && form.counted, events, TAUT_EVENT_DEGENERATE);
}

KERNEL(count)
{
    pull(i);
}
