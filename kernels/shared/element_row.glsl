// The constraint of an element that gives its energy instead: C = sqrt(2 E) of compliance 1, so that C^2 / 2
// is the energy, with gradients slope_i / C. Included after TAUT_ELEMENT; nothing for elements with a C of
// their own.
//
// Based on: Macklin, Mueller. A Constraint-based Formulation of Stable Neo-Hookean Materials. MIG 2021, 2
//   (energies as constraints by their roots).
// Departures: none. At rest C has no gradient, and nothing is to be done.
#ifndef TAUT_SHARED_ELEMENT_ROW_GLSL
#define TAUT_SHARED_ELEMENT_ROW_GLSL

#ifdef ELEMENT_WITH_ENERGY
INLINE ElementRow OF_ELEMENT(row)(OF_ELEMENT(record) c, ELEMENT_EDGE_PARAMETERS)
{
    ElementForm form = OF_ELEMENT(form)(c, ELEMENT_EDGES);
    real twice = real(2) * OF_ELEMENT(energy)(c, ELEMENT_EDGES);
    ElementRow row;
    row.shaped = form.shaped && twice > REAL(1e-30);
    row.counted = form.counted && !form.shaped;
    real square = SELECT(row.shaped, twice, real(1));
    row.value = SELECT(row.shaped, sqrt(square), real(0));
    row.compliance = real(1);
    row.divisor = sqrt(square);
    row.g0 = slope_of_first(form);
    row.g1 = form.f1;
    row.s0 = dot(row.g0, row.g0) / square;
    row.s1 = dot(row.g1, row.g1) / square;
#if ELEMENT_CORNERS > 2
    row.g2 = form.f2;
    row.s2 = dot(row.g2, row.g2) / square;
#endif
#if ELEMENT_CORNERS > 3
    row.g3 = form.f3;
    row.s3 = dot(row.g3, row.g3) / square;
#endif
    return row;
}
#endif

#endif
