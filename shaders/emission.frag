#version 450 core
#include "lib/shading.glsl"

layout(location = 0) out vec4 emission;

void main() { emission = vec4(colorOpacity.a * shadedColor(), 0.0); }
