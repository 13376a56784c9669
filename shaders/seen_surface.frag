#version 450 core
#include "lib/peel.glsl"
#include "lib/seen_surface.glsl"
#include "lib/surface.glsl"

layout(location = 0) out uvec2 seenSurface;

// The side that is seen lies where light can fall on it, also of open surfaces.
void main() {
    if (isPeeled()) discard;
    seenSurface = packedSurface(seenNormal(), 1.0 / gl_FragCoord.w);
}
