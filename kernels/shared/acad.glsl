// When a spring is a constraint. The passes that ask (acad_force, acad_flag) must agree to the last bit, so
// the rule stands here and compares squares that nobody may rearrange.
//
// Based on: Va, Choi, Hong. Real-time Cloth Simulation Using Compute Shader (ACAD), docs/methods/acad.md.
// Departures: none.
#ifndef TAUT_SHARED_ACAD_GLSL
#define TAUT_SHARED_ACAD_GLSL

#include "shared/active_rows.h"

/// Lengths, over the length at rest, at which a spring changes.
struct AcadLimits
{
    real longer;   // beyond: a constraint
    real slack;    // a stretched constraint below it: a spring
    real shorter;  // below: a compressed constraint; 0: none is
    real unloaded; // a compressed constraint beyond it: a spring
};

/// Strains as sums of two floats. `compress`: 1 where compressed springs become constraints, too. A release
/// of -1 (multipliers decide) leaves the lengths 0 and 2.
AcadLimits acad_limits(float activate_high, float activate_low, float release_high, float release_low,
                       uint compress)
{
    real activate = real(activate_high) + real(activate_low);
    real release = real(release_high) + real(release_low);
    AcadLimits at;
    at.longer = real(1) + activate;
    at.slack = real(1) + release;
    at.shorter = compress != 0u ? real(1) - activate : real(0);
    at.unloaded = real(1) - release;
    return at;
}

/// What a spring is in this substep: TAUT_ACAD_SPRING, _ROW or _PRESSED. `flag`: what it was.
uint acad_next(uint flag, bool may, rvec3 d, real rest_length, AcadLimits at)
{
    PRECISE real squared = dot(d, d);
    PRECISE real longer = rest_length * at.longer;
    PRECISE real slack = rest_length * at.slack;
    PRECISE real shorter = rest_length * at.shorter;
    PRECISE real unloaded = rest_length * at.unloaded;
    bool stays = (flag == TAUT_ACAD_ROW && squared >= slack * slack) ||
                 (flag == TAUT_ACAD_PRESSED && squared <= unloaded * unloaded);
    bool can = may && rest_length > real(0);
    uint fresh = can && squared < shorter * shorter ? TAUT_ACAD_PRESSED : TAUT_ACAD_SPRING;
    fresh = can && squared > longer * longer ? TAUT_ACAD_ROW : fresh;
    return stays ? flag : fresh;
}

#endif
