#version 450
// Two-sided, lit by a sky, the light bounced off the ground and one key light with soft shadows.
#include "frame.glsl"

layout(set = 0, binding = 1) uniform sampler2DShadow shadow_map;

layout(location = 0) in vec3 world;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 colour;

const vec3 kKey = vec3(0.68, 0.645, 0.59);
const vec3 kSky = vec3(0.28, 0.30, 0.335);
const vec3 kBounce = vec3(0.14, 0.13, 0.12);
const float kFill = 0.15;    // from the viewer: folds keep their shape where the key light does not reach
const int kTaps = 3;         // 7 x 7 samples
const float kSpread = 2.0;   // texels between them

/// Share of the key light that arrives, 0..1.
float visible(vec3 point)
{
    vec3 at = (frame.view[1] * vec4(point, 1.0)).xyz;
    at.z = min(at.z, 1.0); // beyond the map nothing is in the way
    const vec2 centre = at.xy * 0.5 + 0.5;
    const vec2 texel = kSpread / vec2(textureSize(shadow_map, 0));
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -kTaps; y <= kTaps; ++y)
        for (int x = -kTaps; x <= kTaps; ++x)
        {
            const float weight = 1.0 - 0.07 * float(x * x + y * y) / 2.0;
            sum += weight * texture(shadow_map, vec3(centre + vec2(x, y) * texel, at.z));
            weights += weight;
        }
    return sum / weights;
}

/// 1 in the dark cells of a checker, smooth over the width of a pixel, 0.5 where cells are too small to see.
float checker(vec2 at)
{
    const vec2 width = max(fwidth(at), 1e-6);
    const vec2 edge = clamp((abs(fract(at) - 0.5) - 0.25) / width + 0.5, 0.0, 1.0);
    const float cells = edge.x + edge.y - 2.0 * edge.x * edge.y;
    return mix(cells, 0.5, smoothstep(0.15, 0.45, max(width.x, width.y)));
}

vec3 ground_albedo(vec3 n)
{
    const vec3 s = normalize(cross(n, abs(n.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 0.0, 1.0)));
    const vec2 at = vec2(dot(world, s), dot(world, cross(n, s))) / (2.0 * push.front.w);
    return mix(push.front.rgb, push.back.rgb, checker(at));
}

void main()
{
    const bool flips = push.finish == kCloth && !gl_FrontFacing;
    const vec3 n = normalize(flips ? -normal : normal);
    const vec3 viewer = normalize(frame.eye.xyz - world);
    vec3 albedo = push.finish == kCloth && !gl_FrontFacing ? push.back.rgb : push.front.rgb;
    if (push.finish == kGround)
        albedo = ground_albedo(n);

    const float wrap = push.finish == kCloth ? 0.15 : 0.0; // fibres scatter light around the edge
    const float facing = dot(n, frame.to_light.xyz);
    const float key = max((facing + wrap) / (1.0 + wrap), 0.0) * visible(world + n * (0.006 * frame.focus.w));
    const float height = dot(n, frame.up.xyz) * 0.5 + 0.5;
    vec3 light = kKey * key + mix(kBounce, kSky, height);
    light += kFill * abs(dot(n, viewer)) * (push.finish == kGround ? 0.5 : 1.0);

    const float edge = pow(1.0 - clamp(abs(dot(n, viewer)), 0.0, 1.0), 3.0);
    vec3 shine = vec3(0.0);
    if (push.finish == kCloth || push.finish == kStrand)
        shine = edge * 0.10 * (albedo + 0.15) * (0.4 + key);
    else if (push.finish == kSolid)
        shine = vec3(0.10 * key * pow(max(dot(n, normalize(viewer + frame.to_light.xyz)), 0.0), 32.0));
    colour = vec4(albedo * light + shine, 1.0);

    if (push.finish == kGround)
    {
        const float distance_seen = length(world - frame.focus.xyz) / frame.focus.w;
        colour.rgb = mix(colour.rgb, background(gl_FragCoord.y), smoothstep(1.2, 4.5, distance_seen));
    }
}
