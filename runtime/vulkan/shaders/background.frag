#version 450
#include "frame.glsl"

layout(location = 0) out vec4 colour;

void main() { colour = vec4(background(gl_FragCoord.y), 1.0); }
