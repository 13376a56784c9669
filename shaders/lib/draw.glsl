// What one draw brings; mirrored by DrawUniforms.
layout(std140, binding = 1) uniform Draw {
    mat4 clipFromMesh;
    mat4 eyeFromMesh;     // world axes, origin at the eye
    mat3 normalFromMesh;  // inverse transpose of eyeFromMesh up to a positive factor
    vec4 colorOpacity;    // linear color, opacity of the constant model
    int opacityModel;     // 0 constant, 1 slab, 2 cosine, 3 iso-spectrum; the rest as in ShellOpacity
    float extinction;
    float thickness;
    float isoWidth;
    float maxThickness;
    float cosinePower;
    float cosineOffset;
    float gradientScale;  // length of the world gradient for a transformed normal of length 1
    float depthScale;     // 1, or a little more to lie in front of what is in the same plane
    int colorByValue;     // whether colorValue and not colorOpacity gives the color
    float colorLow;       // value at the low end of the color map
    float colorScale;     // one over the range of the color map
    float motion;         // fraction of the key interval since the mesh's moment
    float motionLimit;    // how far a vertex moves at most, in the mesh's coordinates
};
