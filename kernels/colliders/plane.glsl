// Half-space: its normal and offset, which moves linearly over the time step.
//
// Based on: the distance of a point from a plane.
// Departures: none.
//! collider once

#define plane_record PlaneCollider

INLINE Contact plane_contact(PlaneCollider c, real substep, real substeps, rvec3 x, rvec3 d, real gap_kept)
{
    Contact met;
    rvec3 n = rvec3(c.normal_x, c.normal_y, c.normal_z);
    real part = (c.offset_end - c.offset_start) / substeps;
    real surface = c.offset_start + part * substep;
    met.normal = n;
    met.before = (dot(n, x) - surface) - gap_kept;
    met.gap = met.before + (dot(n, d) - part);
    met.motion = rvec3(c.shift_x, c.shift_y, c.shift_z) / substeps;
    met.friction = c.friction;
    return met;
}

INLINE rvec3 plane_slide(Contact met, rvec3 d)
{
    return along_surface(met.normal, d) - along_surface(met.normal, met.motion);
}

INLINE rvec3 plane_way(Contact met, rvec3 d) { return d - met.motion; }
