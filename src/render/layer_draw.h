#pragma once

#include "render/volume_store.h"
#include "scene/layer_style.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace isoglass {

inline constexpr std::size_t kMostVolumePlanes = 16;

/// The layers of one iso-surface as the frame shows them, found by rays through the samples: in front of the
/// background and of opaque surfaces as far as those leave them free, behind semi-transparent surfaces.
///
/// The samples lie at `axes` (series coordinates, strictly monotonic, at least two along each axis); between
/// them, and between both key frames, the field is linear in each variable. What is next to missing samples
/// is empty and ends a layer without counting.
struct LayerDraw {
    VolumeId first{};   ///< in the renderer's volumes
    VolumeId second{};  ///< of the same dimensions; looked at where `fraction` is above 0
    float fraction = 0;
    float iso = 0;
    glm::dmat4 worldFromSeries{1};  ///< affine
    std::array<std::vector<double>, 3> axes;
    std::vector<glm::dvec4>
        planes;  ///< series coordinates; keep a x + b y + c z + d >= 0. At most kMostVolumePlanes
    LayerStyle style;
    glm::vec3 color{0.8f};  ///< where the style has none

    /// `measure` writes in place of colour how far layer `style.count` lies from the eye, along the view's
    /// axis (0 where there is none), and how many layers the whole ray meets: for tests and studies.
    enum class Output { color, measure } output = Output::color;
    /// Goes on to the end of the ray when nothing more can be seen, to learn what stopping early saves.
    bool wholeRay = false;

    friend bool operator==(const LayerDraw&, const LayerDraw&) = default;
};

}  // namespace isoglass
