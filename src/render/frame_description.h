#pragma once

#include "optics/shell_transmittance.h"
#include "render/camera.h"
#include "render/layer_draw.h"
#include "render/legend.h"
#include "render/mesh_store.h"
#include "render/shaded_draw.h"
#include "scene/scene.h"

#include <glm/mat4x4.hpp>

#include <optional>
#include <vector>

namespace isoglass {

/// One surface as the frame shows it.
struct SurfaceDraw {
    MeshId mesh{};
    glm::dmat4 worldFromSeries{1};  ///< affine; the mesh's positions are series coordinates
    LinearColor color{0.8f};
    /// Colour by the mesh's `colorValues` takes the place of `color`; the mesh must have them.
    std::optional<LegendBar> colorBar{};
    float opacity = 1;  ///< 1 and above is opaque; 0 and below, like an empty mesh, is not drawn at all
    /// Opacity by the angle of view takes the place of `opacity`; never opaque.
    std::optional<PreparedShell> shell{};

    /// Holds the mesh, in series coordinates; the mesh's own box where not given. Pictures of parts of one
    /// surface are equal where they show the same, bit by bit, when they are given the same box.
    std::optional<Bounds> boundsSeries{};

    /// Moves vertices by the mesh's velocities, if it has them, through this part of the time between the two
    /// key frames, at most as far as `motionLimit` (series units). The bounds must hold the moved mesh.
    float motion = 0;
    float motionLimit = 0;

    /// Moves the surface towards the eye by 2^-14 of its distance a rank, which settles what is in front
    /// where flat parts of several surfaces lie in one plane.
    int depthRank = 0;

    /// In an illustration: visible behind what hides it, in its own color, and without lines.
    bool secondary = false;

    bool opaque() const { return opacity >= 1 && !shell; }
    bool visible() const { return opacity > 0 || shell; }

    friend bool operator==(const SurfaceDraw&, const SurfaceDraw&) = default;
};

/// Everything that a frame's image depends on.
struct FrameDescription {
    CameraView camera;
    std::vector<SurfaceDraw> draws{};
    std::optional<LayerDraw> layerDraw{};    ///< an iso-surface in layers, over what is opaque
    std::optional<ShadedDraw> shadedDraw{};  ///< a volume as a medium, likewise; not with `layerDraw`
    /// Draws lines in place of lit surfaces: whatever is visible counts as opaque. Not with a volume.
    std::optional<IllustrativeStyle> illustration{};
    LinearColor background{0};
    /// Below 1 the picture has alpha: that of the background, and what surfaces cover of it.
    float backgroundOpacity = 1;
    float exposure = 1;  ///< linear factor before the sRGB curve
    /// color * (ambient + diffuse * cos) + specular * cos^shininess, where cos is that of the angle between
    /// normal and view: light and eye are one. Both sides of a surface are lit alike. `shininess` is above 0.
    Lighting lighting{};
    TransparencyMethod method = TransparencyMethod::automatic;
    int layers = 4;                   ///< of the method peel, 1 to kMostLayers
    bool reproducible = false;        ///< the same bits for any order of draws and triangles; not with 2-pass
    bool exactWanted = false;         ///< the method automatic takes exact
    int samples = 1;                  ///< a pixel, 1 to kMostSamples, averaged in linear light
    bool wireframe = false;           ///< triangles are drawn as their edges, to look at the mesh
    std::vector<Overlay> overlays{};  ///< cover the sRGB image, not the linear one
    bool keepLinear = true;           ///< Renderer::readLinear works after the frame; costs up to one pass

    friend bool operator==(const FrameDescription&, const FrameDescription&) = default;
};

}  // namespace isoglass
