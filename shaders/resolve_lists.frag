#version 450 core
#include "lib/behind.glsl"
#include "lib/list_order.glsl"
#include "lib/resolve.glsl"

layout(binding = 8) uniform usampler2D listHeads;

vec4 sampleColor(ivec2 position) {
    return inFrontOfBehind(composeList(texelFetch(listHeads, position, 0).r, layerLimit), position);
}

void main() { resolvePixel(); }
