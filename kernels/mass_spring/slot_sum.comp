// The second pass after `spring_slots`: one invocation per vertex adds the slots of its springs in their
// order, end b with the opposite sign. The sum is that of `spring_force`, bit for bit.
// Bytes per vertex: 8 read, 16 written; per spring end 4 + 16 (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
};

READ(0, uint, start);    // count + 1: ends at vertex i are incident[start[i]] .. incident[start[i + 1] - 1]
READ(1, uint, incident); // 2 * spring + end, end 0 = a
READ(2, rvec4, slot);    // N, on end a
WRITE(3, rvec4, force);  // N

KERNEL(count)
{
    rvec3 sum = rvec3(real(0));
    for (uint k = start[i]; k < start[i + 1u]; ++k)
    {
        uint at = incident[k];
        rvec3 f = rvec3(slot[at / 2u]);
        sum += at % 2u == 0u ? f : -f;
    }
    force[i] = rvec4(sum, real(0));
}
