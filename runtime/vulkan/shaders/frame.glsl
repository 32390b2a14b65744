// What all shaders of a picture share. Frame and Push have the layout of the structs in draw_objects.hpp.

layout(std430, set = 0, binding = 0) readonly buffer FrameBlock
{
    mat4 view[2];    // world to clip: of the camera, of the light
    vec4 eye;        // m
    vec4 to_light;   // unit
    vec4 up;         // unit
    vec4 focus;      // centre of what matters, m; w = its radius, m
    vec4 sky_top;    // linear rgb; w = height of the picture, pixels
    vec4 sky_bottom; // linear rgb
} frame;

layout(push_constant) uniform PushBlock
{
    vec4 front; // linear rgb; w = width of a ground cell or radius of a strand, m
    vec4 back;  // linear rgb
    uint pass;  // 0: camera, 1: light
    uint finish;
} push;

const uint kCloth = 0;
const uint kSolid = 1;
const uint kGround = 2;
const uint kStrand = 3;

vec3 background(float y)
{
    return mix(frame.sky_top.rgb, frame.sky_bottom.rgb, clamp(y / frame.sky_top.w, 0.0, 1.0));
}
