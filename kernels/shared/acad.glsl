// When a spring is a constraint. The passes that ask (spring_force, acad_flag) must agree to the last bit, so
// the rule stands here and compares squares that nobody may rearrange.
//
// Based on: Va, Choi, Hong. Real-time Cloth Simulation Using Compute Shader (ACAD), docs/methods/acad.md.
// Departures: stretched springs only.
#ifndef TAUT_SHARED_ACAD_GLSL
#define TAUT_SHARED_ACAD_GLSL

#include "shared/active_rows.h"

/// (1 + strain) as a real, from two floats whose sum is the strain.
real acad_stretch(float high, float low)
{
    return real(1) + (real(high) + real(low));
}

/// What a spring is in this substep. `flag`: what it was; `activate`, `release`: lengths over the length at
/// rest.
uint acad_next(uint flag, bool may, rvec3 d, real rest_length, real activate, real release)
{
    PRECISE real squared = dot(d, d);
    PRECISE real upper = rest_length * activate;
    PRECISE real lower = rest_length * release;
    bool longer = may && rest_length > real(0) && squared > upper * upper;
    bool shorter = squared < lower * lower;
    bool row = flag == TAUT_ACAD_ROW ? !shorter : longer;
    return row ? TAUT_ACAD_ROW : TAUT_ACAD_SPRING;
}

#endif
