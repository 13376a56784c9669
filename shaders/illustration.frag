#version 450 core
#include "lib/illustration.glsl"
#include "lib/seen_surface.glsl"

layout(location = 0) out vec4 opaqueColor;

ivec2 place = ivec2(0);

#ifdef SURFACES
layout(binding = 11) uniform usampler2D firstSurface;
layout(binding = 12) uniform usampler2D secondSurface;

// The neighbouring pixels' places; beyond the picture's edge it goes on as it ends.
ivec2 before = ivec2(0);
ivec2 after = ivec2(0);

uvec2 texelAt(usampler2D surface, int x, int y) { return texelFetch(surface, ivec2(x, y), 0).xy; }
float distanceAt(usampler2D surface, int x, int y) { return distanceOf(texelAt(surface, x, y)); }

// Where the distance jumps (3), the normals turn (4, 5) or the surface ends. `farthest` is 0 where there is none at
// all.
bool isSilhouette(usampler2D surface, uvec2 here, out float farthest) {
    uvec2 left = texelAt(surface, before.x, place.y);
    uvec2 right = texelAt(surface, after.x, place.y);
    uvec2 below = texelAt(surface, place.x, before.y);
    uvec2 above = texelAt(surface, place.x, after.y);
    vec4 sides = vec4(distanceOf(left), distanceOf(right), distanceOf(below), distanceOf(above));
    vec4 corners = vec4(distanceAt(surface, before.x, before.y), distanceAt(surface, after.x, before.y),
                        distanceAt(surface, before.x, after.y), distanceAt(surface, after.x, after.y));
    vec4 least = min(sides, corners);
    vec4 most = max(sides, corners);
    float distance = distanceOf(here);
    float nearest = min(min(min(least.x, least.y), min(least.z, least.w)), distance);
    farthest = max(max(max(most.x, most.y), max(most.z, most.w)), distance);
    if (nearest == 0.0) return farthest > 0.0;
    vec3 normal = normalOf(here);
    float similarity = dot(normal, normalOf(left)) + dot(normal, normalOf(right)) + dot(normal, normalOf(below)) +
                       dot(normal, normalOf(above));
    // Sobel's sums over 8: change of distance a pixel.
    vec2 change = vec2(corners.y + corners.w - corners.x - corners.z + 2.0 * (sides.y - sides.x),
                       corners.z + corners.w - corners.x - corners.y + 2.0 * (sides.w - sides.z)) / 8.0;
    return similarity < normalThreshold || length(change) >= depthThreshold * distance;
}

// Whether a stroke covers the pixel (7, 8, 9). Equal is dark: where no light falls, no t of 0 leaves a speck.
bool isHatched(float light) {
    vec2 pixel = gl_FragCoord.xy / float(SUPERSAMPLE) + shiftPixels;
    float s = fract(dot(hatchRow * vec2(1.0, -1.0), pixel));
    float t = fract(dot(hatchRow.yx, pixel));
    return light <= (s <= hatchCross ? hatchCross * t : (1.0 - hatchCross) * s + hatchCross);
}
#endif

#ifdef SECONDARY_GEOMETRY
layout(binding = 13) uniform sampler2D secondaryShade;
#endif

// From the front backwards: what the front covers need not be looked for.
vec4 drawing() {
    bool backLine = false;
#ifdef SURFACES
    before = max(place - SUPERSAMPLE, 0);
    after = min(place + SUPERSAMPLE, textureSize(firstSurface, 0) - 1);
    uvec2 first = texelAt(firstSurface, place.x, place.y);
    float farthest;
    bool frontLine = isSilhouette(firstSurface, first, farthest);
    if (frontLine || (distanceOf(first) > 0.0 && isHatched(intensity(normalOf(first))))) return frontColor;
    // Where there is no first surface there is no second one.
    if (farthest > 0.0)
        backLine = isSilhouette(secondSurface, texelAt(secondSurface, place.x, place.y), farthest);
#endif
    vec4 color = backLine ? backColor : paper;
#ifdef SECONDARY_GEOMETRY
    vec4 shade = texelFetch(secondaryShade, place, 0);
    // Silhouettes of the second surface cover what is behind it (10).
    if (shade.a > 0.0 || !backLine) color = mix(color, vec4(shade.rgb, 1.0), abs(shade.a));
#endif
    return color;
}

void main() {
    place = ivec2(gl_FragCoord.xy);
    opaqueColor = drawing();
}
