// What methods of forces ask of the element that a kernel is compiled for: how its energy E slopes and curves
// with its corners. Included after TAUT_ELEMENT.
//   slope_i = dE / dx_i, N; the force is its negative.  curvature_ij = d^2 E / dx_i dx_j, or what of it keeps
//   the whole positive semidefinite, N/m.
// From the constraint C of the file (shared/element.glsl), E = C^2 / (2 a), with k = 1 / a, n_i = grad_i C:
//   slope_i = k C n_i,  curvature_ij = k n_i n_j^T.
// An element whose file has the line `//! with energy` says both by itself, by the differences of its
// corners:
//   hinge_energy(record, e1, ...)  E, J
//   hinge_form(record, e1, ...)    slopes f1 .. and curvature b11 .. of the corners 1 and up
// and corner 0 follows, since moving all corners alike changes nothing. So does C (shared/element_row.glsl).
//
// Based on: Nocedal, Wright. Numerical Optimization, 2nd ed. 2006, 10.3 (Gauss-Newton): C times the curvature
//   of C is left out.
// Departures: none.
#ifndef TAUT_SHARED_ELEMENT_FORM_GLSL
#define TAUT_SHARED_ELEMENT_FORM_GLSL

#ifdef ELEMENT_WITH_ENERGY
#define element_form OF_ELEMENT(form)
#else
/// Where C has no gradient, slopes and curvature are zero: g0 .. must be finite there. A rigid element has no
/// energy; hosts refuse it.
INLINE ElementForm element_form(OF_ELEMENT(record) c, ELEMENT_EDGE_PARAMETERS)
{
    ElementRow row = OF_ELEMENT(row)(c, ELEMENT_EDGES);
    ElementForm form;
    form.shaped = row.shaped;
    form.counted = row.counted;
    real inverse = real(1) / SELECT(row.shaped, row.divisor, real(1));
    form.stiffness = SELECT(row.shaped, real(1) / row.compliance, real(0));
    real tension = row.value * form.stiffness; // k C
    form.n0 = row.g0 * inverse;
    form.n1 = row.g1 * inverse;
    form.f0 = form.n0 * tension;
    form.f1 = form.n1 * tension;
#if ELEMENT_CORNERS > 2
    form.n2 = row.g2 * inverse;
    form.f2 = form.n2 * tension;
#endif
#if ELEMENT_CORNERS > 3
    form.n3 = row.g3 * inverse;
    form.f3 = form.n3 * tension;
#endif
    return form;
}
#endif

#endif
