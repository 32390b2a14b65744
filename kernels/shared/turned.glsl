// Vectors in the frame of a collider that may turn, and back. After shared/contact.glsl.
#ifndef TAUT_SHARED_TURNED_GLSL
#define TAUT_SHARED_TURNED_GLSL

/// The parts of `v` along the axes of the record `c`.
#define INTO_FRAME(c, v)                                                              \
    rvec3(dot(rvec3((c).x_x, (c).x_y, (c).x_z), v), dot(rvec3((c).y_x, (c).y_y, (c).y_z), v), \
          dot(rvec3((c).z_x, (c).z_y, (c).z_z), v))
#define OUT_OF_FRAME(c, v)                                                                      \
    ((rvec3((c).x_x, (c).x_y, (c).x_z) * (v).x + rvec3((c).y_x, (c).y_y, (c).y_z) * (v).y) + \
     rvec3((c).z_x, (c).z_y, (c).z_z) * (v).z)
#define CENTRE_OF(c) rvec3((c).centre_x, (c).centre_y, (c).centre_z)

/// The vertex was followed as seen from the collider, and a push out of it goes across the surface.
INLINE rvec3 slide_of_turned(Contact met, rvec3 d)
{
    return along_surface(met.normal, met.motion);
}

INLINE rvec3 way_of_turned(Contact met, rvec3 d) { return met.motion; }

#endif
