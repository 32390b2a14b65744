// The cross product, written out: drivers may contract their own, and executors then differ in the last bit.
// For where sums go over to other passes or to bits that are compared; elsewhere cross() will do.
#ifndef TAUT_SHARED_CROSS_GLSL
#define TAUT_SHARED_CROSS_GLSL

rvec3 exact_cross(rvec3 a, rvec3 b)
{
    PRECISE rvec3 c = rvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return c;
}

#endif
