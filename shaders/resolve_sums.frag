#version 450 core
#include "lib/behind.glsl"
#include "lib/integer_sums.glsl"
#include "lib/resolve.glsl"

layout(binding = 7) uniform usampler2DArray sums;

float sumOf(int channel, uint carries, ivec2 position) {
    float units = float(texelFetch(sums, ivec3(position, channel), 0).r);
    return units / kUnitsPerOne + kPerCarry * float((carries >> (8 * channel)) & 0xffu);
}

vec4 sampleColor(ivec2 position) {
    uint carries = texelFetch(sums, ivec3(position, kCarryLayer), 0).r;
    vec3 emission = vec3(sumOf(0, carries, position), sumOf(1, carries, position), sumOf(2, carries, position));
    return inFrontOfBehind(vec4(emission, exp2(-sumOf(kLogLayer, carries, position))), position);
}

void main() { resolvePixel(); }
