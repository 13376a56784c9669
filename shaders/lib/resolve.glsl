#include "lib/frame.glsl"
#include "lib/srgb.glsl"

layout(location = 0) out vec4 linearImage;
layout(location = 1) out vec4 srgbImage;

// Linear color of one sample; the entry file says how it is composed.
vec3 sampleColor(ivec2 position);

// Averages the samples of a pixel in linear light. Rows are summed before they are added: sums of two
// equal numbers are exact, so a uniform color stays what it is.
void resolvePixel() {
    ivec2 first = ivec2(gl_FragCoord.xy) * supersample;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < supersample; ++y) {
        vec3 row = vec3(0.0);
        for (int x = 0; x < supersample; ++x) row += sampleColor(first + ivec2(x, y));
        sum += row;
    }
    vec3 color = sum / float(supersample * supersample);
    linearImage = vec4(color, 1.0);
    srgbImage = vec4(srgbFromLinear(color * exposure), 1.0);
}
