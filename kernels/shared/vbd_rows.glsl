// The rows of vertex block descent and the elements that they list, for the kernels that go over them: `row`,
// `position` and, with hinges or tetrahedra, `corner` are the including kernel's.
#ifndef TAUT_SHARED_VBD_ROWS_GLSL
#define TAUT_SHARED_VBD_ROWS_GLSL

/// The words of a row: vertex, first spring end, first hinge corner, colour end, first tetrahedron.
uint row_word(uint k, uint word)
{
#if VOLUMES || ELASTIC
    return row[5u * k + word];
#else
    return row[4u * k + word];
#endif
}

/// Whether v counts for an element before another of its vertices.
bool leads(uint v, uint other, real inverse_mass)
{
    return v < other || inverse_mass <= real(0);
}

#if HINGES
BendingConstraint hinge_at(uint j)
{
#if ELASTIC
    SolidTetrahedron t = corner[j];
    BendingConstraint c;
    c.edge0 = t.a;
    c.edge1 = t.b;
    c.wing0 = t.c;
    c.wing1 = t.d;
    c.rest_angle = t.b00;
    c.compliance = t.b01;
    return c;
#else
    return corner[j];
#endif
}

/// Whether this vertex is the first corner that moves: it counts for the hinge.
bool counts_for(uint v, BendingConstraint c)
{
    if (v == c.edge0) return true;
    if (position[c.edge0].w > real(0)) return false;
    if (v == c.edge1) return true;
    if (position[c.edge1].w > real(0)) return false;
    return v == c.wing0 || position[c.wing0].w <= real(0);
}
#endif

#endif
