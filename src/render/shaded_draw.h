#pragma once

#include "render/volume_draw.h"
#include "scene/volume_style.h"

namespace isoglass {

/// A volume as a medium: see VolumeStyle, whose `unit` must be given. The light along a ray is summed up at
/// the middles of steps, each with the opacity and the light of its length (equations 8 and 9 of the paper
/// there).
struct ShadedDraw : VolumeDraw {
    VolumeStyle style;

    friend bool operator==(const ShadedDraw&, const ShadedDraw&) = default;
};

}  // namespace isoglass
