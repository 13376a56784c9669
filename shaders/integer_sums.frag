#version 450 core
#include "lib/emission.glsl"
#include "lib/emission_limit.glsl"
#include "lib/integer_sums.glsl"

layout(early_fragment_tests) in;
layout(binding = 0, r32ui) uniform uimage2DArray sums;

// What an atomic addition returns tells whether this one passed 2^32: exactly one does, in any order.
void add(int channel, float value) {
    uint units = uint(min(value, kPerCarry - 1.0) * kUnitsPerOne + 0.5);
    if (units == 0u) return;
    ivec2 position = ivec2(gl_FragCoord.xy);
    uint before = imageAtomicAdd(sums, ivec3(position, channel), units);
    if (before > 0xffffffffu - units) imageAtomicAdd(sums, ivec3(position, kCarryLayer), 1u << (8 * channel));
}

void main() {
    vec4 fragment = emissionAndOpacity();
    add(kLogLayer, min(-log2(1.0 - fragment.a), kLargestLog));
    if (!emits()) return;
    for (int channel = 0; channel < 3; ++channel) add(channel, fragment[channel]);
}
