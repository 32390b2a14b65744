// Membrane of woven cloth, a triangle of constant strain: E = (C11 u^2 + 2 C12 u v + C22 v^2 + C33 q^2) / 2
// with strains of warp and weft u = |fu| - 1, v = |fv| - 1 and the sine of shear q = fu . fv / (|fu| |fv|),
// where (fu, fv) = (e1, e2) P are the images of a metre of either yarn.
// A yarn shorter than 1e-4 of its length has no direction; then there is no shear.
//
// Based on:
//   Baraff, Witkin. Large Steps in Cloth Simulation. SIGGRAPH 1998, 4.2, 4.3: stretch along both yarns and
//     shear as functions of fu and fv.
//   Bonet, Wood. Nonlinear Continuum Mechanics for Finite Element Analysis. 2nd ed. 2008, 8.4: the slopes.
// Departures: strains are per length, shear is the sine, not fu . fv, and C is the matrix of the moduli times
//   the area, so that the energy does not depend on the mesh.
//   Curvature: Gauss-Newton of the three strains and, of what remains, the turning of pulled yarns alone.
//! corners 3
//! methods xpbd mass_spring implicit_euler vbd
//! with energy

LAYOUT_STRUCT(Membrane)
{
    uint a;
    uint b;
    uint c;
    real p11; // 1/m, P: the inverse of the matrix with both edges in material coordinates as its columns
    real p12;
    real p21;
    real p22;
    real c11; // J, moduli times the area at rest
    real c12;
    real c22;
    real c33;
};

#define membrane_record Membrane
#define membrane_v0(e) (e).a
#define membrane_v1(e) (e).b
#define membrane_v2(e) (e).c

struct MembraneStrain
{
    rvec3 warp_way, weft_way; // directions of the yarns
    real warp_length, weft_length;
    real warp, weft, shear;
    rbool shaped, sheared; // a yarn has a direction; both have
};

/// |f| - 1 without the root's rounding.
INLINE real membrane_stretch(rvec3 f, real len)
{
    real stretch = (dot(f, f) - real(1)) / (len + real(1));
    return stretch;
}

INLINE MembraneStrain membrane_strain(Membrane m, rvec3 e1, rvec3 e2)
{
    MembraneStrain s;
    rvec3 fu = e1 * m.p11 + e2 * m.p21;
    rvec3 fv = e1 * m.p12 + e2 * m.p22;
    real lu = length(fu);
    real lv = length(fv);
    s.warp = membrane_stretch(fu, lu);
    s.weft = membrane_stretch(fv, lv);
    s.warp_length = max(lu, REAL(1e-4));
    s.weft_length = max(lv, REAL(1e-4));
    s.warp_way = fu * (real(1) / s.warp_length);
    s.weft_way = fv * (real(1) / s.weft_length);
    s.shaped = lu > REAL(1e-4) || lv > REAL(1e-4);
    s.sheared = lu > REAL(1e-4) && lv > REAL(1e-4);
    s.shear = SELECT(s.sheared, dot(s.warp_way, s.weft_way), real(0));
    return s;
}

INLINE real membrane_energy(Membrane m, rvec3 e1, rvec3 e2)
{
    MembraneStrain s = membrane_strain(m, e1, e2);
    real warp = m.c11 * s.warp + m.c12 * s.weft;
    real weft = m.c12 * s.warp + m.c22 * s.weft;
    real energy = real(0.5) * ((s.warp * warp + s.weft * weft) + (m.c33 * s.shear) * s.shear);
    return energy;
}

/// a b^T.
INLINE ElementBlock membrane_outer(rvec3 a, rvec3 b)
{
    ElementBlock block;
    block.x = b * a.x;
    block.y = b * a.y;
    block.z = b * a.z;
    return block;
}

/// Between two corners whose gradients in the material's plane are g and h; ku, kv: N m, of turning yarns.
INLINE ElementBlock membrane_block(Membrane m, MembraneStrain s, real gu, real gv, real hu, real hv, rvec3 tg,
                                   rvec3 th, real ku, real kv)
{
    real uu = gu * hu;
    real vv = gv * hv;
    ElementBlock warp = membrane_outer(s.warp_way, s.warp_way * (uu * (m.c11 - ku)) +
                                                       s.weft_way * ((gu * hv) * m.c12));
    ElementBlock weft = membrane_outer(s.weft_way, s.weft_way * (vv * (m.c22 - kv)) +
                                                       s.warp_way * ((gv * hu) * m.c12));
    ElementBlock shear = membrane_outer(tg, th * m.c33);
    real turn = uu * ku + vv * kv;
    ElementBlock block;
    block.x = (warp.x + weft.x) + (shear.x + rvec3(turn, real(0), real(0)));
    block.y = (warp.y + weft.y) + (shear.y + rvec3(real(0), turn, real(0)));
    block.z = (warp.z + weft.z) + (shear.z + rvec3(real(0), real(0), turn));
    return block;
}

INLINE ElementForm membrane_form(Membrane m, rvec3 e1, rvec3 e2)
{
    ElementForm form;
    MembraneStrain s = membrane_strain(m, e1, e2);
    real warp = m.c11 * s.warp + m.c12 * s.weft;
    real weft = m.c12 * s.warp + m.c22 * s.weft;
    // How the shear changes with the image of either yarn.
    real live = SELECT(s.sheared, real(1), real(0));
    rvec3 tu = (s.weft_way - s.warp_way * s.shear) * (live / s.warp_length);
    rvec3 tv = (s.warp_way - s.weft_way * s.shear) * (live / s.weft_length);
    rvec3 t1 = tu * m.p11 + tv * m.p12;
    rvec3 t2 = tu * m.p21 + tv * m.p22;
    real shear = m.c33 * s.shear;
    form.shaped = s.shaped;
    form.counted = !s.shaped;
    form.f1 = (s.warp_way * (warp * m.p11) + s.weft_way * (weft * m.p12)) + t1 * shear;
    form.f2 = (s.warp_way * (warp * m.p21) + s.weft_way * (weft * m.p22)) + t2 * shear;
    real ku = max(warp, real(0)) / s.warp_length;
    real kv = max(weft, real(0)) / s.weft_length;
    form.b11 = membrane_block(m, s, m.p11, m.p12, m.p11, m.p12, t1, t1, ku, kv);
    form.b12 = membrane_block(m, s, m.p11, m.p12, m.p21, m.p22, t1, t2, ku, kv);
    form.b22 = membrane_block(m, s, m.p21, m.p22, m.p21, m.p22, t2, t2, ku, kv);
    return form;
}
