#version 450 core
#include "lib/shading.glsl"

layout(location = 0) out vec4 transmittance;
layout(location = 1) out vec4 emission;

void main() {
    transmittance = vec4(1.0 - colorOpacity.a);
    emission = vec4(colorOpacity.a * shadedColor(), 0.0);
}
