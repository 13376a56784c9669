#include "lib/color_map.glsl"
#include "lib/lighting.glsl"
#include "lib/surface.glsl"

// The cosine's absolute value turns the normal towards the viewer: both sides are lit alike.
vec3 shadedColor() { return litColor(surfaceColor(), cosineOfView()); }
