#version 450 core
#include "lib/resolve.glsl"

layout(binding = 0) uniform sampler2D opaqueColor;
layout(binding = 2) uniform sampler2D transmittance;
layout(binding = 3) uniform sampler2D emission;

// B prod(1 - a_i) + sum a_i c_i, alpha 1 - (1 - A) prod(1 - a_i)
vec4 sampleColor(ivec2 position) {
    vec4 background = texelFetch(opaqueColor, position, 0);
    float transmitted = texelFetch(transmittance, position, 0).r;
    vec3 color = background.rgb * transmitted + texelFetch(emission, position, 0).rgb;
    return vec4(color, 1.0 - (1.0 - background.a) * transmitted);
}

void main() { resolvePixel(); }
