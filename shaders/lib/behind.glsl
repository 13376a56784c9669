#include "lib/frame.glsl"

// What is behind the semi-transparent surfaces: linear color, and in alpha how much of it is there.
#ifdef OPAQUE_BEHIND
layout(binding = 0) uniform sampler2D opaqueColor;

vec4 behind(ivec2 position) { return texelFetch(opaqueColor, position, 0); }
#else
vec4 behind(ivec2 position) { return background; }
#endif

// The sum of emission, and in alpha the product of (1 - opacity), in front of what is behind.
vec4 inFrontOfBehind(vec4 composed, ivec2 position) {
    vec4 color = behind(position);
    return vec4(color.rgb * composed.a + composed.rgb, 1.0 - composed.a * (1.0 - color.a));
}
