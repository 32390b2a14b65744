// Vertex block descent: one invocation per vertex of one colour (no two share an element) minimises the
// substep's energy, inertia + springs + hinges + tetrahedra, over its own place, by one Newton step of three
// unknowns.
//
// Based on:
//   Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024: blocks f_i and H_i, one colour at a time.
//   Smith, de Goes, Kim. Stable Neo-Hookean Flesh Simulation. ACM TOG 37(2), 2018: tetrahedra. Their block is
//   positive definite by itself: det F is linear in the place of one vertex.
//   Chen, Hsieh, et al. Stabler Neo-Hookean Simulation: Absolute Eigenvalue Filtering for Projected Newton.
//   SIGGRAPH 2024: where a spring is compressed, the curvature across it counts by its size.
// Departures: that size is at most the stiffness along the spring; hinges and held volumes by Gauss-Newton
//   (outer product of the gradient; of a volume that is all there is). With the logarithm mu counts at least
//   9/16 in the block: its curvature is at most 9/8 mu |b|^2, and with half of the largest curvature in the
//   block no step raises the energy; a collapsed tetrahedron has next to none where the step begins. So every
//   block is positive definite. Leaving compressed parts out of springs (Choi, Ko 2002) lets a
//   stiff sheet that is slightly compressed gain energy: steps across are then far too long
//   (docs/methods/vbd.md). Pivots of the 3 x 3 factorisation are at least the inertia m / h^2, below which no
//   eigenvalue of the block lies, so rounding cannot turn a step around; a damper has a
//   potential, of how much its spring became longer in the substep. What rounding leaves of a length or an
//   angle at rest counts as zero: steps of one vertex after another are not opposite, and would push a free
//   sheet along by it.
// Bytes per vertex: 16 + 48 read, 16 written, with colliders 32 more read and 16 written; per spring 24 + 32
//   (damped 48), per hinge 24 + 128,
//   per held volume 24 + 96, per elastic tetrahedron 72 + 96 (float).
//! variant hinges HINGES=1
//! variant damped DAMPED=1
//! variant hinges_damped HINGES=1 DAMPED=1
//! variant volumes HINGES=1 VOLUMES=1
//! variant volumes_damped HINGES=1 VOLUMES=1 DAMPED=1
//! variant elastic HINGES=1 ELASTIC=1 DAMPED=1
//! variant added HINGES=1 ELASTIC=1 DAMPED=1 ADDED=1
//! variant tail TAIL=1
//! variant tail_hinges TAIL=1 HINGES=1
//! variant tail_damped TAIL=1 DAMPED=1
//! variant tail_hinges_damped TAIL=1 HINGES=1 DAMPED=1
//! variant tail_volumes TAIL=1 HINGES=1 VOLUMES=1
//! variant tail_volumes_damped TAIL=1 HINGES=1 VOLUMES=1 DAMPED=1
//! variant tail_elastic TAIL=1 HINGES=1 ELASTIC=1 DAMPED=1
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/spring.glsl"
#if HINGES
#include "shared/hinge.glsl"
#endif
#if ELASTIC
#include "shared/solid.glsl"
#endif
#include "shared/rise.glsl"
#include "shared/vbd_contact.glsl"
#include "shared/vbd_parts.h"

PARAMS
{
    uint first;       // first row
    uint count;       // rows: of one colour; in the tail variants of several
    uint report;      // 1: count elements without a direction or an angle
    float relaxation; // each step times this
    uint surfaces;    // where in `predicted`, or `block`, contacts begin (vbd_touch); 0 = none
};

READ(0, uint, row);        // four words a row, five with tetrahedra: shared/vbd_rows.glsl
READ(1, Spring, end);      // a = this vertex, b = the other; those of row k end where row k + 1 begins
READ(2, rvec4, position);  // xyz m, w = inverse mass 1/kg
#if ADDED
UPDATE(3, rvec4, block); // what inertia and added elements bring (kernels/methods/vbd/vbd.comp)
#define CONTACTS block
#else
UPDATE(3, rvec4, predicted); // xyz: inertial guess of the displacement, m; w = inertia m / h^2, kg/s^2
#define CONTACTS predicted
#endif
#if TAIL
GROUP_UPDATE(4, rvec4, delta); // displacement since the start of the substep, m
#else
UPDATE(4, rvec4, delta);
#endif
COUNTERS(5, events);
#if HINGES
// Hinges of which this vertex is one corner; behind the hinges of all rows the tetrahedra of which it is the
// second one. A held volume has the words of a hinge: V0 for the angle. Where there are elastic tetrahedra, a
// hinge is one with its angle and compliance for b00, b01, and a held volume one of no mu.
#if ELASTIC
READ(6, SolidTetrahedron, corner);
#else
READ(6, BendingConstraint, corner);
#endif
#if DAMPED
READ(7, rvec4, low); // m: where in `delta` a vertex stood before the substep
#endif
#elif DAMPED
READ(6, rvec4, low);
#endif

#include "shared/vbd_rows.glsl"

#if HINGES
rvec3 from_to(uint a, uint b)
{
    return rvec3(position[b] - position[a]) + rvec3(delta[b] - delta[a]);
}
#endif

/// Relative size of what rounding leaves of the length of a spring at rest: two units of the last digit.
real last_digits()
{
#if TAUT_REAL_DOUBLE
    return REAL(4.5e-16);
#else
    return REAL(2.4e-7);
#endif
}

void solve(uint k)
{
    uint v = row_word(k, 0u);
    rvec4 x = position[v];
    rvec4 d = delta[v];
#if ADDED
    rvec4 known = block[3u * v];
    real inertia = known.w;
    rvec3 f = rvec3(known);
    rvec3 diagonal = rvec3(block[3u * v + 1u]);
    rvec3 mixed = rvec3(block[3u * v + 2u]);
#else
    rvec4 y = predicted[v];
    real inertia = y.w;
    rvec3 f = rvec3(y - d) * inertia;
    rvec3 diagonal = rvec3(real(0)); // the block beside `even`: xx, yy, zz
    rvec3 mixed = rvec3(real(0));    // xy, xz, yz
#endif
    real even = inertia; // the block's multiple of the identity
#if DAMPED
    real inverse_substep = sqrt(inertia * x.w);
    rvec3 moved = rvec3(d - low[v]);
#endif
    for (uint j = row_word(k, 1u); j < row_word(k + 1u, 1u); ++j)
    {
        Spring s = end[j];
        rvec4 far = position[s.b];
        rvec4 far_delta = delta[s.b];
        rvec3 e = rvec3(x - far) + rvec3(d - far_delta);
        real len = length(e);
        bool usable = len > real(0);
        rvec3 n = e / (usable ? len : real(1));
        real across = usable ? min(abs(real(1) - s.rest_length / len), real(1)) : real(0);
        real along = usable ? s.stiffness * (real(1) - across) : real(0);
        real stretch = len - s.rest_length;
        stretch = abs(stretch) > last_digits() * len ? stretch : real(0);
        real pull = usable ? s.stiffness * stretch : real(0); // no direction, no force
        real sideways = s.stiffness * across;
#if DAMPED
        // Of the potential c/2 (length - first length)^2 / h.
        rvec3 change = moved - rvec3(far_delta - low[s.b]);
        real first_length = length(e - change);
        real drag = s.damping * inverse_substep;
        pull += drag * lengthening(e - change, change, len + first_length, real(1));
        sideways = usable ? min(abs(pull) / len, s.stiffness + drag) : real(0);
        along = usable ? (s.stiffness + drag) - sideways : real(0);
#endif
        f -= n * pull;
        even += sideways;
        diagonal += n * n * along;
        mixed += rvec3(n.x * n.y, n.x * n.z, n.y * n.z) * along;
        if (report != 0u)
        {
            if (!usable && s.rest_length > real(0) && (v < s.b || far.w <= real(0)))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
#if HINGES
    for (uint j = row_word(k, 2u); j < row_word(k + 1u, 2u); ++j)
    {
        BendingConstraint c = hinge_at(j);
        HingeShape shape =
            hinge_shape(from_to(c.edge0, c.edge1), from_to(c.edge0, c.wing0), from_to(c.edge0, c.wing1));
        rvec3 g = v == c.edge0   ? shape.edge0
                  : v == c.edge1 ? shape.edge1
                  : v == c.wing0 ? shape.wing0
                                 : shape.wing1;
        g = shape.shaped ? g : rvec3(real(0));
        rvec3 stiff = g / c.compliance;
        real turn = angle_difference(shape.angle, c.rest_angle);
        f -= stiff * (abs(turn) > real(2) * last_digits() ? turn : real(0));
        diagonal += g * stiff;
        mixed += rvec3(g.x * stiff.y, g.x * stiff.z, g.y * stiff.z);
        if (report != 0u)
        {
            if (!shape.shaped && counts_for(v, c))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
    }
#endif
#if VOLUMES || ELASTIC
    for (uint j = row_word(k, 4u); j < row_word(k + 1u, 4u); ++j)
    {
#if ELASTIC
        SolidTetrahedron t = corner[j];
        uint v0 = t.a, v2 = t.c, v3 = t.d;
#else
        BendingConstraint t = corner[j];
        uint v0 = t.edge0, v2 = t.wing0, v3 = t.wing1;
#endif
        rvec4 p0 = position[v0];
        rvec4 d0 = delta[v0];
        rvec3 e1 = rvec3(x - p0) + rvec3(d - d0);
        rvec3 e2 = rvec3(position[v2] - p0) + rvec3(delta[v2] - d0);
        rvec3 e3 = rvec3(position[v3] - p0) + rvec3(delta[v3] - d0);
#if ELASTIC
        rvec3 g = cross(e2, e3) / (real(6) * t.volume); // of det F
        Deformation shape = deformation_of(t, e1, e2, e3);
        rvec3 pulled = gradient_b(t, shape.f0, shape.f1, shape.f2);
        real mu = t.mu * t.volume;
        real even_share = mu * shape.share;
        rvec3 stiff = g * (t.lambda * t.volume);
        // One product at a time: of sums of two chains Mesa takes factors out, and the last bit differs.
        f -= pulled * even_share;
        f -= stiff * (dot(e1, g) - t.rest);
        even += mu * max(shape.share, real(0.5625)) * ((t.b00 * t.b00 + t.b01 * t.b01) + t.b02 * t.b02);
        real beyond = shape.square + real(1);
        rvec3 curved = pulled * ((real(2) * mu) * (t.log_term / (beyond * beyond)));
        if (report != 0u)
        {
            if (t.mu > real(0) && is_collapsed(shape) && leads(v, v0, p0.w) &&
                leads(v, v2, position[v2].w) && leads(v, v3, position[v3].w))
                COUNT_EVENT(events, TAUT_EVENT_DEGENERATE);
        }
        diagonal += pulled * curved;
        diagonal += g * stiff;
        mixed += rvec3(pulled.x * curved.y, pulled.x * curved.z, pulled.y * curved.z);
        mixed += rvec3(g.x * stiff.y, g.x * stiff.z, g.y * stiff.z);
#else
        rvec3 g = cross(e2, e3) / real(6);
        rvec3 stiff = g / t.compliance;
        f -= stiff * (dot(e1, g) - t.rest_angle);
        diagonal += g * stiff;
        mixed += rvec3(g.x * stiff.y, g.x * stiff.z, g.y * stiff.z);
#endif
    }
#endif
    Block h;
    h.diagonal = rvec3(diagonal.x + even, diagonal.y + even, diagonal.z + even);
    h.mixed = mixed;
    h.pivot.x = max(h.diagonal.x, inertia);
    h.below.x = mixed.x / h.pivot.x;
    h.below.y = mixed.y / h.pivot.x;
    h.pivot.y = max(h.diagonal.y - h.below.x * mixed.x, inertia);
    real rest = mixed.z - h.below.x * mixed.y;
    h.below.z = rest / h.pivot.y;
    h.pivot.z = max(h.diagonal.z - h.below.y * mixed.y - h.below.z * rest, inertia);
    rvec3 push = solution_of(h, f) * real(relaxation);
    rvec4 reaction = rvec4(real(0));
    if (surfaces != 0u)
    {
        uint at = surfaces + TAUT_VBD_CONTACT * v;
        StoppedStep stopped = stopped_step(h, f, rvec3(d), push, CONTACTS[at + TAUT_VBD_PLANE],
                                           CONTACTS[at + TAUT_VBD_DRAG]);
        push = stopped.step;
        reaction = stopped.reaction;
    }
    bool finite = abs(push.x) + abs(push.y) + abs(push.z) < REAL(1e18);
    if (surfaces != 0u)
        CONTACTS[surfaces + TAUT_VBD_CONTACT * v + TAUT_VBD_REACTION] = finite ? reaction : rvec4(real(0));
    delta[v] = finite ? d + rvec4(push, real(0)) : d;
    if (!finite)
        COUNT_EVENT(events, TAUT_EVENT_NON_FINITE);
}

#if TAIL
// One group does several small colours, one after another. Folded dispatches may bring groups too many.
GROUP_KERNEL(64)
{
    uint last = group == 0u ? first + count : first;
    for (uint begin = first; begin < last; begin = row_word(begin, 3u))
    {
        PHASE_BEGIN
        for (uint k = begin + lane; k < row_word(begin, 3u); k += 64u)
            solve(k);
        PHASE_END
    }
}
#else
KERNEL(count)
{
    solve(first + i);
}
#endif
