#pragma once

#include "gl/context.h"
#include "gl/pipeline_state.h"
#include "gl/program.h"
#include "render/draw_recorder.h"
#include "render/fragment_lists.h"
#include "render/pass.h"
#include "render/render_targets.h"

#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace isoglass {

/// What a pass took.
struct PassTiming {
    /// gpuTimer: a timer query around the pass. serialWallClock: the wall clock between two glFinish,
    /// because a software renderer's queries tell nothing; the passes then do not overlap.
    enum class How { gpuTimer, serialWallClock };

    std::string label;
    double milliseconds;
    How how;
};

/// Throws std::logic_error where a pass does not declare exactly the textures, images and storage that its
/// shaders use and the outputs that they write.
void checkInterface(const PassDeclaration& pass, const gl::Program& program);

/// Runs declared passes: binds targets, applies state, pushes debug groups, times.
class PassExecutor {
  public:
    PassExecutor(gl::Context& context, gl::StateCache& state) : context_(context), state_(state) {}

    /// What the passes of a frame draw with and into.
    struct Frame {
        RenderTargets& targets;
        DrawRecorder& recorder;
        glm::vec4 background;  ///< color times alpha, and alpha
        /// One entry a pass is added, or time where a pass of that label has an entry; this waits for the
        /// GPU. May be null.
        std::vector<PassTiming>* timings;
    };

    /// Programs are made when a pass first needs them. Throws Error for a shader that the driver refuses,
    /// and where the fragments of a single pixel do not fit the memory of the lists.
    void run(std::span<const PassDeclaration> passes, const Frame& frame);

    FragmentLists& lists() { return lists_; }

  private:
    using Region = PictureRegion;

    const gl::Program& program(const PassDeclaration& pass);
    void runPass(const PassDeclaration& pass, const Frame& frame, const Region& region);
    void runTimed(const PassDeclaration& pass, const Frame& frame, const Region& region);
    void runLists(const PassDeclaration& build, const PassDeclaration& use, const Frame& frame,
                  const Region& picture);
    static std::vector<Region> split(const Region& region, std::uint64_t parts);

    gl::Context& context_;
    gl::StateCache& state_;
    FragmentLists lists_;
    std::map<std::tuple<std::string, std::string, std::vector<std::string>>, gl::Program> programs_;
};

}  // namespace isoglass
