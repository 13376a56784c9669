#pragma once

#include "gl/context.h"
#include "gl/pipeline_state.h"
#include "gl/program.h"
#include "render/draw_recorder.h"
#include "render/pass.h"
#include "render/render_targets.h"

#include <map>
#include <span>
#include <string>
#include <utility>
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

/// Throws std::logic_error where a pass does not declare exactly the textures that its shaders read and
/// the outputs that they write.
void checkInterface(const PassDeclaration& pass, const gl::Program& program);

/// Runs declared passes: binds targets, applies state, pushes debug groups, times.
class PassExecutor {
  public:
    PassExecutor(gl::Context& context, gl::StateCache& state) : context_(context), state_(state) {}

    /// `background` is multiplied by its alpha. With `timings`, appends one entry a pass; this waits for the
    /// GPU. Programs are made when a pass first needs them. Throws Error for a shader that the driver
    /// refuses.
    void run(std::span<const PassDeclaration> passes, RenderTargets& targets, const glm::vec4& background,
             DrawRecorder& recorder, std::vector<PassTiming>* timings);

  private:
    const gl::Program& program(const PassDeclaration& pass);
    void runPass(const PassDeclaration& pass, RenderTargets& targets, const glm::vec4& background,
                 DrawRecorder& recorder);
    PassTiming timed(const PassDeclaration& pass, RenderTargets& targets, const glm::vec4& background,
                     DrawRecorder& recorder);

    gl::Context& context_;
    gl::StateCache& state_;
    std::map<std::pair<std::string, std::string>, gl::Program> programs_;
};

}  // namespace isoglass
