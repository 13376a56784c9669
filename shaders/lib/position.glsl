#include "lib/draw.glsl"

// Passes compare depths of the same fragment for equality: every vertex shader takes its position
// from here, and invariance forbids the compiler to evaluate it differently.
invariant gl_Position;

layout(location = 0) in vec3 positionMesh;

void placeVertex() {
    gl_Position = clipFromMesh * vec4(positionMesh, 1.0);
    // Depth is near over distance.
    gl_Position.z *= depthScale;
}
