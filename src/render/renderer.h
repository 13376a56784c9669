#pragma once

#include "gl/context.h"
#include "plan/frame_plan.h"
#include "render/draw_recorder.h"
#include "render/frame_description.h"
#include "render/image.h"
#include "render/mesh_store.h"
#include "render/pass_executor.h"
#include "render/render_targets.h"

#include <optional>
#include <vector>

namespace isoglass {

/// Draws frames into textures and reads them back.
///
/// Made, used and destroyed by the thread that owns the context.
class Renderer {
  public:
    /// `context` must outlive the renderer and be current.
    explicit Renderer(gl::Context& context);

    MeshStore& meshes() { return meshes_; }
    VolumeStore& volumes() { return volumes_; }

    /// Plans and draws. The image depends on `frame` and its meshes alone. Throws Error for a camera, a
    /// size or a number of samples or layers that cannot be drawn and for anything that OpenGL complains
    /// of; std::invalid_argument for a mesh that is not in the store.
    void render(const FrameDescription& frame);
    /// The same with passes chosen by the caller, who must take all that `plan` would need.
    void render(const FrameDescription& frame, const FramePlan& plan);
    /// Draws only where the last frame was another one; returns whether it did. `plan` then tells of an
    /// unchanged frame.
    bool renderIfChanged(const FrameDescription& frame);

    /// Copies the last frame to the lower left of the window of a context that has one, and returns the
    /// frame's size. Throws std::logic_error before the first frame.
    glm::ivec2 copyToWindow();

    /// The plan of a frame as `render` would make it.
    FramePlan planOf(const FrameDescription& frame);
    /// The passes of the last frame and why; empty before the first.
    const FramePlan& plan() const { return plan_; }

    /// Most bytes of GPU memory for the fragment lists of the method exact. Where a frame needs more, it is
    /// drawn in parts: slower, but the same bits.
    void setListMemory(std::size_t bytes) { executor_.lists().setLimit(bytes); }

    /// With timing on, `render` waits for the GPU after each pass.
    void setTiming(bool on) { timing_ = on; }
    /// One entry a pass of the last frame; empty with timing off.
    const std::vector<PassTiming>& timings() const { return timings_; }

    /// The last frame before exposure, not clamped; with a transparent background, times alpha. It must have
    /// asked for `keepLinear`. Reading waits for the GPU. All three throw std::logic_error before the first
    /// frame.
    LinearImage readLinear();
    /// The last frame after exposure and the sRGB curve, with straight alpha: 1 - (1 - A) prod(1 - a_i),
    /// where A is 1 on opaque surfaces and the background's opacity beside them; 255 over an opaque
    /// background. Light that a method adds beyond alpha is clamped.
    Image readSrgb();
    /// Depth of what is opaque, but for illustrations, in samples (twice the image's size along each axis
    /// where `samples` is a multiple of 4); of the last of the pictures that were averaged.
    DepthImage readDepth();
    /// What a pass of the last frame left in a target, in samples: for tests and studies. Four floats, or two
    /// integers.
    Raster<glm::vec4> readFloats(Target target);
    Raster<glm::uvec2> readIntegers(Target target);

  private:
    gl::Context& context_;
    gl::StateCache state_;
    MeshStore meshes_;
    VolumeStore volumes_;
    RenderTargets targets_;
    DrawRecorder recorder_;
    PassExecutor executor_;
    FramePlan plan_{};
    std::optional<FrameDescription> shown_;  ///< the last frame; empty where drawing failed
    int drawnSubframes_ = 1;                 ///< of the last frame
    bool drewOpaque_ = false;                ///< in the last frame
    bool timing_ = false;
    std::vector<PassTiming> timings_;
};

}  // namespace isoglass
