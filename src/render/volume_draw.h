#pragma once

#include "render/volume_store.h"
#include "scene/clip_solid.h"

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <vector>

namespace isoglass {

/// A solid that clips a volume.
struct SolidClip {
    SolidShape shape = SolidShape::box;
    Keep keep = Keep::inside;
    glm::dmat4 seriesFromSolid{1};  ///< affine, invertible

    friend bool operator==(const SolidClip&, const SolidClip&) = default;
};

/// A volume that rays go through, as the frame shows it: in front of the background and of opaque surfaces as
/// far as those leave it free, behind semi-transparent surfaces.
///
/// The samples lie at `axes` (series coordinates, strictly monotonic, at least two along each axis); between
/// them, and between both key frames, the field is linear in each variable. What is next to missing samples
/// is empty.
struct VolumeDraw {
    VolumeId first{};   ///< in the renderer's volumes
    VolumeId second{};  ///< of the same dimensions; looked at where `fraction` is above 0
    float fraction = 0;
    glm::dmat4 worldFromSeries{1};  ///< affine
    std::array<std::vector<double>, 3> axes;
    std::vector<glm::dvec4>
        planes;  ///< series coordinates; keep a x + b y + c z + d >= 0. At most kMostVolumePlanes
    std::vector<SolidClip> solids{};  ///< at most kMostSolids

    friend bool operator==(const VolumeDraw&, const VolumeDraw&) = default;
};

}  // namespace isoglass
