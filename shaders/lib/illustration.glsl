// An illustration; mirrored by IllustrationUniforms. Numbers in parentheses are equations of J. Fischer,
// D. Bartz and W. Strasser, "Illustrative Display of Hidden Iso-Surface Structures", 2005.
layout(std140, binding = 4) uniform Illustration {
    vec4 light;              // towards it, in the world, length 1
    vec4 paper;              // linear color times alpha, and alpha; the two below have alpha 1
    vec4 frontColor;
    vec4 backColor;
    vec2 hatchRow;           // first row of the rotation in (7), over the size of the pattern
    vec2 shiftPixels;        // of the pixel's sample
    float hatchCross;
    float alpha;
    float beta;
    float normalThreshold;
    float depthThreshold;    // change of distance a pixel, over the distance
};

// Diffuse light (1, 6).
float intensity(vec3 normal) { return max(dot(normal, light.xyz), 0.0); }
