// Blocks of an element's curvature, pair of corners by pair of corners, in kernels without lanes.
// Included after element_form.glsl.
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

INLINE ElementBlock sum_of_blocks(ElementBlock a, ElementBlock b)
{
    ElementBlock sum;
    sum.x = a.x + b.x;
    sum.y = a.y + b.y;
    sum.z = a.z + b.z;
    return sum;
}

/// Of all corners 1 and up with one of them. No sum begins with zero: drivers leave that out, and signs of
/// zeros would differ.
INLINE ElementBlock block_of_others(ElementForm form, uint j)
{
    ElementBlock sum = edge_block(form, 1u, j);
#if ELEMENT_CORNERS > 2
    sum = sum_of_blocks(sum, edge_block(form, 2u, j));
#endif
#if ELEMENT_CORNERS > 3
    sum = sum_of_blocks(sum, edge_block(form, 3u, j));
#endif
    return sum;
}

/// Of any two corners: those of corner 0 make every row and column of blocks add up to nothing.
INLINE ElementBlock element_block(ElementForm form, uint i, uint j)
{
    ElementBlock block;
    if (i > 0u && j > 0u)
        block = edge_block(form, i, j);
    else if (i + j > 0u)
    {
        block = block_of_others(form, i + j);
        if (j == 0u)
            block = turned_block(block);
        block.x = -block.x;
        block.y = -block.y;
        block.z = -block.z;
    }
    else
    {
        block = block_of_others(form, 1u);
#if ELEMENT_CORNERS > 2
        block = sum_of_blocks(block, block_of_others(form, 2u));
#endif
#if ELEMENT_CORNERS > 3
        block = sum_of_blocks(block, block_of_others(form, 3u));
#endif
    }
    return block;
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
