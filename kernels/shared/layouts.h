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

/// A spring with a damper, for methods of forces: -(stiffness (|d| - rest_length) + damping v.n) n.
LAYOUT_STRUCT(Spring)
{
    uint a;
    uint b;
    real rest_length; // m
    real stiffness;   // N/m
    real damping;     // N s/m
    uint kind;        // SpringKind of the scene
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

/// Keeps the signed volume of a tetrahedron at rest_volume.
LAYOUT_STRUCT(VolumeConstraint)
{
    uint a;
    uint b;
    uint c;
    uint d;
    real rest_volume; // m^3
    real compliance;  // m^6/J; 0 = rigid
};

/// An elastic tetrahedron (src/plan/solid.hpp): F = [xb - xa, xc - xa, xd - xa] B, B by rows.
LAYOUT_STRUCT(SolidTetrahedron)
{
    uint a;
    uint b;
    uint c;
    uint d;
    real b00, b01, b02; // 1/m
    real b10, b11, b12;
    real b20, b21, b22;
    real volume;        // at rest, m^3
    real mu;            // Pa
    real lambda;        // Pa
    real rest;          // det F at which the second term vanishes
    real log_term;      // 1 with the logarithm, 0 without
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

/// Where a collider that may turn is at one end of a substep: its centre and the axes of its own frame (unit,
/// at right angles). Capsule: all points within `radius` of the segment of 2 half_length along its y axis.
LAYOUT_STRUCT(CapsuleCollider)
{
    real centre_x, centre_y, centre_z; // m
    real x_x, x_y, x_z;                // its x axis, in the world
    real y_x, y_y, y_z;
    real z_x, z_y, z_z;
    real half_length; // m
    real radius;      // m
    real friction;    // Coulomb coefficient, >= 0
};

/// Box with edges of twice its half sizes along its axes.
LAYOUT_STRUCT(CuboidCollider)
{
    real centre_x, centre_y, centre_z; // m
    real x_x, x_y, x_z;                // its x axis, in the world
    real y_x, y_y, y_z;
    real z_x, z_y, z_z;
    real half_x, half_y, half_z; // m
    real friction;
};

/// Distances to a closed surface at the points of a grid: point (i, j, k) lies at low + cell (i, j, k) in its
/// frame, and its distance is values[first + i + count_x (j + count_y k)], m.
LAYOUT_STRUCT(DistanceFieldCollider)
{
    real centre_x, centre_y, centre_z; // m
    real x_x, x_y, x_z;                // its x axis, in the world
    real y_x, y_y, y_z;
    real z_x, z_y, z_z;
    real low_x, low_y, low_z; // m, of point (0, 0, 0)
    real cell;                // m, between neighbours
    real friction;
    uint count_x, count_y, count_z; // points along each axis, >= 2
    uint first;
};

/// Keeps |x_vertex - x_pin| at most `limit`.
LAYOUT_STRUCT(Attachment)
{
    uint vertex;
    uint pin;
    real limit; // m
};

/// A triangle that air acts on.
LAYOUT_STRUCT(WindTriangle)
{
    uint a;
    uint b;
    uint c;
    uint unused;
    real mass; // kg, three times the least share of its corners' masses
    real drag; // along the normal
    real friction_drag;
};

/// A triangle of a surface that meets others, a leaf of the tree (shared/contact_rows.h).
LAYOUT_STRUCT(ContactTriangle)
{
    uint a;
    uint b;
    uint c;
    uint body;
    uint owns;
};

/// How a body's surface meets others.
LAYOUT_STRUCT(ContactBody)
{
    real radius;   // m
    real friction; // Coulomb coefficient
    uint self;     // 1: it meets itself
    uint group;    // a bit
    uint meets;    // bits of the groups that it does not pass through
    uint height;   // of two that touch, the higher is on top at first
};

/// Four corners of a vertex and a triangle, or of two edges, that come near each other in a step.
LAYOUT_STRUCT(ContactPair)
{
    uint a;
    uint b;
    uint c;
    uint d;
    uint kind; // TAUT_CONTACT_*
};

/// On which side of each other a pair is, and how it is to stay. As four rvec4, contact_make alone writes the
/// second, contact_push only the last of the third.
LAYOUT_STRUCT(ContactSide)
{
    real normal_x, normal_y, normal_z;     // from the second of the pair to the first
    real allowed;                          // where the gap may end in this substep, m
    real rest_gap;                         // m
    real friction;
    real unused_x, unused_y;               // 0
    real slipped_x, slipped_y, slipped_z;  // m: what a pair that sticks slipped, less sum weight (x - x_a)
    real sticks;                           // 1: friction holds it
    real weight_b, weight_c, weight_d;     // of the last sweep
    real unused_z;                         // 0
};

/// The air during a time step. One element, written by the host.
LAYOUT_STRUCT(WindValues)
{
    real start_x, start_y, start_z; // m/s
    real end_x, end_y, end_z;       // m/s
    real density;                   // kg/m^3
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
    real braked;           // sqrt(m), and no further than this times the root of its depth
};

/// Where a conjugate-gradient solve stands (linear/cg.hpp). Two copies hand it round the iteration: one is
/// written by `cg_direction`, the other by `cg_step` and `cg_restart`, so no pass reads what it writes.
/// Products are of vectors scaled as the solver scales them; "rr" is r.r, "rz" is r.z with z = M^-1 r.
LAYOUT_STRUCT(CgState)
{
    real tolerance_squared;   // of |r| / |b|
    real replacement_squared; // rr below this share of `peak`: form the residual anew
    real growth_squared;      // rr above this multiple of max(bb, first rr): the iteration runs away
    real epsilon;             // rounding unit of the vectors
    real bb;         // b.b
    real rz;         // of the direction in hand
    real rr;         // recursive, of the residual in hand
    real step;       // alpha of the direction in hand, not yet added to x; 0 = none
    real pmp;        // p.Mp of the direction in hand, by recurrence
    real curvature;  // p.Ap of the direction in hand
    real steepest;   // largest p.Ap / p.Mp so far
    real peak;       // largest rr since the residual was formed anew
    real lowest;     // smallest recursive rr since the residual was formed anew
    real best;       // smallest rr of a residual formed anew
    uint iteration;
    uint iteration_limit;
    uint patience;   // iterations without a new `lowest` after which the residual is formed anew
    uint waited;     // iterations since `lowest`
    uint status;     // TAUT_CG_*
    uint begun;      // 0: bb is not known yet
    uint fresh;      // 1: the residual was just formed anew
    uint direction;  // in hand: TAUT_DIRECTION_*
    uint exhausted;  // 1: p.Ap was below what rounding lets one tell from zero
    uint stalls;     // residuals formed anew in a row that were not half of the best before
    uint replacements;
    uint unused;     // keeps the size a multiple of 8
};

/// What the linear solves of a run came to. One element, only added to.
LAYOUT_STRUCT(SolveLog)
{
    uint solves;      // that had something to solve
    uint iterations;  // of all
    uint most;        // iterations of the longest
    uint limited;     // ended at the iteration limit
    uint failed;      // ended with another status than converged, limited or zero right-hand side
    uint last_status; // TAUT_CG_*
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

/// CgState::status. Where words of docs/statuses.md have more than one cause there is one number a cause.
#define TAUT_CG_RUNNING 0
#define TAUT_CG_CONVERGED 1
#define TAUT_CG_ITERATION_LIMIT 2
#define TAUT_CG_INDEFINITE_MATRIX 3
#define TAUT_CG_INDEFINITE_PRECONDITIONER 4
#define TAUT_CG_NON_FINITE 5
#define TAUT_CG_STALLED 6   // checks found no progress
#define TAUT_CG_EXHAUSTED 7 // no direction with a curvature above rounding
#define TAUT_CG_RAN_AWAY 8  // the residual grew beyond growth_squared
#define TAUT_CG_ZERO_RIGHT_HAND_SIDE 9

/// CgState::direction.
#define TAUT_DIRECTION_NONE 0      // the next one is z alone
#define TAUT_DIRECTION_STEEPEST 1  // z alone, of a residual just formed
#define TAUT_DIRECTION_CONJUGATE 2

/// Lanes of a work group of the linear kernels, and the words of their control buffer: group counts of the
/// passes of an iteration, of the passes that form the residual anew, then the history (float bits of
/// |r|/|b|).
#define TAUT_LINEAR_GROUP 128
#define TAUT_SMALL_ROWS 1024 // largest system that one group solves: its direction lies in shared memory
#define TAUT_CONTROL_ITERATE 0
#define TAUT_CONTROL_REPLACE 4
#define TAUT_CONTROL_HISTORY 8

#endif
