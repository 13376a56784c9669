#version 450 core
#include "lib/emission.glsl"
#include "lib/fragment_lists.glsl"

layout(early_fragment_tests) in;
layout(binding = 0, r32ui) uniform uimage2D listHeads;

void main() {
    uint index = atomicAdd(nodeCount, 1u);
    if (index >= nodeCapacity) return;
    vec4 fragment = emissionAndOpacity();
    uint next = imageAtomicExchange(listHeads, ivec2(gl_FragCoord.xy), index + 1u);
    nodes[index] = Node(fragment.r, fragment.g, fragment.b, fragment.a, gl_FragCoord.z, next);
}
