#include "lib/frame.glsl"
#include "lib/srgb.glsl"

layout(location = 0) out vec4 linearImage;
layout(location = 1) out vec4 srgbImage;

// Linear color of one sample times its alpha, and alpha; the entry file says how they are composed.
vec4 sampleColor(ivec2 position);

// Averages the samples of a pixel in linear light. Rows are summed before they are added: sums of two
// equal numbers are exact, so a uniform color stays what it is.
void resolvePixel() {
    ivec2 first = ivec2(gl_FragCoord.xy) * supersample;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < supersample; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < supersample; ++x) row += sampleColor(first + ivec2(x, y));
        sum += row;
    }
    vec4 color = sum / float(supersample * supersample);
    linearImage = color;
    // Files hold straight alpha. Dividing by 1 is exact: an opaque background changes nothing.
    vec3 straight = color.a > 0.0 ? color.rgb / color.a : vec3(0.0);
    srgbImage = vec4(srgbFromLinear(straight * exposure), color.a);
}
