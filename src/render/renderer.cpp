#include "render/renderer.h"

#include <algorithm>
#include <stdexcept>

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

}  // namespace

Renderer::Renderer(gl::Context& context)
    : context_(context), meshes_(context), recorder_(state_), executor_(context, state_) {}

void Renderer::render(const FrameDescription& frame) {
    timings_.clear();
    targets_.resize(frame.camera.size, frame.supersample);
    recorder_.prepare(frame, meshes_);
    plan_ = planFrame({.opaqueSurfaces = recorder_.opaqueCount(),
                       .semiTransparentSurfaces = recorder_.semiTransparentCount(),
                       .method = frame.method,
                       .separatePasses = frame.separatePasses});
    std::vector<PassDeclaration> passes = declarePasses(plan_);
    if (frame.wireframe) drawWireframe(passes);
    const glm::vec4 background(frame.background * frame.backgroundOpacity, frame.backgroundOpacity);
    executor_.run(passes, targets_, background, recorder_, timing_ ? &timings_ : nullptr);
    context_.debugLog().throwIfAny("frame");
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
    return readBack<glm::vec3>(context_, targets_, Target::linearImage, GL_RGB, GL_FLOAT);
}

Image Renderer::readSrgb() {
    return readBack<Rgba8>(context_, targets_, Target::srgbImage, GL_RGBA, GL_UNSIGNED_BYTE);
}

DepthImage Renderer::readDepth() {
    return readBack<float>(context_, targets_, Target::opaqueDepth, GL_DEPTH_COMPONENT, GL_FLOAT);
}

}  // namespace isoglass
