#pragma once

#include "gl/objects.h"
#include "render/pass.h"

#include <glm/vec2.hpp>

#include <array>
#include <map>
#include <optional>

namespace isoglass {

/// The textures behind the targets of a frame. Each is made when it is first asked for, and kept until
/// the size changes.
class RenderTargets {
  public:
    /// Forgets all textures where a size differs. The image has `imageSize` pixels, passes before the
    /// resolve draw `supersample` times as many along each axis. Throws Error where that is no size, or
    /// larger than the driver can draw.
    void resize(glm::ivec2 imageSize, int supersample);

    const gl::Texture& texture(Target target);
    bool exists(Target target) const { return textures_[static_cast<std::size_t>(target)].has_value(); }
    static bool isInteger(Target target);
    /// Pixels of a target.
    glm::ivec2 sizeOf(Target target) const;

    /// A framebuffer of these targets; `label` names it in errors.
    const gl::Framebuffer& framebuffer(const std::vector<Target>& colors, std::optional<Target> depth,
                                       const std::string& label);

  private:
    glm::ivec2 imageSize_{0};
    int supersample_ = 1;
    std::array<std::optional<gl::Texture>, kTargetCount> textures_;
    std::map<std::pair<std::vector<Target>, std::optional<Target>>, gl::Framebuffer> framebuffers_;
};

}  // namespace isoglass
