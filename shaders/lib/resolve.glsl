#include "lib/present.glsl"

// Samples along each side of a pixel.
#ifndef SUPERSAMPLE
#define SUPERSAMPLE 1
#endif

layout(location = 0) out vec4 image;

// Linear color of one sample times its alpha, and alpha; the entry file says how they are composed.
vec4 sampleColor(ivec2 position);

// Averages the samples of a pixel in linear light. Rows are summed before they are added: sums of two
// equal numbers are exact, so a uniform color stays what it is.
vec4 pixelColor() {
    ivec2 first = ivec2(gl_FragCoord.xy) * SUPERSAMPLE;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < SUPERSAMPLE; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < SUPERSAMPLE; ++x) row += sampleColor(first + ivec2(x, y));
        sum += row;
    }
    return sum / float(SUPERSAMPLE * SUPERSAMPLE);
}

// With KEEP_LINEAR the picture before exposure, for another pass to go on with.
void resolvePixel() {
    image = pixelColor();
#ifndef KEEP_LINEAR
    image = presented(image);
#endif
}
