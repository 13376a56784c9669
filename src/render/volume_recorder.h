#pragma once

#include "gl/objects.h"
#include "render/camera.h"
#include "render/layer_draw.h"
#include "render/shaded_draw.h"
#include "render/transfer_table.h"

#include <optional>
#include <string>
#include <vector>

namespace isoglass {

struct VolumeUniforms;

/// What the shaders of a pass through a volume are made for.
struct VolumeVariant {
    std::vector<std::string> defines;
    std::vector<int> units;  ///< of the volume's textures, increasing
};

/// The frame's volume, ready for the pass that casts rays through it.
class VolumeRecorder {
  public:
    VolumeRecorder();

    /// One of both at most. Throws Error for more planes than the shaders take. `volumes` must hold the
    /// samples until the frame is drawn.
    void prepare(const std::optional<LayerDraw>& layers, const std::optional<ShadedDraw>& shaded,
                 const VolumeStore& volumes);

    VolumeVariant variant() const;

    /// Uploads what the shaders need. `clipShift` is that of the picture in clip space, `nearDistance` that
    /// of the depth that the pass reads.
    void upload(const CameraView& camera, glm::dvec2 clipShift, double nearDistance);

    /// Binds uniforms and textures for the draw that follows.
    void bind() const;

  private:
    /// Of the two the one that is there, or null.
    const VolumeDraw* draw() const;
    bool lightsCuts() const;
    void uploadAxes();
    void setLayers(VolumeUniforms& uniforms) const;
    void setMedium(VolumeUniforms& uniforms);

    std::optional<LayerDraw> layers_;
    std::optional<ShadedDraw> shaded_;
    const VolumeStore* volumes_ = nullptr;
    bool evenAxes_ = true;
    gl::Buffer uniforms_;
    std::optional<gl::Texture> axisTables_;
    std::optional<VolumeStyle> tableStyle_;  ///< what the two tables are made from
    TransferTable table_;
    std::optional<gl::Texture> transfer_;
    std::optional<gl::Texture> visibleRanges_;
};

}  // namespace isoglass
