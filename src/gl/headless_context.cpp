#include "gl/headless_context.h"

#include "base/error.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace isoglass::gl {
namespace {

struct Candidate {
    std::string label;
    EGLenum platform;  ///< EGL_NONE takes the default display
    void* native;      ///< what the platform wants as its native display
    bool hardwareOnly;
};

/// An attempt that failed; the reason goes on the list of what was tried.
struct Refused {
    std::string reason;
};

bool hasClientExtension(const char* name) {
    return epoxy_has_egl_extension(EGL_NO_DISPLAY, name);
}

std::string eglErrorText() {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04X", static_cast<unsigned>(eglGetError()));
    return std::string("EGL error ") + text;
}

std::vector<Candidate> deviceCandidates(bool hardwareOnly) {
    std::vector<Candidate> candidates;
    if (!hasClientExtension("EGL_EXT_platform_device")) return candidates;
    if (!hasClientExtension("EGL_EXT_device_enumeration") && !hasClientExtension("EGL_EXT_device_base")) {
        return candidates;
    }
    EGLint count = 0;
    if (!eglQueryDevicesEXT(0, nullptr, &count) || count <= 0) return candidates;
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (!eglQueryDevicesEXT(count, devices.data(), &count)) return candidates;
    for (EGLint i = 0; i < count; ++i) {
        candidates.push_back({"EGL device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT,
                              devices[static_cast<std::size_t>(i)], hardwareOnly});
    }
    return candidates;
}

std::vector<Candidate> surfacelessCandidates() {
    if (!hasClientExtension("EGL_MESA_platform_surfaceless")) return {};
    return {{"EGL surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, false}};
}

std::vector<Candidate> defaultCandidates() {
    return {{"EGL default display", EGL_NONE, EGL_DEFAULT_DISPLAY, false}};
}

std::vector<Candidate> candidatesFor(std::string_view forced) {
    if (forced == "surfaceless") return surfacelessCandidates();
    if (forced == "device") return deviceCandidates(false);
    if (forced == "default") return defaultCandidates();
    if (!forced.empty()) {
        throw Error("unknown EGL platform '" + std::string(forced) + "'", "environment variable ISOGLASS_EGL",
                    "use surfaceless, device or default, or unset it");
    }
    std::vector<Candidate> all = deviceCandidates(true);
    for (const auto& more : {surfacelessCandidates(), defaultCandidates(), deviceCandidates(false)}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

std::string forcedPlatform() {
    const char* value = std::getenv("ISOGLASS_EGL");
    return value != nullptr ? value : "";
}

}  // namespace

/// Display and context. The display is never terminated: EGL hands the same one to every context of the
/// process, and terminating it would end the others.
struct HeadlessContext::Egl {
    EGLDisplay display = EGL_NO_DISPLAY;
    EGLContext context = EGL_NO_CONTEXT;

    explicit Egl(const Candidate& candidate) {
        openDisplay(candidate);
        create();
        if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
            const std::string reason = eglErrorText();
            eglDestroyContext(display, context);
            throw Refused{"cannot make the context current: " + reason};
        }
    }
    ~Egl() {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display, context);
    }
    Egl(const Egl&) = delete;
    Egl& operator=(const Egl&) = delete;

  private:
    void openDisplay(const Candidate& candidate) {
        display = candidate.platform == EGL_NONE
                      ? eglGetDisplay(EGL_DEFAULT_DISPLAY)
                      : eglGetPlatformDisplayEXT(candidate.platform, candidate.native, nullptr);
        if (display == EGL_NO_DISPLAY) throw Refused{"no display"};
        if (!eglInitialize(display, nullptr, nullptr)) throw Refused{"cannot initialise: " + eglErrorText()};
        if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
            throw Refused{"no EGL_KHR_surfaceless_context"};
        }
    }

    void create() {
        if (!eglBindAPI(EGL_OPENGL_API)) throw Refused{"no desktop OpenGL"};
        // Any surface type will do: the default asks for windows, which a headless display has not.
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint found = 0;
        if (!eglChooseConfig(display, wanted, &config, 1, &found) || found == 0) {
            throw Refused{"no configuration for desktop OpenGL"};
        }
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     4,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     5,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_CONTEXT_OPENGL_DEBUG,
                                     EGL_TRUE,
                                     EGL_NONE};
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
        if (context == EGL_NO_CONTEXT) throw Refused{"no OpenGL 4.5 core context: " + eglErrorText()};
    }
};

HeadlessContext::HeadlessContext() {
    if (!epoxy_has_egl()) {
        throw Error("the EGL library is missing", "libEGL.so.1", "install libegl1 and libgl1-mesa-dri");
    }
    std::string tried;
    for (const Candidate& candidate : candidatesFor(forcedPlatform())) {
        try {
            egl_ = std::make_unique<Egl>(candidate);
            context_ = std::make_unique<Context>();
            if (candidate.hardwareOnly && context_->isSoftware()) throw Refused{"a software renderer"};
            platform_ = candidate.label;
            return;
        } catch (const Refused& refused) {
            tried += (tried.empty() ? "" : "; ") + candidate.label + ": " + refused.reason;
        } catch (const Error& error) {
            tried += (tried.empty() ? "" : "; ") + candidate.label + ": " + error.what();
        }
        context_.reset();
        egl_.reset();
    }
    throw Error("no headless OpenGL 4.5 context", tried.empty() ? "EGL offers no such platform" : tried,
                "install a GPU driver with EGL, or Mesa's software renderer (libegl1, libgl1-mesa-dri)");
}

HeadlessContext::~HeadlessContext() {
    context_.reset();
    egl_.reset();
}

}  // namespace isoglass::gl
