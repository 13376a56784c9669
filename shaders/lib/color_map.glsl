#include "lib/draw.glsl"
#include "lib/surface.glsl"

// Linear colors; mirrored by ColorMapUniforms.
layout(std140, binding = 2) uniform ColorMap { vec4 mapColors[256]; };

const vec3 kNoValueColor = vec3(0.2);

vec3 surfaceColor() {
    if (colorByValue == 0) return colorOpacity.rgb;
    if (isnan(surface.colorValue)) return kNoValueColor;
    float place = clamp((surface.colorValue - colorLow) * colorScale, 0.0, 1.0) * 255.0;
    int low = min(int(place), 254);
    return mix(mapColors[low].rgb, mapColors[low + 1].rgb, place - float(low));
}
