#pragma once

#include "gl/objects.h"
#include "gl/pipeline_state.h"
#include "render/frame_description.h"

#include <optional>
#include <vector>

namespace isoglass {

/// The frame's surfaces, ready to be drawn by any pass: matrices computed, uniforms uploaded.
class DrawRecorder {
  public:
    /// `state` is the cache through which all state goes; it must outlive the recorder.
    explicit DrawRecorder(gl::StateCache& state);

    /// Takes the visible surfaces of `frame`. Meshes are held by reference until the next `prepare`.
    void prepare(const FrameDescription& frame, const MeshStore& meshes);

    int opaqueCount() const { return static_cast<int>(opaque_.size()); }
    int semiTransparentCount() const { return static_cast<int>(semiTransparent_.size()); }

    /// Called by the executor at the start of a pass: the state that draws vary from.
    void beginPass(const gl::PipelineState& state);

    void drawOpaque() { draw(opaque_); }
    void drawSemiTransparent() { draw(semiTransparent_); }
    void drawFullScreen();

  private:
    struct PreparedDraw {
        const GpuMesh* mesh;
        std::size_t uniformOffset;
        bool mirrored;
    };

    void draw(const std::vector<PreparedDraw>& draws);
    void uploadUniforms(const std::vector<std::byte>& bytes);

    gl::StateCache& state_;
    gl::PipelineState passState_;
    std::size_t uniformStride_;
    std::optional<gl::Buffer> uniforms_;
    gl::Buffer frameUniforms_;
    gl::VertexArray noVertices_;
    std::vector<PreparedDraw> opaque_;
    std::vector<PreparedDraw> semiTransparent_;
};

}  // namespace isoglass
