#pragma once

#include "gl/objects.h"
#include "render/camera.h"
#include "render/layer_draw.h"

#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// What the shaders of a pass through a volume are made for.
struct VolumeVariant {
    std::vector<std::string> defines;
    std::vector<int> units;  ///< of the volume's textures, increasing
};

/// The frame's volume, ready for the pass that casts rays through it.
class VolumeRecorder {
  public:
    VolumeRecorder();

    /// Throws Error for more planes than the shaders take. `volumes` must hold the samples until the frame is
    /// drawn.
    void prepare(const std::optional<LayerDraw>& draw, const VolumeStore& volumes);

    VolumeVariant variant() const;

    /// Uploads what the shaders need. `clipShift` is that of the picture in clip space, `nearDistance` that
    /// of the depth that the pass reads.
    void upload(const CameraView& camera, glm::dvec2 clipShift, double nearDistance);

    /// Binds uniforms and textures for the draw that follows.
    void bind() const;

  private:
    void uploadAxes();

    std::optional<LayerDraw> draw_;
    const VolumeStore* volumes_ = nullptr;
    bool evenAxes_ = true;
    gl::Buffer uniforms_;
    std::optional<gl::Texture> axisTables_;
};

}  // namespace isoglass
