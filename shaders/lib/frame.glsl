// What all draws of a frame share; mirrored by FrameUniforms.
layout(std140, binding = 0) uniform Frame {
    float ambient;
    float diffuse;
    float specular;
    float shininess;
    float exposure;
    int supersample;
};
