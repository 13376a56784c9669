#pragma once

#include "render/volume_draw.h"
#include "scene/layer_style.h"

#include <glm/vec3.hpp>

namespace isoglass {

/// The layers of one iso-surface, found by rays. What is next to missing samples ends a layer without
/// counting.
struct LayerDraw : VolumeDraw {
    float iso = 0;
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
