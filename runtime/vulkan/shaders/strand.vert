#version 450
// A line as a ribbon that faces the viewer and is shaded like a round strand: six vertices each.
#include "frame.glsl"

layout(std430, set = 0, binding = 2) readonly buffer Positions { vec4 positions[]; };
layout(std430, set = 0, binding = 5) readonly buffer Lines { uvec2 lines[]; };

layout(location = 0) out vec3 world;
layout(location = 1) out vec3 normal;

void main()
{
    const uint corner = uint(gl_VertexIndex) % 6u;
    const uvec2 line = lines[uint(gl_VertexIndex) / 6u];
    const bool at_end = corner == 1u || corner == 2u || corner == 4u;
    const float side = corner == 0u || corner == 1u || corner == 3u ? -1.0 : 1.0;
    const vec3 a = positions[line.x].xyz;
    const vec3 b = positions[line.y].xyz;
    const vec3 along = b - a;
    const vec3 unit = length(along) > 0.0 ? normalize(along) : frame.up.xyz;
    vec3 point = (at_end ? b : a) + (at_end ? unit : -unit) * 0.5 * push.front.w; // closes the joints
    const vec3 viewer = push.pass == 0u ? normalize(frame.eye.xyz - point) : frame.to_light.xyz;
    vec3 across = cross(unit, viewer);
    across = length(across) > 1e-6 ? normalize(across) : vec3(0.0);
    world = point + across * side * push.front.w;
    normal = across * side + viewer * 0.7;
    gl_Position = frame.view[push.pass] * vec4(world, 1.0);
}
