#include "render/pass_executor.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace isoglass {
namespace {

/// A named span of commands in tools that look at GL traces.
class DebugGroup {
  public:
    explicit DebugGroup(std::string_view label) {
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(label.size()), label.data());
    }
    ~DebugGroup() { glPopDebugGroup(); }
    DebugGroup(const DebugGroup&) = delete;
    DebugGroup& operator=(const DebugGroup&) = delete;
};

std::vector<Target> colorTargets(const PassDeclaration& pass) {
    std::vector<Target> targets;
    for (const ColorWrite& write : pass.writes) targets.push_back(write.target);
    return targets;
}

std::optional<Target> depthTarget(const PassDeclaration& pass) {
    return pass.depth ? std::optional(pass.depth->target) : std::nullopt;
}

glm::vec4 fillColor(ColorWrite::Begin begin, const glm::vec4& background) {
    if (begin == ColorWrite::Begin::fillBackground) return background;
    return glm::vec4(begin == ColorWrite::Begin::fillOne ? 1.0f : 0.0f);
}

void copyDepth(Target from, Target to, RenderTargets& targets) {
    const gl::Framebuffer& source = targets.framebuffer({}, from, "copy of a depth buffer");
    const gl::Framebuffer& destination = targets.framebuffer({}, to, "copy of a depth buffer");
    const glm::ivec2 size = targets.sizeOf(from);
    glBlitNamedFramebuffer(source.name(), destination.name(), 0, 0, size.x, size.y, 0, 0, size.x, size.y,
                           GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void fillTargets(const PassDeclaration& pass, RenderTargets& targets, const gl::Framebuffer& framebuffer,
                 const glm::vec4& background) {
    for (std::size_t i = 0; i < pass.writes.size(); ++i) {
        if (pass.writes[i].begin == ColorWrite::Begin::keep) continue;
        const glm::vec4 color = fillColor(pass.writes[i].begin, background);
        glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, static_cast<GLint>(i), &color[0]);
    }
    if (!pass.depth) return;
    if (pass.depth->clear) {
        constexpr float kInfinitelyFar = 0;
        glClearNamedFramebufferfv(framebuffer.name(), GL_DEPTH, 0, &kInfinitelyFar);
    }
    if (pass.depth->copyFrom) copyDepth(*pass.depth->copyFrom, pass.depth->target, targets);
}

/// Every unit that is not declared is left without a texture.
void bindReads(const PassDeclaration& pass, RenderTargets& targets) {
    for (std::size_t unit = 0; unit < kTargetCount; ++unit) {
        const auto target = static_cast<Target>(unit);
        const bool declared = std::find(pass.reads.begin(), pass.reads.end(), target) != pass.reads.end();
        glBindTextureUnit(static_cast<GLuint>(unit), declared ? targets.texture(target).name() : 0);
    }
}

}  // namespace

void checkInterface(const PassDeclaration& pass, const gl::Program& program) {
    std::vector<int> units;
    for (const Target target : pass.reads) units.push_back(static_cast<int>(target));
    std::sort(units.begin(), units.end());
    const std::string name(passName(pass.kind));
    if (program.samplerUnits() != units) {
        throw std::logic_error("pass " + name + ": its shaders read other textures than it declares");
    }
    std::vector<int> outputs(pass.writes.size());
    for (std::size_t i = 0; i < outputs.size(); ++i) outputs[i] = static_cast<int>(i);
    if (program.outputLocations() != outputs) {
        throw std::logic_error("pass " + name + ": its shaders write other outputs than it declares");
    }
}

void PassExecutor::run(std::span<const PassDeclaration> passes, RenderTargets& targets,
                       const glm::vec4& background, DrawRecorder& recorder,
                       std::vector<PassTiming>* timings) {
    checkDataFlow(passes);
    for (const PassDeclaration& pass : passes) {
        if (timings != nullptr) {
            timings->push_back(timed(pass, targets, background, recorder));
        } else {
            runPass(pass, targets, background, recorder);
        }
    }
}

const gl::Program& PassExecutor::program(const PassDeclaration& pass) {
    const std::pair<std::string, std::string> key(pass.vertexShader, pass.fragmentShader);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    gl::Program made(pass.vertexShader, pass.fragmentShader);
    checkInterface(pass, made);
    return programs_.emplace(key, std::move(made)).first->second;
}

void PassExecutor::runPass(const PassDeclaration& pass, RenderTargets& targets, const glm::vec4& background,
                           DrawRecorder& recorder) {
    const gl::Program& shaders = program(pass);
    const DebugGroup group(passName(pass.kind));
    const gl::Framebuffer& framebuffer =
        targets.framebuffer(colorTargets(pass), depthTarget(pass), std::string(passName(pass.kind)));
    // Clearing obeys the write masks.
    state_.apply({.depthWrite = true});
    fillTargets(pass, targets, framebuffer, background);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    const glm::ivec2 size = targets.sizeOf(pass.writes.empty() ? pass.depth->target : pass.writes[0].target);
    glViewport(0, 0, size.x, size.y);
    bindReads(pass, targets);
    glUseProgram(shaders.name());
    recorder.beginPass(pass.state);
    pass.record(recorder);
}

PassTiming PassExecutor::timed(const PassDeclaration& pass, RenderTargets& targets,
                               const glm::vec4& background, DrawRecorder& recorder) {
    const std::string label(passName(pass.kind));
    if (!context_.isSoftware()) {
        const gl::TimerQuery query;
        query.begin();
        runPass(pass, targets, background, recorder);
        query.end();
        return {label, query.milliseconds(), PassTiming::How::gpuTimer};
    }
    glFinish();
    const auto begin = std::chrono::steady_clock::now();
    runPass(pass, targets, background, recorder);
    glFinish();
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - begin;
    return {label, taken.count(), PassTiming::How::serialWallClock};
}

}  // namespace isoglass
