#version 450 core
#include "lib/emission.glsl"
#include "lib/emission_limit.glsl"

layout(location = 0) out vec4 composed;

// Blending adds the light and dims the transmittance in alpha by the opacity.
void main() {
    composed = emissionAndOpacity();
    if (!emits()) composed.rgb = vec3(0.0);
}
