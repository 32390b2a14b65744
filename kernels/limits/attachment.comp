// Vertices no further from their pin than they may be, whatever lies between. One invocation per attached
// vertex; pins are never attached, so nobody writes what another reads.
//
// Based on: Kim, Chentanez, Mueller-Fischer. Long Range Attachments: A Method to Simulate Inextensible
//   Clothing in Computer Games. SCA 2012.
// Departures: one attachment a vertex, to the pin that is nearest at rest.
// Bytes per element: 12 attachment + 64 read + 16 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
};

READ(0, Attachment, attachment);
READ(1, rvec4, position);
UPDATE(2, rvec4, delta); // displacement since the start of the substep, m

KERNEL(count)
{
    Attachment c = attachment[i];
    rvec4 own = delta[c.vertex];
    rvec3 d = rvec3(position[c.vertex] - position[c.pin]) + rvec3(own - delta[c.pin]);
    real len = length(d);
    bool beyond = len > c.limit;
    real scale = (c.limit - len) / len;
    scale = beyond ? scale : real(0);
    delta[c.vertex] = rvec4(rvec3(own) + d * scale, own.w);
}
