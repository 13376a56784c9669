#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <array>

namespace isoglass {

/// Uniform block `Frame` of shaders/lib/frame.glsl, std140.
struct FrameUniforms {
    static constexpr unsigned kBinding = 0;

    glm::vec4 background;
    float ambient;
    float diffuse;
    float specular;
    float shininess;
    float exposure;
    float accumulationShare;
    int layerLimit;
    float padding[1] = {};
};

/// Uniform block `Draw` of shaders/lib/draw.glsl, std140.
struct DrawUniforms {
    static constexpr unsigned kBinding = 1;

    glm::mat4 clipFromMesh;
    glm::mat4 eyeFromMesh;
    std::array<glm::vec4, 3> normalFromMesh;  ///< columns; the fourth component is padding
    glm::vec4 colorOpacity;
    int opacityModel;  ///< 0 constant, else 1 + ShellOpacity::Model
    float extinction;
    float thickness;
    float isoWidth;
    float maxThickness;
    float cosinePower;
    float cosineOffset;
    float gradientScale;
    float depthScale;
    int colorByValue;  ///< 0 or 1
    float colorLow;
    float colorScale;  ///< one over the range
    float motion;
    float motionLimit;
    float padding[2] = {};
};

/// Uniform block `ColorMap` of shaders/lib/color_map.glsl, std140.
struct ColorMapUniforms {
    static constexpr unsigned kBinding = 2;

    std::array<glm::vec4, 256> colors;  ///< linear; the fourth component is padding
};

/// Uniform block `Volume` of shaders/lib/volume.glsl, std140.
struct VolumeUniforms {
    static constexpr unsigned kBinding = 3;

    glm::vec4 eye;
    glm::vec4 forward;
    glm::vec4 right;
    glm::vec4 up;
    glm::vec4 boxLow;
    glm::vec4 boxHigh;
    glm::vec4 indexPerUnit;
    std::array<glm::vec4, 3> worldFromLocal;   ///< columns; the fourth component is padding
    std::array<glm::vec4, 3> normalFromLocal;  ///< likewise
    std::array<glm::vec4, 16> planes;
    glm::ivec4 samples;
    glm::vec2 shift;
    float fraction;
    float iso;
    float stepCells;
    float nearDistance;
    int planeCount;
    int layersWanted;
    std::array<glm::vec4, 16> layerColors;
    int show;
    float silhouette;
    int firstLayer;
    float transferLow;
    float transferScale;
    float perUnit;
    int litByGradient;  ///< 0 or 1
    int solidCount;
    std::array<glm::ivec4, 8> solids;     ///< SolidShape, Keep
    std::array<glm::vec4, 24> solidRows;  ///< three a solid: of the matrix that maps local to its coordinates
    std::array<glm::vec4, 24> solidGradients;  ///< in the world, of those coordinates
    std::array<glm::vec4, 16> planeNormals;    ///< in the world, of length 1
    float cutThickness;
    int cutWeight;  ///< CutLight::Weight
    float padding[2] = {};
};

/// Uniform block `Illustration` of shaders/lib/illustration.glsl, std140.
struct IllustrationUniforms {
    static constexpr unsigned kBinding = 4;

    glm::vec4 light;
    glm::vec4 paper;
    glm::vec4 frontColor;
    glm::vec4 backColor;
    glm::vec2 hatchRow;
    glm::vec2 shiftPixels;
    float hatchCross;
    float alpha;
    float beta;
    float normalThreshold;
    float depthThreshold;
    float padding[3] = {};
};

}  // namespace isoglass
