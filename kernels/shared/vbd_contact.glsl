// The step of one vertex under vertex block descent, and what becomes of it where a collider is in the way.
//
// Based on: Chen, Liu, Yang, Yuksel. Vertex Block Descent. SIGGRAPH 2024: blocks f_i and H_i.
//   Jourdan, Alart, Jean. A Gauss-Seidel like algorithm to solve frictional contact problems. CMAME 155,
//   1998: one contact after another is solved exactly, with Coulomb's law.
// Departures: a contact is of one vertex against a surface that does not give, so both are solved at once.
//   What slips is pulled against the force that would have held it; where that pull takes away three quarters
//   of what gives way along the normal, friction is left out.
#ifndef TAUT_SHARED_VBD_CONTACT_GLSL
#define TAUT_SHARED_VBD_CONTACT_GLSL

/// The block H of a vertex, N/m, and its factors L D L^T.
struct Block
{
    rvec3 diagonal; // xx, yy, zz
    rvec3 mixed;    // xy, xz, yz
    rvec3 pivot;    // D
    rvec3 below;    // L: 21, 31, 32
};

/// H^-1 f.
rvec3 solution_of(Block h, rvec3 f)
{
    real z2 = f.y - h.below.x * f.x;
    real z3 = (f.z - h.below.y * f.x) - h.below.z * z2;
    real step_z = z3 / h.pivot.z;
    real step_y = z2 / h.pivot.y - h.below.z * step_z;
    real step_x = (f.x / h.pivot.x - h.below.x * step_y) - h.below.y * step_z;
    return rvec3(step_x, step_y, step_z);
}

/// H v.
rvec3 product_of(Block h, rvec3 v)
{
    return rvec3(h.diagonal.x * v.x + h.mixed.x * v.y + h.mixed.y * v.z,
                 h.mixed.x * v.x + h.diagonal.y * v.y + h.mixed.z * v.z,
                 h.mixed.y * v.x + h.mixed.z * v.y + h.diagonal.z * v.z);
}

/// A step, and the force with which the surface answers, N.
struct StoppedStep
{
    rvec3 step;
    rvec4 reaction; // w: 1 where the vertex sticks
};

/// `free`: the step that f alone asks for, relaxed. The surface asks that n . (d + step) >= least, n =
/// plane.xyz, least = plane.w; drag.xyz: the way of the surface, m; drag.w: Coulomb's coefficient.
///   sticks: step = n (least - n . drag) + drag - d, reaction r = H step - f, if |r_t| <= mu r_n;
///   slips:  step = free + H^-1 q r_n, q = n + mu r_t / |r_t|, r_n from n . (d + step) = least.
StoppedStep stopped_step(Block h, rvec3 f, rvec3 d, rvec3 free, rvec4 plane, rvec4 drag)
{
    StoppedStep answer;
    answer.step = free;
    answer.reaction = rvec4(real(0));
    rvec3 n = rvec3(plane);
    real lack = plane.w - dot(n, d + free);
    if (lack > real(0) && dot(n, n) > real(0))
    {
        rvec3 stay = (n * (plane.w - dot(n, rvec3(drag))) + rvec3(drag)) - d;
        rvec3 held = product_of(h, stay) - f;
        real normal = dot(n, held);
        rvec3 along = held - n * normal;
        real size = length(along);
        bool sticks = size <= drag.w * normal;
        rvec3 q = n + along * (size > real(0) ? drag.w / size : real(0));
        rvec3 way = solution_of(h, q);
        rvec3 way_out = solution_of(h, n);
        real gives = dot(n, way);
        bool jams = gives <= real(0.25) * dot(n, way_out);
        q = jams ? n : q;
        way = jams ? way_out : way;
        real force = lack / dot(n, way);
        answer.step = sticks ? stay : free + way * force;
        answer.reaction = sticks ? rvec4(held, real(1)) : rvec4(q * force, real(0));
    }
    return answer;
}

#endif
