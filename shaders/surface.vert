#version 450 core
#include "lib/position.glsl"

layout(location = 1) in vec3 normalMesh;
layout(location = 2) in float colorValueMesh;

out Surface {
    vec3 normal;
    vec3 toEye;
    float colorValue;
} surface;

void main() {
    placeVertex();
    surface.normal = normalFromMesh * normalMesh;
    surface.colorValue = colorValueMesh;
    surface.toEye = -(eyeFromMesh * vec4(movedPosition(), 1.0)).xyz;
}
