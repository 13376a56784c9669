#version 450 core
#include "lib/emission.glsl"
#include "lib/peel.glsl"

layout(location = 0) out vec4 layerColor;

void main() {
    if (isPeeled()) discard;
    layerColor = emissionAndOpacity();
}
