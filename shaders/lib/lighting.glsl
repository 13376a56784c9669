#include "lib/frame.glsl"

// Blinn-Phong with a head light: light and viewer share a direction, and so does the halfway vector.
// `cosine` is that of the angle between normal and view, of whichever side is seen.
vec3 litColor(vec3 color, float cosine) {
    return color * (ambient + diffuse * cosine) + specular * pow(cosine, shininess);
}
