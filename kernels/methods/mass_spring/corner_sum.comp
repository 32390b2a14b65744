// The second pass after `mass_spring`: one invocation per vertex adds the slots of the corners there, in the
// order of kinds and elements.
// Bytes per vertex: 8 read, 16 read and written; per corner 4 + 16 (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
    uint add; // 0: nothing else wrote forces, start from zero
};

READ(0, uint, start);    // count + 1: slots of vertex i are incident[start[i]] .. incident[start[i + 1] - 1]
READ(1, uint, incident);
READ(2, rvec4, slot);    // N
UPDATE(3, rvec4, force); // N

KERNEL(count)
{
    rvec3 sum = rvec3(add != 0u ? force[i] : rvec4(real(0)));
    for (uint k = start[i]; k < start[i + 1u]; ++k)
        sum += rvec3(slot[incident[k]]);
    force[i] = rvec4(sum, real(0));
}
