// Blocks of an element's curvature, pair of corners by pair of corners, in kernels that are no lanes. Included
// after element_form.glsl.
//
// Based on: shared/element_form.glsl.
// Departures: none.
#ifndef TAUT_SHARED_ELEMENT_BLOCK_GLSL
#define TAUT_SHARED_ELEMENT_BLOCK_GLSL

/// The slope at a corner. By ifs: of doubles Mesa 26's OpenGL gets a chain of ?: wrong.
INLINE rvec3 slope_at(ElementForm form, uint corner)
{
#ifdef ELEMENT_WITH_ENERGY
    rvec3 own = slope_of_first(form);
#else
    rvec3 own = form.f0;
#endif
    if (corner == 1u)
        own = form.f1;
#if ELEMENT_CORNERS > 2
    if (corner == 2u)
        own = form.f2;
#endif
#if ELEMENT_CORNERS > 3
    if (corner == 3u)
        own = form.f3;
#endif
    return own;
}

#ifdef ELEMENT_WITH_ENERGY

INLINE ElementBlock turned_block(ElementBlock b)
{
    ElementBlock turned;
    turned.x = rvec3(b.x.x, b.y.x, b.z.x);
    turned.y = rvec3(b.x.y, b.y.y, b.z.y);
    turned.z = rvec3(b.x.z, b.y.z, b.z.z);
    return turned;
}

/// Of two of the corners 1 and up.
INLINE ElementBlock edge_block(ElementForm form, uint i, uint j)
{
    ElementBlock block = form.b11;
#if ELEMENT_CORNERS > 2
    if (i + j == 3u && i * j == 2u)
        block = form.b12;
    if (i == 2u && j == 2u)
        block = form.b22;
#endif
#if ELEMENT_CORNERS > 3
    if (i + j == 4u && i * j == 3u)
        block = form.b13;
    if (i + j == 5u)
        block = form.b23;
    if (i == 3u && j == 3u)
        block = form.b33;
#endif
    if (i > j)
        block = turned_block(block);
    return block;
}

/// Of any two corners: those of corner 0 make every row and column of blocks add up to nothing.
INLINE ElementBlock element_block(ElementForm form, uint i, uint j)
{
    ElementBlock sum;
    sum.x = rvec3(real(0));
    sum.y = rvec3(real(0));
    sum.z = rvec3(real(0));
    bool minus = (i == 0u) != (j == 0u);
    for (uint a = 1u; a < uint(ELEMENT_CORNERS); ++a)
        for (uint b = 1u; b < uint(ELEMENT_CORNERS); ++b)
            if ((i == 0u || i == a) && (j == 0u || j == b))
            {
                ElementBlock block = edge_block(form, a, b);
                sum.x += minus ? -block.x : block.x;
                sum.y += minus ? -block.y : block.y;
                sum.z += minus ? -block.z : block.z;
            }
    return sum;
}

INLINE rvec3 block_times(ElementBlock block, rvec3 v)
{
    return rvec3(dot(block.x, v), dot(block.y, v), dot(block.z, v));
}

#else

/// The gradient of C at a corner.
INLINE rvec3 gradient_at(ElementForm form, uint corner)
{
    rvec3 own = form.n0;
    if (corner == 1u)
        own = form.n1;
#if ELEMENT_CORNERS > 2
    if (corner == 2u)
        own = form.n2;
#endif
#if ELEMENT_CORNERS > 3
    if (corner == 3u)
        own = form.n3;
#endif
    return own;
}

#endif

#endif
