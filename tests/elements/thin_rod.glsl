// Bending of a thin rod at three vertices in a row: E = k/2 |x2 - 2 x1 + x0|^2. Straight and even is at rest.
// It gives its energy, not a constraint; its curvature is constant, and whole.
//
// Based on: the second difference of a curve's places, as in Bergou et al. Discrete Elastic Rods. SIGGRAPH
//   2008, for small turns.
// Departures: none.
//! corners 3
//! methods xpbd pbd mass_spring implicit_euler vbd
//! with energy

LAYOUT_STRUCT(ThinRod)
{
    uint a;
    uint b; // the middle
    uint c;
    real stiffness; // N/m
};

#define thin_rod_record ThinRod
#define thin_rod_v0(e) (e).a
#define thin_rod_v1(e) (e).b
#define thin_rod_v2(e) (e).c

INLINE real thin_rod_energy(ThinRod c, rvec3 e1, rvec3 e2)
{
    rvec3 bow = e2 - e1 * real(2);
    return real(0.5) * (c.stiffness * dot(bow, bow));
}

/// A multiple of the identity.
INLINE ElementBlock thin_rod_even(real k)
{
    ElementBlock block;
    block.x = rvec3(k, real(0), real(0));
    block.y = rvec3(real(0), k, real(0));
    block.z = rvec3(real(0), real(0), k);
    return block;
}

INLINE ElementForm thin_rod_form(ThinRod c, rvec3 e1, rvec3 e2)
{
    ElementForm form;
    rvec3 bow = e2 - e1 * real(2);
    form.shaped = c.stiffness > real(0);
    form.counted = !form.shaped;
    form.f2 = bow * c.stiffness;
    form.f1 = form.f2 * real(-2);
    form.b11 = thin_rod_even(real(4) * c.stiffness);
    form.b12 = thin_rod_even(real(-2) * c.stiffness);
    form.b22 = thin_rod_even(c.stiffness);
    return form;
}
