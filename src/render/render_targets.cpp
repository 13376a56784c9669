#include "render/render_targets.h"

#include "base/error.h"

#include <algorithm>

namespace isoglass {
namespace {

GLenum formatOf(Target target) {
    switch (target) {
        case Target::opaqueColor:
        case Target::composed:
        case Target::layerColor:
        case Target::secondaryShade:
        case Target::linearImage:
            return GL_RGBA32F;
        case Target::opaqueDepth:
        case Target::nearestBackDepth:
        case Target::layerDepthEven:
        case Target::layerDepthOdd:
            return GL_DEPTH_COMPONENT32F;
        case Target::sums:
        case Target::listHeads:
            return GL_R32UI;
        case Target::firstSurface:
        case Target::secondSurface:
            return GL_RG32UI;
        case Target::srgbImage:
            return GL_RGBA8;
    }
    return GL_NONE;
}

int layersOf(Target target) {
    return target == Target::sums ? 5 : 1;
}

std::string text(glm::ivec2 size) {
    return std::to_string(size.x) + "x" + std::to_string(size.y);
}

int largestSide() {
    GLint texture = 0;
    GLint viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    return std::min({texture, viewport[0], viewport[1]});
}

void check(glm::ivec2 imageSize, int supersample) {
    if (imageSize.x < 1 || imageSize.y < 1)
        throw Error("an image of " + text(imageSize) + " pixels", "image");
    const int most = largestSide() / supersample;
    if (std::max(imageSize.x, imageSize.y) > most) {
        throw Error("an image of " + text(imageSize) + " pixels is larger than this driver draws", "image",
                    "stay below " + std::to_string(most) + " pixels a side");
    }
}

}  // namespace

void RenderTargets::resize(glm::ivec2 imageSize, int supersample) {
    if (imageSize == imageSize_ && supersample == supersample_) return;
    check(imageSize, supersample);
    framebuffers_.clear();
    for (auto& texture : textures_) texture.reset();
    imageSize_ = imageSize;
    supersample_ = supersample;
}

bool RenderTargets::isInteger(Target target) {
    const GLenum format = formatOf(target);
    return format == GL_R32UI || format == GL_RG32UI;
}

glm::ivec2 RenderTargets::sizeOf(Target target) const {
    const bool picture = target == Target::linearImage || target == Target::srgbImage;
    return picture ? imageSize_ : imageSize_ * supersample_;
}

const gl::Texture& RenderTargets::texture(Target target) {
    auto& texture = textures_[static_cast<std::size_t>(target)];
    if (!texture) texture.emplace(formatOf(target), sizeOf(target), layersOf(target));
    return *texture;
}

const gl::Framebuffer& RenderTargets::framebuffer(const std::vector<Target>& colors,
                                                  std::optional<Target> depth, const std::string& label) {
    const auto key = std::make_pair(colors, depth);
    if (const auto found = framebuffers_.find(key); found != framebuffers_.end()) return found->second;
    std::vector<const gl::Texture*> attachments;
    for (const Target color : colors) attachments.push_back(&texture(color));
    // Only passes over samples, not pixels, have no target at all.
    gl::Framebuffer made(attachments, depth ? &texture(*depth) : nullptr, label, sizeOf(Target::composed));
    return framebuffers_.emplace(key, std::move(made)).first->second;
}

}  // namespace isoglass
