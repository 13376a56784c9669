#include "gl/context.h"

#include "base/error.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace isoglass::gl {
namespace {

std::string text(GLenum what) {
    const auto* value = reinterpret_cast<const char*>(glGetString(what));
    return value != nullptr ? value : "";
}

bool namesSoftware(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> kSoftware{"llvmpipe", "softpipe", "swrast", "SWR"};
    return std::any_of(kSoftware.begin(), kSoftware.end(), [renderer](std::string_view name) {
        return renderer.find(name) != std::string_view::npos;
    });
}

}  // namespace

Context::Context() : rendererName_(text(GL_RENDERER)), version_(text(GL_VERSION)) {
    if (epoxy_gl_version() < 45) {
        throw Error("OpenGL 4.5 is needed, the driver offers '" + version_ + "'", rendererName_,
                    "install a newer driver, or Mesa's software renderer (libgl1-mesa-dri)");
    }
    isSoftware_ = namesSoftware(rendererName_);
    debugLog_.attach();
}

Context::~Context() {
    debugLog_.detach();
}

}  // namespace isoglass::gl
