#version 450 core
#include "lib/shading.glsl"

layout(location = 0) out vec4 opaqueColor;

void main() { opaqueColor = vec4(shadedColor(), 1.0); }
