#include "lib/color_map.glsl"
#include "lib/frame.glsl"
#include "lib/surface.glsl"

// Blinn-Phong with a head light: light and viewer share a direction, and so does the halfway vector.
// The cosine's absolute value turns the normal towards the viewer: both sides are lit alike.
vec3 shadedColor() {
    float cosine = cosineOfView();
    return surfaceColor() * (ambient + diffuse * cosine) + specular * pow(cosine, shininess);
}
