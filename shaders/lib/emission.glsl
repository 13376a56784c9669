#include "lib/opacity.glsl"
#include "lib/shading.glsl"

// What a semi-transparent fragment brings: the light that it emits, and in alpha its opacity.
vec4 emissionAndOpacity() {
    float opacity = fragmentOpacity();
    return vec4(opacity * shadedColor(), opacity);
}
