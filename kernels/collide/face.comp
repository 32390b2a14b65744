// Triangles against colliders of one shape, so that edges and corners of a collider do not come through
// between the vertices, which collide.comp has pushed. One invocation per triangle; loops over the colliders.
// What each corner would go is left for face_move, since a vertex has several triangles.
//
// Based on: shared/face.glsl, and the shape's own file for which points of a triangle are in its way.
// Departures: friction is of the triangle as a whole against each collider, not of each point.
// Bytes per triangle: 8, of one that is near a collider 16 + 96 + 32 a collider more, and 48 where it is
// pushed (float).
//! each collider with faces
#include "shared/portable.glsl"
#include "shared/layouts.h"
#include "shared/contact.glsl"
#include "shared/face_state.h"
#define COLLIDER_MEETS_FACES 1
#include TAUT_COLLIDER

PARAMS
{
    uint count;     // triangles
    uint colliders; // of the shape
    uint listed;    // of them, those that any triangle meets
    uint substep;
    uint substeps;
    uint look;  // 1: which triangles may come near in this time step is not known yet
    uint first; // 1: the first sweep of the substep
    uint again; // 1: a sweep after the first of an iteration
};

READ(0, uint, corner);    // four a triangle: its vertices, and where its bits begin among `which`
READ(1, rvec4, position); // w = inverse mass
READ(2, rvec4, delta);    // m, w = gap kept from colliders
READ(3, OF_COLLIDER(record), collider);
READ(4, uint, which);     // the listed colliders, then bits by body: those that its triangles meet
READ_ONE(5, StepValues, step_values);
// Of a triangle that was pushed, of each corner m, and the share of pushes that it has. Then of each listed
// collider the impulse of friction in the substep so far, kg m, and w, the largest that there may be.
UPDATE(6, rvec4, slot);
UPDATE(7, uint, state); // of each triangle: TAUT_FACE_FAR, ...

/// Whether a triangle meets the collider in that place of the list.
INLINE bool meets(uint i, uint k)
{
    return ((which[listed + corner[4u * i + 3u] + k / 32u] >> (k % 32u)) & 1u) != 0u;
}

/// Where the middle of collider j is after so many substeps of the time step.
INLINE rvec3 middle_at(uint j, uint substeps_made)
{
#if COLLIDER_POSES
    return CENTRE_OF(collider[substeps_made * colliders + j]);
#else
    OF_COLLIDER(record) c = collider[j];
    rvec3 from = rvec3(c.start_x, c.start_y, c.start_z);
    return from + (rvec3(c.end_x, c.end_y, c.end_z) - from) * (real(substeps_made) / real(substeps));
#endif
}

/// In the frames of collider j. Of a shape "once" (shared/contact.glsl), which does not turn, from its
/// middle.
INLINE rvec3 seen_before(uint j, rvec3 v)
{
#if COLLIDER_POSES
    return INTO_FRAME(collider[substep * colliders + j], v);
#else
    return v;
#endif
}
INLINE rvec3 seen_after(uint j, rvec3 v)
{
#if COLLIDER_POSES
    return INTO_FRAME(collider[(substep + 1u) * colliders + j], v);
#else
    return v;
#endif
}
INLINE rvec3 in_world(uint j, rvec3 v)
{
#if COLLIDER_POSES
    return OUT_OF_FRAME(collider[(substep + 1u) * colliders + j], v);
#else
    return v;
#endif
}

INLINE OF_COLLIDER(record) record_after(uint j)
{
#if COLLIDER_POSES
    return collider[(substep + 1u) * colliders + j];
#else
    return collider[j];
#endif
}

/// Whether a triangle may come near collider j within the time step: the ball round its first corner that
/// holds the others, each of which may go twice as fast as in this substep, and what gravity adds.
INLINE bool comes_near(uint j, uint v0, uint v1, uint v2)
{
    rvec3 x = rvec3(position[v0]), side = rvec3(position[v1]) - x, other = rvec3(position[v2]) - x;
    real left = real(substeps - substep);
    rvec3 here = middle_at(j, substep);
    rvec3 own = middle_at(j, substeps) - here;
    rvec3 come0 = own - rvec3(delta[v0]) * left;
    rvec3 come1 = own - rvec3(delta[v1]) * left;
    rvec3 come2 = own - rvec3(delta[v2]) * left;
    real come = sqrt(max(dot(come0, come0), max(dot(come1, come1), dot(come2, come2))));
    real size = sqrt(max(dot(side, side), dot(other, other)));
    StepValues step = step_values[0];
    real time = step.substep * left;
    real fall = length(rvec3(step.gravity_x, step.gravity_y, step.gravity_z)) * (time * time);
    real near = (OF_COLLIDER(reach)(record_after(j), delta[v0].w) + size) + (real(2) * come + fall);
    return dot(x - here, x - here) <= near * near;
}

/// Whether a held corner is in the collider: then no push of the others brings the triangle out, and what
/// tries to gives them energy in every substep.
INLINE bool is_stuck(uint j, Face f)
{
    OF_COLLIDER(record) c = record_after(j);
    return (f.w0 == real(0) && OF_COLLIDER(contains)(c, f.gap_kept, f.e0)) ||
           (f.w1 == real(0) && OF_COLLIDER(contains)(c, f.gap_kept, f.e1)) ||
           (f.w2 == real(0) && OF_COLLIDER(contains)(c, f.gap_kept, f.e2));
}

APART void push_triangle(uint i)
{
    uint v0 = corner[4u * i], v1 = corner[4u * i + 1u], v2 = corner[4u * i + 2u];
    rvec3 x0 = rvec3(position[v0]), x1 = rvec3(position[v1]), x2 = rvec3(position[v2]);
    rvec3 d0 = rvec3(delta[v0]), d1 = rvec3(delta[v1]), d2 = rvec3(delta[v2]);
    rvec3 guess0 = d0, guess1 = d1, guess2 = d2;
    Face f;
    f.w0 = position[v0].w;
    f.w1 = position[v1].w;
    f.w2 = position[v2].w;
    f.share = rvec3(real(0));
    f.gap_kept = delta[v0].w;
    f.depenetration = step_values[0].depenetration;
    uint slots = 3u + listed;
    for (uint k = 0u; k < listed; ++k)
    {
        if (!meets(i, k))
            continue;
        uint j = which[k], mine = slots * i + 3u + k;
        rvec4 taken = first != 0u ? rvec4(real(0)) : slot[mine];
        rvec3 here = middle_at(j, substep), there = middle_at(j, substep + 1u);
        f.e0 = seen_after(j, (x0 - there) + d0);
        f.e1 = seen_after(j, (x1 - there) + d1);
        f.e2 = seen_after(j, (x2 - there) + d2);
        if (!OF_COLLIDER(apart)(record_after(j), f) && !is_stuck(j, f))
        {
            f.friction = record_after(j).friction;
            f.taken = rvec4(seen_after(j, rvec3(taken)), taken.w);
            f.p0 = seen_before(j, x0 - here);
            f.p1 = seen_before(j, x1 - here);
            f.p2 = seen_before(j, x2 - here);
            Face after = OF_COLLIDER(face)(record_after(j), f);
            d0 += in_world(j, after.e0 - f.e0);
            d1 += in_world(j, after.e1 - f.e1);
            d2 += in_world(j, after.e2 - f.e2);
            f.share = after.share;
            taken = rvec4(in_world(j, rvec3(after.taken)), after.taken.w);
        }
        slot[mine] = taken;
    }
    if ((f.share.x + f.share.y) + f.share.z > real(0))
    {
        state[i] = TAUT_FACE_PUSHED;
        slot[slots * i] = rvec4(d0 - guess0, f.share.x);
        slot[slots * i + 1u] = rvec4(d1 - guess1, f.share.y);
        slot[slots * i + 2u] = rvec4(d2 - guess2, f.share.z);
    }
}

// Most triangles are near no collider: what these cost is what the pass costs, so it is asked once a time
// step. One that is thrown at a collider within the step is missed until the next one.
KERNEL(count)
{
    bool near = state[i] != TAUT_FACE_FAR;
    if (look != 0u)
    {
        near = false;
        for (uint k = 0u; k < listed; ++k)
            near = near || (meets(i, k) && comes_near(which[k], corner[4u * i], corner[4u * i + 1u],
                                                      corner[4u * i + 2u]));
    }
    // Only what the first sweep pushed can still be in the way, but for what its neighbours draw in: the next
    // substep finds that.
    bool asked = near && (again == 0u || state[i] != TAUT_FACE_NEAR);
    if (again == 0u)
        state[i] = near ? TAUT_FACE_NEAR : TAUT_FACE_FAR;
    else if (asked)
        state[i] = TAUT_FACE_FREE;
    if (asked)
        push_triangle(i);
}
