// What one draw brings; mirrored by DrawUniforms.
layout(std140, binding = 1) uniform Draw {
    mat4 clipFromMesh;
    mat4 eyeFromMesh;     // world axes, origin at the eye
    mat3 normalFromMesh;  // inverse transpose of eyeFromMesh up to a positive factor
    vec4 colorOpacity;    // linear color, opacity
};
