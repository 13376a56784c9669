#include "render/pass_executor.h"

#include "base/error.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
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

/// A target whose pixels the pass draws.
Target drawnTarget(const PassDeclaration& pass) {
    if (!pass.writes.empty()) return pass.writes[0].target;
    return pass.image ? *pass.image : pass.depth->target;
}

glm::vec4 fillColor(Begin begin, const glm::vec4& background) {
    if (begin == Begin::fillBackground) return background;
    return {0, 0, 0, begin == Begin::fillClear ? 1 : 0};
}

void copyDepth(Target from, Target to, RenderTargets& targets) {
    const gl::Framebuffer& source = targets.framebuffer({}, from, "copy of a depth buffer");
    const gl::Framebuffer& destination = targets.framebuffer({}, to, "copy of a depth buffer");
    const glm::ivec2 size = targets.sizeOf(from);
    glBlitNamedFramebuffer(source.name(), destination.name(), 0, 0, size.x, size.y, 0, 0, size.x, size.y,
                           GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void fillZero(const gl::Texture& texture, glm::ivec2 origin, glm::ivec2 size) {
    constexpr GLuint kZero = 0;
    glClearTexSubImage(texture.name(), 0, origin.x, origin.y, 0, size.x, size.y, texture.layers(),
                       GL_RED_INTEGER, GL_UNSIGNED_INT, &kZero);
}

/// Obeys the scissor rectangle.
void fillTargets(const PassDeclaration& pass, RenderTargets& targets, const gl::Framebuffer& framebuffer,
                 const glm::vec4& background) {
    for (std::size_t i = 0; i < pass.writes.size(); ++i) {
        if (pass.writes[i].begin == Begin::keep) continue;
        if (targets.isInteger(pass.writes[i].target)) {
            constexpr std::array<GLuint, 4> kZero{};
            glClearNamedFramebufferuiv(framebuffer.name(), GL_COLOR, static_cast<GLint>(i), kZero.data());
            continue;
        }
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
    const auto check = [&](const std::vector<int>& inShaders, const std::vector<int>& declared,
                           const char* what) {
        if (inShaders == declared) return;
        throw std::logic_error("pass " + passLabel(pass.planned) + ": its shaders " + what +
                               " than it declares");
    };
    std::vector<int> units;
    for (const Target target : pass.reads) units.push_back(static_cast<int>(target));
    std::sort(units.begin(), units.end());
    units.insert(units.end(), pass.volumeUnits.begin(), pass.volumeUnits.end());
    std::vector<int> outputs(pass.writes.size());
    std::iota(outputs.begin(), outputs.end(), 0);
    check(program.samplerUnits(), units, "read other textures");
    check(program.outputLocations(), outputs, "write other outputs");
    check(program.imageUnits(), std::vector<int>(pass.image ? 1 : 0, 0), "use other images");
    check(program.storageBindings(), std::vector<int>(pass.usesLists() ? 1 : 0, FragmentLists::kBinding),
          "use other storage");
}

void PassExecutor::run(std::span<const PassDeclaration> passes, const Frame& frame) {
    checkDataFlow(passes);
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const PassDeclaration& pass = passes[i];
        if (pass.usesLists() && i + 1 < passes.size() && passes[i + 1].usesLists()) {
            runLists(pass, passes[i + 1], frame, {{0, 0}, frame.targets.sizeOf(Target::srgbImage)});
            ++i;
        } else {
            runTimed(pass, frame, {{0, 0}, frame.targets.sizeOf(Target::srgbImage)});
        }
    }
}

void PassExecutor::runLists(const PassDeclaration& build, const PassDeclaration& use, const Frame& frame,
                            const Region& picture) {
    std::vector<Region> todo{picture};
    while (!todo.empty()) {
        const Region region = todo.back();
        lists_.begin();
        runTimed(build, frame, region);
        const std::uint32_t asked = lists_.asked();
        if (asked <= lists_.capacity()) {
            runTimed(use, frame, region);
            todo.pop_back();
        } else if (!lists_.grow(asked)) {
            if (region.size == glm::ivec2(1)) {
                throw Error(std::to_string(asked) + " fragments in one pixel do not fit the memory for lists",
                            "exact composition", "choose another transparency method");
            }
            todo.pop_back();
            const std::vector<Region> parts = split(region, asked / lists_.capacity() + 2);
            todo.insert(todo.end(), parts.begin(), parts.end());
        }
    }
}

/// Strips across the longer side, at least two.
std::vector<PassExecutor::Region> PassExecutor::split(const Region& region, std::uint64_t parts) {
    const int axis = region.size.x > region.size.y ? 0 : 1;
    const int length = region.size[axis];
    const auto count = static_cast<int>(std::min<std::uint64_t>(parts, static_cast<std::uint64_t>(length)));
    std::vector<Region> strips;
    for (int i = 0; i < count; ++i) {
        Region strip = region;
        const int begin = static_cast<int>(std::int64_t{length} * i / count);
        strip.origin[axis] += begin;
        strip.size[axis] = static_cast<int>(std::int64_t{length} * (i + 1) / count) - begin;
        strips.push_back(strip);
    }
    return strips;
}

const gl::Program& PassExecutor::program(const PassDeclaration& pass) {
    const std::tuple key(std::string(pass.vertexShader), std::string(pass.fragmentShader), pass.defines);
    if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
    gl::Program made(pass.vertexShader, pass.fragmentShader, pass.defines);
    checkInterface(pass, made);
    return programs_.emplace(key, std::move(made)).first->second;
}

void PassExecutor::runPass(const PassDeclaration& pass, const Frame& frame, const Region& region) {
    RenderTargets& targets = frame.targets;
    const gl::Program& shaders = program(pass);
    const std::string label = passLabel(pass.planned);
    const DebugGroup group(label);
    const gl::Framebuffer& framebuffer = targets.framebuffer(colorTargets(pass), depthTarget(pass), label);
    const glm::ivec2 size = targets.sizeOf(drawnTarget(pass));
    const int scale = size.x / targets.sizeOf(Target::srgbImage).x;
    const glm::ivec2 origin = region.origin * scale;
    const glm::ivec2 extent = region.size * scale;
    // Clearing obeys the write masks.
    state_.apply({.depthWrite = true});
    glEnable(GL_SCISSOR_TEST);
    glScissor(origin.x, origin.y, extent.x, extent.y);
    fillTargets(pass, targets, framebuffer, frame.background);
    if (pass.image) {
        const gl::Texture& image = targets.texture(*pass.image);
        fillZero(image, origin, extent);
        glBindImageTexture(0, image.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_R32UI);
    }
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer.name());
    glViewport(0, 0, size.x, size.y);
    bindReads(pass, targets);
    if (pass.onlyAroundSurfaces) {
        const Region around = frame.recorder.aroundSurfaces();
        const glm::ivec2 low = glm::max(region.origin, around.origin);
        const glm::ivec2 high = glm::min(region.origin + region.size, around.origin + around.size);
        const glm::ivec2 part = glm::max(high - low, glm::ivec2(0)) * scale;
        glScissor(low.x * scale, low.y * scale, part.x, part.y);
    }
    glUseProgram(shaders.name());
    frame.recorder.beginPass(pass.state);
    pass.record(frame.recorder);
    glDisable(GL_SCISSOR_TEST);
    if (pass.image) glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

void PassExecutor::runTimed(const PassDeclaration& pass, const Frame& frame, const Region& region) {
    if (frame.timings == nullptr) return runPass(pass, frame, region);
    const std::string label = passLabel(pass.planned);
    PassTiming timing{label, 0, PassTiming::How::serialWallClock};
    if (context_.isSoftware()) {
        glFinish();
        const auto begin = std::chrono::steady_clock::now();
        runPass(pass, frame, region);
        glFinish();
        timing.milliseconds =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    } else {
        const gl::TimerQuery query;
        query.begin();
        runPass(pass, frame, region);
        query.end();
        timing.milliseconds = query.milliseconds();
        timing.how = PassTiming::How::gpuTimer;
    }
    const auto known = std::find_if(frame.timings->begin(), frame.timings->end(),
                                    [&](const PassTiming& other) { return other.label == label; });
    if (known == frame.timings->end()) {
        frame.timings->push_back(timing);
    } else {
        known->milliseconds += timing.milliseconds;
    }
}

}  // namespace isoglass
