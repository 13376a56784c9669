#include "gl/headless_context.h"

#include "base/error.h"
#include "render_fixture.h"

#include <epoxy/gl.h>

#include <cstdlib>
#include <memory>

namespace isoglass::test {
namespace {

/// Sets ISOGLASS_EGL for the life of the object.
class ForcedPlatform {
  public:
    explicit ForcedPlatform(const char* value) { ::setenv("ISOGLASS_EGL", value, 1); }
    ~ForcedPlatform() {
        if (before_) {
            ::setenv("ISOGLASS_EGL", before_->c_str(), 1);
        } else {
            ::unsetenv("ISOGLASS_EGL");
        }
    }
    ForcedPlatform(const ForcedPlatform&) = delete;
    ForcedPlatform& operator=(const ForcedPlatform&) = delete;

  private:
    static std::optional<std::string> current() {
        const char* value = std::getenv("ISOGLASS_EGL");
        return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
    }
    std::optional<std::string> before_ = current();
};

TEST(HeadlessContext, IsGl45CoreAndSaysWhatItRunsOn) {
    gl::HeadlessContext headless;
    GLint major = 0, minor = 0, profile = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    EXPECT_GE(major * 10 + minor, 45);
    EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_FALSE(headless.context().rendererName().empty());
    EXPECT_FALSE(headless.platform().empty());
    const bool mesaSoftware = headless.context().rendererName().starts_with("llvmpipe");
    EXPECT_EQ(headless.context().isSoftware(), mesaSoftware) << headless.context().rendererName();
}

TEST(HeadlessContext, AForcedPlatformIsUsedOrItsRefusalExplained) {
    for (const char* platform : {"surfaceless", "device", "default"}) {
        const ForcedPlatform forced(platform);
        try {
            gl::HeadlessContext headless;
            EXPECT_NE(headless.platform().find(platform), std::string::npos);
            EXPECT_TRUE(headless.context().debugLog().take().empty());
        } catch (const Error& error) {
            EXPECT_FALSE(error.where().empty()) << platform;
        }
    }
}

TEST(HeadlessContext, AnUnknownPlatformIsAnError) {
    const ForcedPlatform forced("glx");
    try {
        gl::HeadlessContext headless;
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "environment variable ISOGLASS_EGL");
    }
}

TEST(HeadlessContext, EndingOneLeavesALaterOneUsable) {
    auto first = std::make_unique<gl::HeadlessContext>();
    first.reset();
    gl::HeadlessContext second;
    Renderer renderer(second.context());
    renderer.render({.camera = fromAbove(1, {4, 4}), .background = {0.25f, 0.5f, 0.75f}});
    EXPECT_EQ(renderer.readLinear().at(0, 0), glm::vec3(0.25f, 0.5f, 0.75f));
}

}  // namespace
}  // namespace isoglass::test
