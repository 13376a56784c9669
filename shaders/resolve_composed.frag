#version 450 core
#include "lib/resolve.glsl"

layout(binding = 0) uniform sampler2D opaqueColor;
layout(binding = 2) uniform sampler2D transmittance;
layout(binding = 3) uniform sampler2D emission;

// B prod(1 - a_i) + sum a_i c_i
vec3 sampleColor(ivec2 position) {
    vec3 background = texelFetch(opaqueColor, position, 0).rgb;
    return background * texelFetch(transmittance, position, 0).r + texelFetch(emission, position, 0).rgb;
}

void main() { resolvePixel(); }
