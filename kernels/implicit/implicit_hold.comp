// Which vertices the next Newton step leaves where they are: those that nothing solves for, and light ones
// that a collider has moved since the step before. A light vertex between a collider and a heavy body would
// else give way in every solve and be put back after it, and hold up nothing but itself. One invocation per
// vertex.
//
// Based on: Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, section 5 (constrained vertices
//   leave the system).
// Departures: all three directions are held, for the rest of the substep alone: colliders have taken their
//   friction. A held vertex gives its body any friction that it takes to stay, which is why heavier ones are
//   left to the push after the solve: that keeps to Coulomb's law.
// Bytes per vertex: 16 + 32 read, 12 written (float).
#include "shared/portable.glsl"

PARAMS
{
    uint count;
    uint first; // 1: of the substep; nothing has been moved yet
};

READ(0, uint, held);    // three words a vertex; not 0: not solved for
READ(1, uint, light);   // not 0: far lighter than its body's other vertices
READ(2, rvec4, before); // m, displacements before the colliders
READ(3, rvec4, delta);  // m, after them
UPDATE(4, uint, marks); // three words a vertex; not 0: stays where it is

KERNEL(count)
{
    rvec3 was = rvec3(before[i]);
    rvec3 now = rvec3(delta[i]);
    bool moved = first == 0u && light[i] != 0u && (now.x != was.x || now.y != was.y || now.z != was.z);
    bool stays = held[3u * i] != 0u || moved || (first == 0u && marks[3u * i] != 0u);
    uint mark = stays ? 1u : 0u;
    marks[3u * i] = mark;
    marks[3u * i + 1u] = mark;
    marks[3u * i + 2u] = mark;
}
