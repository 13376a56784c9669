#version 450 core
#include "lib/color_map.glsl"
#include "lib/illustration.glsl"
#include "lib/surface.glsl"

layout(location = 0) out vec4 secondaryShade;

#ifdef SURFACES
layout(binding = 5) uniform sampler2D firstDepth;
layout(binding = 6) uniform sampler2D secondDepth;

// Of the surfaces that lie in front (2); depth is larger where it is nearer, and 0 where there is nothing.
bool isBehind(sampler2D depth) { return gl_FragCoord.z <= texelFetch(depth, ivec2(gl_FragCoord.xy), 0).r; }
float attenuation() { return isBehind(secondDepth) ? -beta : isBehind(firstDepth) ? alpha : 1.0; }
#else
float attenuation() { return 1.0; }
#endif

void main() {
    secondaryShade = vec4(surfaceColor(), attenuation() * intensity(seenNormal()));
}
