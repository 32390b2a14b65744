// Records that host and kernels share. Scalars only, so that std430 and C++ agree; the build checks
// every size and offset by static_assert against what glslang says.
// On the host each record is a template over `real`; in a kernel it is a plain struct.
#ifndef TAUT_SHARED_LAYOUTS_H
#define TAUT_SHARED_LAYOUTS_H

#ifdef TAUT_HOST
#include <cstdint>
namespace taut::layout {
using uint = std::uint32_t;
#define LAYOUT_STRUCT(name) template <typename real> struct name
#endif

/// Keeps |x_a - x_b| at rest_length [m].
LAYOUT_STRUCT(DistanceConstraint)
{
    uint a;
    uint b;
    real rest_length; // m
    real compliance;  // m/N; 0 = rigid
};

/// Keeps the angle between two triangles that share the edge edge0-edge1 at rest_angle.
LAYOUT_STRUCT(BendingConstraint)
{
    uint edge0;
    uint edge1;
    uint wing0;
    uint wing1;
    real rest_angle; // rad, in (-pi, pi]
    real compliance; // rad/(N m); 0 = rigid
};

/// Half-space {x : dot(normal, x) >= offset}; normal has length 1. Start and end of a time step.
LAYOUT_STRUCT(PlaneCollider)
{
    real normal_x, normal_y, normal_z;
    real offset_start; // m
    real offset_end;   // m
    real shift_x, shift_y, shift_z; // displacement over the step, m (drags by friction)
    real friction;     // Coulomb coefficient, >= 0
};

/// Ball of radius `radius` that moves in a straight line during a time step.
LAYOUT_STRUCT(SphereCollider)
{
    real start_x, start_y, start_z; // m
    real end_x, end_y, end_z;       // m
    real radius;                    // m
    real friction;
};

/// What changes from step to step. One element, written by the host before each step.
LAYOUT_STRUCT(StepValues)
{
    real substep;          // s
    real inverse_substep;  // 1/s
    real gravity_x, gravity_y, gravity_z; // m/s^2
    real damping_factor;   // exp(-damping * substep), 1 = none
    real max_speed;        // m/s; velocities beyond it are clamped and counted
    real depenetration;    // m, largest way out of an initial penetration per substep
};

#ifdef TAUT_HOST
#undef LAYOUT_STRUCT
} // namespace taut::layout
#endif

/// Slots of the event counters that kernels raise (COUNT_EVENT) and reports read.
#define TAUT_EVENT_NON_FINITE 0
#define TAUT_EVENT_SPEED_CLAMP 1
#define TAUT_EVENT_DEGENERATE 2
#define TAUT_EVENT_CONFLICT 3
#define TAUT_EVENT_COUNT 4

#endif
