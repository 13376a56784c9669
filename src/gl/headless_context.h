#pragma once

#include "gl/current_context.h"

#include <memory>
#include <string>

namespace isoglass::gl {

/// A GL 4.5 core context without window or display server, through EGL.
///
/// Tried in order: each EGL device that gives a hardware context (EGL_EXT_platform_device), Mesa's
/// surfaceless platform, the default display, any EGL device. The environment variable ISOGLASS_EGL
/// (surfaceless, device, default) leaves one of them. The context has no surface: draw into framebuffers.
class HeadlessContext final : public CurrentContext {
  public:
    /// Throws Error that says what was tried and what each attempt answered.
    HeadlessContext();
    ~HeadlessContext() override;

    Context& context() override { return *context_; }
    /// Which platform gave the context, e.g. "EGL surfaceless" or "EGL device 0".
    const std::string& platform() const { return platform_; }

  private:
    struct Egl;
    std::unique_ptr<Egl> egl_;
    std::string platform_;
    std::unique_ptr<Context> context_;
};

}  // namespace isoglass::gl
