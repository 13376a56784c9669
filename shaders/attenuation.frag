#version 450 core
#include "lib/draw.glsl"

layout(location = 0) out vec4 transmittance;

void main() { transmittance = vec4(1.0 - colorOpacity.a); }
