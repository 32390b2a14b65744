// What the air does to each triangle during a substep: the impulse that each of its corners gets. One
// invocation per triangle. With v the mean velocity of the corners against the air, v_n and v_t its parts
// along and across the normal, A the area and rho the air's density,
//
//   f = -rho/2 A |v| (drag v_n + friction_drag v_t).
//
// Based on: Wejchert, Haumann. Animation Aerodynamics. SIGGRAPH 1991, section 3 (drag of a flat element
//   by the normal part of the relative wind, skin friction by the tangential one).
// Departures: the impulse over a substep is m v b / (1 + b) with b = h rho/2 A |v| c / m, the exact solution
//   of m dv/dt = -(rho/2 A c) |v| v, so that no gust turns a relative velocity round; m is at most three
//   times the least share of a corner's mass, so that all triangles at a vertex together do not either.
// Bytes per element: 28 triangle + 96 read + 16 written (float).
#include "shared/portable.glsl"
#include "shared/layouts.h"

PARAMS
{
    uint count;
    uint substep;
    uint substeps;
};

READ(0, WindTriangle, triangle);
READ(1, rvec4, position);
READ(2, rvec4, velocity); // m/s
READ_ONE(3, StepValues, step_values);
READ_ONE(4, WindValues, wind);
WRITE(5, rvec4, impulse); // N s, on each corner

/// The share of a velocity that drag takes away.
real taken(real b)
{
    real most = min(b, REAL(1e30));
    return most / (real(1) + most);
}

KERNEL(count)
{
    WindTriangle c = triangle[i];
    real time = (real(substep) + real(0.5)) / real(substeps);
    rvec3 start = rvec3(wind[0].start_x, wind[0].start_y, wind[0].start_z);
    rvec3 end = rvec3(wind[0].end_x, wind[0].end_y, wind[0].end_z);
    rvec3 air = start + (end - start) * time;
    rvec3 sum = (rvec3(velocity[c.a]) + rvec3(velocity[c.b])) + rvec3(velocity[c.c]);
    rvec3 v = sum / real(3) - air;
    rvec3 x = rvec3(position[c.a]);
    rvec3 normal = cross(rvec3(position[c.b]) - x, rvec3(position[c.c]) - x);
    real size = length(normal); // twice the area
    rvec3 n = size > real(0) ? normal / size : rvec3(real(0));
    real pressing = step_values[0].substep * wind[0].density * real(0.25) * size * length(v) / c.mass;
    rvec3 along = n * dot(n, v);
    rvec3 slowed = along * taken(pressing * c.drag) + (v - along) * taken(pressing * c.friction_drag);
    impulse[i] = rvec4(slowed * (-c.mass / real(3)), real(0));
}
