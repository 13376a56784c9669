#pragma once

#include "gl/objects.h"
#include "gl/pipeline_state.h"
#include "render/frame_description.h"
#include "render/volume_recorder.h"

#include <map>
#include <optional>
#include <vector>

namespace isoglass {

/// A part of the picture, in pixels from its lower left corner.
struct PictureRegion {
    glm::ivec2 origin, size;
};

/// The frame's surfaces, ready to be drawn by any pass: matrices computed, uniforms uploaded.
class DrawRecorder {
  public:
    /// `state` is the cache through which all state goes; it must outlive the recorder.
    explicit DrawRecorder(gl::StateCache& state);

    /// Takes the visible surfaces of `frame`, and its volume. Both are held by reference until the next
    /// `prepare`.
    void prepare(const FrameDescription& frame, const MeshStore& meshes, const VolumeStore& volumes);

    /// Uploads what the passes need, with the samples of all pixels moved by `shiftPixels` (x to the right,
    /// y upwards), for one of `subframes` pictures of which the average is shown.
    void upload(glm::dvec2 shiftPixels, int subframes);

    int opaqueCount() const { return static_cast<int>(opaque_.size()); }
    int semiTransparentCount() const { return static_cast<int>(semiTransparent_.size()); }
    /// In an illustration all surfaces are one or the other, else none.
    int primaryCount() const { return static_cast<int>(primary_.size()); }
    int secondaryCount() const { return static_cast<int>(secondary_.size()); }
    /// Proved for any view: no ray meets two semi-transparent fragments.
    bool overlapImpossible() const;

    /// Holds all surfaces with a pixel around them, but for what lies beside the picture.
    PictureRegion aroundSurfaces() const { return aroundSurfaces_; }

    /// Called by the executor at the start of a pass: the state that draws vary from.
    void beginPass(const gl::PipelineState& state);

    void drawOpaque() { draw(opaque_); }
    void drawSemiTransparent() { draw(semiTransparent_); }
    void drawPrimary() { draw(primary_); }
    void drawSecondary() { draw(secondary_); }
    void drawFullScreen();
    /// One ray a pixel through the frame's volume.
    void drawVolume();
    VolumeVariant volumeVariant() const { return volume_.variant(); }

  private:
    struct PreparedDraw {
        const GpuMesh* mesh;
        std::size_t uniformOffset;
        bool mirrored;
        std::size_t colorMap;
    };

    std::vector<PreparedDraw>& listOf(const SurfaceDraw& draw);
    void uploadFrameUniforms(int subframes);
    void uploadIllustration(glm::dvec2 shiftPixels);
    PictureRegion regionOf(double near) const;

    void draw(const std::vector<PreparedDraw>& draws);
    const gl::Buffer& colorMapUniforms(std::size_t map);
    void uploadUniforms(const std::vector<std::byte>& bytes);

    gl::StateCache& state_;
    gl::PipelineState passState_;
    std::size_t uniformStride_;
    std::optional<gl::Buffer> uniforms_;
    gl::Buffer frameUniforms_;
    gl::Buffer illustrationUniforms_;
    std::map<std::size_t, gl::Buffer> colorMaps_;  ///< made when first used
    gl::VertexArray noVertices_;
    FrameDescription frame_;
    const MeshStore* meshes_ = nullptr;
    VolumeRecorder volume_;
    PictureRegion aroundSurfaces_{};
    std::vector<const SurfaceDraw*> visible_;  ///< of frame_
    std::vector<PreparedDraw> opaque_;
    std::vector<PreparedDraw> semiTransparent_;
    std::vector<PreparedDraw> primary_;
    std::vector<PreparedDraw> secondary_;
};

}  // namespace isoglass
