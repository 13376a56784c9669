// What all draws of a frame share; mirrored by FrameUniforms.
layout(std140, binding = 0) uniform Frame {
    vec4 background;  // linear color times alpha, and alpha
    float ambient;
    float diffuse;
    float specular;
    float shininess;
    float exposure;
    float accumulationShare;  // of one of the pictures that are averaged
    int layerLimit;           // nearest fragments of a list that count
};
