#include "base/error.h"
#include "gl/objects.h"
#include "render_fixture.h"

#include <array>
#include <optional>
#include <type_traits>

namespace isoglass::test {
namespace {

using GlObjects = GlTest;

static_assert(!std::is_copy_constructible_v<gl::Buffer> && std::is_nothrow_move_constructible_v<gl::Buffer>);

TEST_F(GlObjects, AnObjectLivesAsLongAsItsOwner) {
    GLuint name = 0;
    {
        std::optional<gl::Buffer> first(gl::Buffer::updatable(4));
        name = first->name();
        gl::Buffer second(std::move(*first));
        first.reset();
        EXPECT_EQ(second.name(), name);
        EXPECT_TRUE(glIsBuffer(name));
    }
    EXPECT_FALSE(glIsBuffer(name));
}

TEST_F(GlObjects, ABufferHoldsWhatWasWritten) {
    const std::array<float, 3> before{1, 2, 3};
    const gl::Buffer fixed = gl::Buffer::immutable(std::as_bytes(std::span(before)));
    const gl::Buffer variable = gl::Buffer::updatable(sizeof before);
    variable.write(4, std::as_bytes(std::span(before)).first(8));
    std::array<float, 3> after{};
    glGetNamedBufferSubData(fixed.name(), 0, sizeof after, after.data());
    EXPECT_EQ(after, before);
    glGetNamedBufferSubData(variable.name(), 4, 8, after.data());
    EXPECT_EQ(after[1], 2);
    EXPECT_EQ(fixed.bytes(), sizeof before);
}

TEST_F(GlObjects, AnEmptyBufferIsNoError) {
    const gl::Buffer buffer = gl::Buffer::immutable({});
    EXPECT_EQ(buffer.bytes(), 0u);
}

TEST_F(GlObjects, AnIncompleteFramebufferIsAnErrorWithItsLabel) {
    const gl::Texture large(GL_RGBA32F, {8, 8});
    const gl::Texture depthAsColor(GL_DEPTH_COMPONENT32F, {8, 8});
    const std::array<const gl::Texture*, 1> colors{&depthAsColor};
    try {
        const gl::Framebuffer framebuffer(colors, nullptr, "broken");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.where(), "broken");
    }
    // Some drivers complain of the attachment, too.
    context_.debugLog().take();
}

}  // namespace
}  // namespace isoglass::test
