#version 450 core
#include "lib/behind.glsl"
#include "lib/resolve.glsl"

layout(binding = 2) uniform sampler2D composed;

vec4 sampleColor(ivec2 position) { return inFrontOfBehind(texelFetch(composed, position, 0), position); }

void main() { resolvePixel(); }
