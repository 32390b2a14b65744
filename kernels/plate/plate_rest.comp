// Where the two sides of each hinge of a plate would go by themselves, and the rest angle that follows for
// the method's own hinges. One invocation per hinge:
//
//   p_t = b_t - (K b)_te / (mu K_ee)  =  k0 b_t + k1 b_f + k2 b_g,   r = theta0 + p_0 + p_1,
//
// K the stiffness of the triangle t against turns at its edges e, f, g, and mu its largest eigenvalue when
// scaled to a unit diagonal: with mu K_ee on the diagonal no step of all sides at once raises the energy.
//
// Based on: plate_turn.comp.
// Departures: none.
// Bytes per hinge: 4 + 16 + 28 + 24 read, 12 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/plate_rule.h"

PARAMS
{
    uint count;
};

READ(0, uint, record);               // of the hinge, in `hinge`
READ(1, uint, neighbour);            // four a hinge: places in `turn` of the first triangle's other edges,
                                     // then of the second's
READ(2, real, rule);                 // shared/plate_rule.h
READ(3, real, turn);                 // b of both sides, rad
WRITE(4, real, pull);                // p of both sides, rad
UPDATE(5, BendingConstraint, hinge); // its rest angle, rad

KERNEL(count)
{
    uint at = TAUT_PLATE_RULE * uint(i);
    uint to = 4u * uint(i);
    real first = (rule[at + 2u] * turn[2u * uint(i)] + rule[at + 3u] * turn[neighbour[to]]) +
                 rule[at + 4u] * turn[neighbour[to + 1u]];
    real second = (rule[at + 5u] * turn[2u * uint(i) + 1u] + rule[at + 6u] * turn[neighbour[to + 2u]]) +
                  rule[at + 7u] * turn[neighbour[to + 3u]];
    pull[2u * uint(i)] = first;
    pull[2u * uint(i) + 1u] = second;
    hinge[record[i]].rest_angle = rule[at] + (first + second);
}
