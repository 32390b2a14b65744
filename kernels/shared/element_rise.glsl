// By how much the energy of an element differs between two shapes of it. Included after element_form.glsl.
// Far apart the two are subtracted; close together that would leave rounding alone, and the mean of the
// slopes at both ends takes the place of the difference: C(e + w) - C(e) = (grad C(e) + grad C(e + w)) / 2 .
// w.
//
// Based on: the trapezoidal rule, whose error is a twelfth of (|w| / |e|)^2 of the whole.
// Departures: none.
#ifndef TAUT_SHARED_ELEMENT_RISE_GLSL
#define TAUT_SHARED_ELEMENT_RISE_GLSL

/// (|w| / |e|)^2 below which rounding is more than the rule's error.
real close_together()
{
#if TAUT_REAL_DOUBLE
    return REAL(1e-10);
#else
    return REAL(1e-4);
#endif
}

#if ELEMENT_CORNERS == 2
#define ELEMENT_WAYS rvec3 w1
#define ELEMENT_MOVED e1 + w1
#define ELEMENT_ALONG(g) dot(g##1, w1)
#define ELEMENT_SIZE(e) dot(e##1, e##1)
#elif ELEMENT_CORNERS == 3
#define ELEMENT_WAYS rvec3 w1, rvec3 w2
#define ELEMENT_MOVED e1 + w1, e2 + w2
#define ELEMENT_ALONG(g) (dot(g##1, w1) + dot(g##2, w2))
#define ELEMENT_SIZE(e) (dot(e##1, e##1) + dot(e##2, e##2))
#else
#define ELEMENT_WAYS rvec3 w1, rvec3 w2, rvec3 w3
#define ELEMENT_MOVED e1 + w1, e2 + w2, e3 + w3
#define ELEMENT_ALONG(g) ((dot(g##1, w1) + dot(g##2, w2)) + dot(g##3, w3))
#define ELEMENT_SIZE(e) ((dot(e##1, e##1) + dot(e##2, e##2)) + dot(e##3, e##3))
#endif

/// E(e + w) - E(e), times the square of `lift`; 0 where the element has no shape in one of the two.
INLINE real element_rise(OF_ELEMENT(record) c, ELEMENT_EDGE_PARAMETERS, ELEMENT_WAYS, real lift)
{
    bool close = ELEMENT_SIZE(w) < close_together() * ELEMENT_SIZE(e);
#ifdef ELEMENT_WITH_ENERGY
    ElementForm now = OF_ELEMENT(form)(c, ELEMENT_EDGES);
    ElementForm then = OF_ELEMENT(form)(c, ELEMENT_MOVED);
    real change = real(0.5) * (ELEMENT_ALONG(now.f) + ELEMENT_ALONG(then.f));
    if (!close)
        change = OF_ELEMENT(energy)(c, ELEMENT_MOVED) - OF_ELEMENT(energy)(c, ELEMENT_EDGES);
    real rise = (change * lift) * lift;
#else
    ElementRow now = OF_ELEMENT(row)(c, ELEMENT_EDGES);
    ElementRow then = OF_ELEMENT(row)(c, ELEMENT_MOVED);
    real change = then.value - now.value;
    if (close && now.shaped && then.shaped)
        change = real(0.5) * (ELEMENT_ALONG(now.g) / now.divisor + ELEMENT_ALONG(then.g) / then.divisor);
    real both = real(2) * now.value + change;
    real rise = (real(0.5) / now.compliance) * ((change * lift) * (both * lift));
#endif
    return now.shaped && then.shaped ? rise : real(0);
}

#endif
