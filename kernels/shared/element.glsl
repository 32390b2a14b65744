// What a kernel of a method asks of the element that it is compiled for.
//
// A kernel with the line `//! each element of METHOD` is compiled once for every kernels/elements/<stem>.glsl
// whose line `//! methods` names METHOD. The kernel compiler defines ELEMENT_STEM and ELEMENT_CORNERS (from
// the file's line `//! corners`); the kernel includes TAUT_ELEMENT, which is that file. Of an element `hinge`
// it uses
//   hinge_record                  the record in the buffer of constraints: corners, then reals
//   hinge_v0(record) ...          vertex of each corner
//   hinge_row(record, e1, ...)    its constraint C, by the differences of its corners from corner 0, m
// under the names OF_ELEMENT(record), OF_ELEMENT(v0)(record), OF_ELEMENT(row)(record, ELEMENT_EDGES). A line
// `//! with ABILITY` of the element's file is the macro ELEMENT_WITH_ABILITY, in capitals.
// An element may give its energy and its slopes instead of C: shared/element_form.glsl; C then follows
// (shared/element_row.glsl).
// A kernel over several kinds at once includes their files by name and has none of these macros.
#ifndef TAUT_SHARED_ELEMENT_GLSL
#define TAUT_SHARED_ELEMENT_GLSL

#define ELEMENT_JOIN_WORDS(stem, name) stem##_##name
#define ELEMENT_JOIN(stem, name) ELEMENT_JOIN_WORDS(stem, name)
#define OF_ELEMENT(name) ELEMENT_JOIN(ELEMENT_STEM, name)

/// C = 0 at rest, for the energy C^2 / (2 compliance), and its gradients by the corners. Elements of fewer
/// corners leave the last members unset.
struct ElementRow
{
    real value;             // C
    real compliance;        // of C, unit of C squared over J; 0 = rigid
    real divisor;           // the gradients of C are g0 .. g3 over this
    rbool shaped;           // C has a gradient here; otherwise the rest means nothing
    rbool counted;          // where it has none, that is worth an event
    rvec3 g0, g1, g2, g3;
    real s0, s1, s2, s3;    // squared lengths of the gradients of C
};

/// A 3 x 3 block by its rows.
struct ElementBlock
{
    rvec3 x, y, z;
};

/// Slopes and curvature of an element's energy (shared/element_form.glsl).
struct ElementForm
{
    rbool shaped;         // the element has a shape here; otherwise slopes and curvature are zero
    rbool counted;        // where it has none, that is worth an event
    rvec3 f0, f1, f2, f3; // slopes by the corners, N
#ifdef ELEMENT_WITH_ENERGY
    ElementBlock b11, b12, b13, b22, b23, b33; // curvature between the corners 1 and up, N/m
#else
    rvec3 n0, n1, n2, n3; // gradients of C
    real stiffness;       // 1 / compliance
#endif
};

/// sum w_i |grad_i C|^2 over two, three and four corners; w_i: inverse masses, 1/kg. Of four corners no less
/// than the largest w_i sum |grad_i C|^2 / 64: where the corners that move have hardly a part in C (a hinge
/// whose wings are held, by the end that is in line with both), dividing by their part alone would send them
/// far off. With that floor none goes further than 8 |C| / sqrt(sum |grad_i C|^2).
INLINE real row_weight(ElementRow row, real w0, real w1)
{
    real weight = w0 * row.s0 + w1 * row.s1;
    return weight;
}
INLINE real row_weight(ElementRow row, real w0, real w1, real w2)
{
    real weight = row_weight(row, w0, w1) + w2 * row.s2;
    return weight;
}
INLINE real row_weight(ElementRow row, real w0, real w1, real w2, real w3)
{
    real weight = row_weight(row, w0, w1, w2) + w3 * row.s3;
    real lightest = max(max(w0, w1), max(w2, w3));
    real slopes = (row.s0 + row.s1) + (row.s2 + row.s3);
    return max(weight, lightest * slopes / real(64));
}

// The arguments that stand for all corners: a kernel calls their positions x0 .. x3, with the inverse mass in
// w, and their differences from corner 0 e1 .. e3. ELEMENT_MASS is above 0 where a corner can move.
#ifdef ELEMENT_STEM
#if ELEMENT_CORNERS == 2
#define ELEMENT_EDGES e1
#define ELEMENT_EDGE_PARAMETERS rvec3 e1
#define ELEMENT_MASSES x0.w, x1.w
#define ELEMENT_MASS (x0.w + x1.w)
#elif ELEMENT_CORNERS == 3
#define ELEMENT_EDGES e1, e2
#define ELEMENT_EDGE_PARAMETERS rvec3 e1, rvec3 e2
#define ELEMENT_MASSES x0.w, x1.w, x2.w
#define ELEMENT_MASS (x0.w + x1.w + x2.w)
#else
#define ELEMENT_EDGES e1, e2, e3
#define ELEMENT_EDGE_PARAMETERS rvec3 e1, rvec3 e2, rvec3 e3
#define ELEMENT_MASSES x0.w, x1.w, x2.w, x3.w
#define ELEMENT_MASS (x0.w + x1.w + x2.w + x3.w)
#endif

/// The slope at corner 0 of an element that gives those of the others: moving all alike changes nothing.
INLINE rvec3 slope_of_first(ElementForm form)
{
#if ELEMENT_CORNERS == 2
    return -form.f1;
#elif ELEMENT_CORNERS == 3
    return -(form.f1 + form.f2);
#else
    return -((form.f1 + form.f2) + form.f3);
#endif
}
#endif

#endif
