#version 450 core
#include "lib/resolve.glsl"

layout(binding = 0) uniform sampler2D opaqueColor;

vec4 sampleColor(ivec2 position) { return texelFetch(opaqueColor, position, 0); }

void main() { resolvePixel(); }
