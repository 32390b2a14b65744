// alpha / h^2 of XPBD (Macklin, Mueller, Chentanez 2016, eq. 4), kept finite: beyond the bound a constraint
// moves nothing that float can hold, and infinity times a multiplier of zero would be no number.
#ifndef TAUT_SHARED_COMPLIANCE_GLSL
#define TAUT_SHARED_COMPLIANCE_GLSL

real scaled_compliance(real compliance, real inverse_substep)
{
    return min(compliance * (inverse_substep * inverse_substep), REAL(1e30));
}

#endif
