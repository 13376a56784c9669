#version 450 core
#include "lib/position.glsl"

layout(location = 1) in vec3 normalMesh;

out Surface {
    vec3 normal;
    vec3 toEye;
} surface;

void main() {
    placeVertex();
    surface.normal = normalFromMesh * normalMesh;
    surface.toEye = -(eyeFromMesh * vec4(positionMesh, 1.0)).xyz;
}
