#include "lib/draw.glsl"

// Passes compare depths of the same fragment for equality: every vertex shader takes its position
// from here, and invariance forbids the compiler to evaluate it differently.
invariant gl_Position;

layout(location = 0) in vec3 positionMesh;

layout(location = 3) in vec3 velocityMesh;  // per fraction of a key interval; 0 where a mesh has none

// Where the vertex is at the displayed time; mirrored by displacement() in surface/motion.h.
vec3 movedPosition() {
    if (motion == 0.0) return positionMesh;
    vec3 moved = motion * velocityMesh;
    float far = length(moved);
    return positionMesh + (far > motionLimit ? motionLimit / far * moved : moved);
}

void placeVertex() {
    gl_Position = clipFromMesh * vec4(movedPosition(), 1.0);
    // Depth is near over distance.
    gl_Position.z *= depthScale;
}
