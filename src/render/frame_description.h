#pragma once

#include "render/camera.h"
#include "render/mesh_store.h"
#include "scene/scene.h"

#include <glm/mat4x4.hpp>

#include <vector>

namespace isoglass {

/// One surface as the frame shows it.
struct SurfaceDraw {
    MeshId mesh{};
    glm::dmat4 worldFromSeries{1};  ///< affine; the mesh's positions are series coordinates
    LinearColor color{0.8f};
    float opacity = 1;  ///< 1 and above is opaque; 0 and below, like an empty mesh, is not drawn at all
};

/// Everything that a frame's image depends on.
struct FrameDescription {
    CameraView camera;
    std::vector<SurfaceDraw> draws{};
    LinearColor background{0};
    /// Below 1 the picture has alpha: that of the background, and what surfaces cover of it.
    float backgroundOpacity = 1;
    float exposure = 1;  ///< linear factor before the sRGB curve
    /// color * (ambient + diffuse * cos) + specular * cos^shininess, where cos is that of the angle between
    /// normal and view: light and eye are one. Both sides of a surface are lit alike. `shininess` is above 0.
    Lighting lighting{};
    TransparencyMethod method = TransparencyMethod::automatic;
    /// Samples a pixel along each axis, 1 or 2, averaged in linear light.
    int supersample = 1;
    bool separatePasses = false;  ///< see PlanInput
    bool wireframe = false;       ///< triangles are drawn as their edges, to look at the mesh
};

}  // namespace isoglass
