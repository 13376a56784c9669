#version 450 core
#include "lib/behind.glsl"
#include "lib/resolve.glsl"

vec4 sampleColor(ivec2 position) { return behind(position); }

void main() { resolvePixel(); }
