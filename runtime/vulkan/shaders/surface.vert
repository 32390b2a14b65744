#version 450
// Positions come as vertex input straight from the simulation's buffer. The normal is the sum over the
// triangles around a vertex, weighted by area, and reads the same buffer.
#include "frame.glsl"

layout(location = 0) in vec4 position; // w is the simulation's own

layout(std430, set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(std430, set = 0, binding = 3) readonly buffer First { uint first[]; };    // of each vertex in around[]
layout(std430, set = 0, binding = 4) readonly buffer Around { uvec2 around[]; }; // the two other corners

layout(location = 0) out vec3 world;
layout(location = 1) out vec3 normal;

void main()
{
    const vec3 here = position.xyz;
    vec3 sum = vec3(0.0);
    for (uint k = first[gl_VertexIndex]; k < first[gl_VertexIndex + 1]; ++k)
        sum += cross(positions[around[k].x].xyz - here, positions[around[k].y].xyz - here);
    const float size = length(sum);
    world = here;
    normal = size > 0.0 ? sum / size : frame.up.xyz;
    gl_Position = frame.view[push.pass] * vec4(here, 1.0);
}
