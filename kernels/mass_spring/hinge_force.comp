// Forces of hinges, gathered: one invocation per vertex adds -(theta - rest) / compliance times the gradient
// at its corner, over the hinges there in their order. Each hinge is evaluated four times.
//
// Based on: Bridson, Marino, Fedkiw 2003 (shared/hinge.glsl).
// Departures: the force is that of the energy (theta - rest)^2 / (2 compliance); a hinge without an angle has
//   none and is counted at its first corner.
// Bytes per vertex: 24 read, 16 read and written; per corner 28 + 128 (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/hinge.glsl"

PARAMS
{
    uint count;
    uint add;    // 0: nothing else wrote forces, start from zero
    uint report; // 1: count hinges without an angle
};

READ(0, uint, start);    // count + 1: corners at vertex i: incident[start[i]] .. incident[start[i + 1] - 1]
READ(1, uint, incident); // 4 * hinge + corner, corners edge0, edge1, wing0, wing1
READ(2, BendingConstraint, hinge);
READ(3, rvec4, position); // m
READ(4, rvec4, low);      // m
UPDATE(5, rvec4, force);  // N
COUNTERS(6, events);

rvec3 from_to(uint a, uint b)
{
    return rvec3(position[b] - position[a]) + rvec3(low[b] - low[a]);
}

KERNEL(count)
{
    rvec3 sum = rvec3(add != 0u ? force[i] : rvec4(real(0)));
    for (uint k = start[i]; k < start[i + 1u]; ++k)
    {
        uint corner = incident[k] % 4u;
        BendingConstraint c = hinge[incident[k] / 4u];
        HingeShape shape =
            hinge_shape(from_to(c.edge0, c.edge1), from_to(c.edge0, c.wing0), from_to(c.edge0, c.wing1));
        rvec3 gradient = corner == 0u   ? shape.edge0
                         : corner == 1u ? shape.edge1
                         : corner == 2u ? shape.wing0
                                        : shape.wing1;
        real torque = angle_difference(shape.angle, c.rest_angle) / c.compliance;
        sum -= shape.shaped ? gradient * torque : rvec3(real(0));
        if (report != 0u)
        {
            if (corner == 0u && !shape.shaped)
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
    force[i] = rvec4(sum, real(0));
}
