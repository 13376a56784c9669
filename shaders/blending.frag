#version 450 core
#include "lib/emission.glsl"

layout(location = 0) out vec4 composed;

void main() { composed = emissionAndOpacity(); }
