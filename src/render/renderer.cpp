#include "render/renderer.h"

#include "base/error.h"
#include "render/sample_positions.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace isoglass {
namespace {

/// GL's rows go upwards.
template <typename Pixel>
void flipRows(Raster<Pixel>& raster) {
    const auto width = static_cast<std::ptrdiff_t>(raster.size.x);
    for (int y = 0; y < raster.size.y / 2; ++y) {
        const auto top = raster.pixels.begin() + y * width;
        const auto bottom = raster.pixels.begin() + (raster.size.y - 1 - y) * width;
        std::swap_ranges(top, top + width, bottom);
    }
}

template <typename Pixel>
Raster<Pixel> readBack(gl::Context& context, RenderTargets& targets, Target target, GLenum format,
                       GLenum type) {
    if (!targets.exists(target)) throw std::logic_error("nothing was rendered yet");
    Raster<Pixel> raster{targets.sizeOf(target), {}};
    raster.pixels.resize(static_cast<std::size_t>(raster.size.x) * static_cast<std::size_t>(raster.size.y));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(targets.texture(target).name(), 0, format, type,
                      static_cast<GLsizei>(raster.pixels.size() * sizeof(Pixel)), raster.pixels.data());
    context.debugLog().throwIfAny("read-back");
    flipRows(raster);
    return raster;
}

/// Replaces a part of the picture.
void cover(const Overlay& overlay, RenderTargets& targets) {
    Image image = overlay.image;
    flipRows(image);
    const glm::ivec2 size = targets.sizeOf(Target::srgbImage);
    glTextureSubImage2D(targets.texture(Target::srgbImage).name(), 0, overlay.at.x,
                        size.y - overlay.at.y - image.size.y, image.size.x, image.size.y, GL_RGBA,
                        GL_UNSIGNED_BYTE, image.pixels.data());
}

void checkCount(int count, int most, const char* what) {
    if (count >= 1 && count <= most) return;
    throw Error(std::to_string(count) + " " + what, "image", "choose 1 to " + std::to_string(most));
}

void check(const FrameDescription& frame) {
    checkCount(frame.samples, kMostSamples, "samples a pixel");
    checkCount(frame.layers, kMostLayers, "layers to peel");
    if (frame.illustration.has_value() + frame.layerDraw.has_value() + frame.shadedDraw.has_value() > 1)
        throw std::invalid_argument("a frame has one style");
}

}  // namespace

Renderer::Renderer(gl::Context& context)
    : context_(context), meshes_(context), volumes_(context), recorder_(state_), executor_(context, state_) {}

FramePlan Renderer::planOf(const FrameDescription& frame) {
    check(frame);
    recorder_.prepare(frame, meshes_, volumes_);
    return planFrame({.opaqueSurfaces = recorder_.opaqueCount(),
                      .semiTransparentSurfaces = recorder_.semiTransparentCount(),
                      .layerStyle = frame.layerDraw.has_value(),
                      .shadedVolume = frame.shadedDraw.has_value(),
                      .illustrative = frame.illustration.has_value(),
                      .primarySurfaces = recorder_.primaryCount(),
                      .secondarySurfaces = recorder_.secondaryCount(),
                      .betweenKeyFrames = (frame.layerDraw && frame.layerDraw->fraction > 0) ||
                                          (frame.shadedDraw && frame.shadedDraw->fraction > 0),
                      .method = frame.method,
                      .layers = frame.layers,
                      .reproducible = frame.reproducible,
                      .exactWanted = frame.exactWanted,
                      .overlapImpossible = recorder_.overlapImpossible(),
                      .samples = frame.samples,
                      .keepLinear = frame.keepLinear});
}

void Renderer::render(const FrameDescription& frame) {
    render(frame, planOf(frame));
}

void Renderer::render(const FrameDescription& frame, const FramePlan& plan) {
    check(frame);
    timings_.clear();
    shown_.reset();
    plan_ = plan;
    targets_.resize(frame.camera.size, plan_.supersample);
    recorder_.prepare(frame, meshes_, volumes_);
    const LinearColor background = frame.illustration ? frame.illustration->paper : frame.background;
    const PassExecutor::Frame parts{
        .targets = targets_,
        .recorder = recorder_,
        .background = {background * frame.backgroundOpacity, frame.backgroundOpacity},
        .timings = timing_ ? &timings_ : nullptr};
    for (int i = 0; i < plan_.subframes; ++i) {
        recorder_.upload(samplePosition(i, plan_.subframes) / double(plan_.supersample), plan_.subframes);
        std::vector<PassDeclaration> passes = declarePasses(plan_, i);
        specialize(passes, recorder_.volumeVariant());
        if (frame.wireframe) drawWireframe(passes);
        executor_.run(passes, parts);
    }
    for (const Overlay& overlay : frame.overlays) cover(overlay, targets_);
    context_.debugLog().throwIfAny("frame");
    drawnSubframes_ = plan_.subframes;
    drewOpaque_ = plan_.runs(PassKind::opaque);
    shown_ = frame;
}

bool Renderer::renderIfChanged(const FrameDescription& frame) {
    if (shown_ != frame) {
        render(frame);
        return true;
    }
    timings_.clear();
    plan_ = planFrame({.unchanged = true});
    return false;
}

glm::ivec2 Renderer::copyToWindow() {
    if (!targets_.exists(Target::srgbImage)) throw std::logic_error("nothing was rendered yet");
    const glm::ivec2 size = targets_.sizeOf(Target::srgbImage);
    const gl::Framebuffer& image = targets_.framebuffer({Target::srgbImage}, {}, "copy to the window");
    constexpr GLuint kWindow = 0;
    glBlitNamedFramebuffer(image.name(), kWindow, 0, 0, size.x, size.y, 0, 0, size.x, size.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    context_.debugLog().throwIfAny("copy to the window");
    return size;
}

LinearImage Renderer::readLinear() {
    if (!shown_ || !shown_->keepLinear) throw std::logic_error("the linear image was not kept");
    LinearImage image = readBack<glm::vec3>(context_, targets_, Target::linearImage, GL_RGB, GL_FLOAT);
    const float share = 1 / static_cast<float>(drawnSubframes_);
    for (glm::vec3& pixel : image.pixels) pixel *= share;
    return image;
}

Image Renderer::readSrgb() {
    return readBack<Rgba8>(context_, targets_, Target::srgbImage, GL_RGBA, GL_UNSIGNED_BYTE);
}

Raster<glm::vec4> Renderer::readFloats(Target target) {
    return readBack<glm::vec4>(context_, targets_, target, GL_RGBA, GL_FLOAT);
}

Raster<glm::uvec2> Renderer::readIntegers(Target target) {
    return readBack<glm::uvec2>(context_, targets_, target, GL_RG_INTEGER, GL_UNSIGNED_INT);
}

DepthImage Renderer::readDepth() {
    if (shown_ && !drewOpaque_) {
        const glm::ivec2 size = targets_.sizeOf(Target::opaqueDepth);
        return {size,
                std::vector<float>(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y))};
    }
    return readBack<float>(context_, targets_, Target::opaqueDepth, GL_DEPTH_COMPONENT, GL_FLOAT);
}

}  // namespace isoglass
