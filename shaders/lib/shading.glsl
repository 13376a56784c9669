#include "lib/draw.glsl"
#include "lib/frame.glsl"

in Surface {
    vec3 normal;  // not normalised, so that it interpolates without popping
    vec3 toEye;
} surface;

// Any finite length, also those whose square is no float. The null vector stays null.
vec3 direction(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// Blinn-Phong with a head light: light and viewer share a direction, and so does the halfway vector.
// The absolute value turns the normal towards the viewer: both sides are lit alike.
vec3 shadedColor() {
    float cosine = abs(dot(direction(surface.normal), direction(surface.toEye)));
    return colorOpacity.rgb * (ambient + diffuse * cosine) + specular * pow(cosine, shininess);
}
