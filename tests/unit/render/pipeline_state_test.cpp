#include "gl/pipeline_state.h"

#include "render_fixture.h"

#include <epoxy/gl.h>

#include <random>

namespace isoglass::test {
namespace {

using gl::Blend;
using gl::Culling;
using gl::DepthTest;
using gl::PipelineState;

using StateCacheTest = GlTest;

GLint integer(GLenum what) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

void expectGlHas(const PipelineState& state) {
    EXPECT_EQ(glIsEnabled(GL_DEPTH_TEST), state.depthTest != DepthTest::off);
    if (state.depthTest != DepthTest::off) {
        EXPECT_EQ(integer(GL_DEPTH_FUNC), state.depthTest == DepthTest::greater ? GL_GREATER : GL_GEQUAL);
    }
    EXPECT_EQ(integer(GL_DEPTH_WRITEMASK), state.depthWrite);
    EXPECT_EQ(glIsEnabled(GL_CULL_FACE), state.culling != Culling::none);
    if (state.culling != Culling::none) {
        EXPECT_EQ(integer(GL_CULL_FACE_MODE), state.culling == Culling::frontFaces ? GL_FRONT : GL_BACK);
    }
    EXPECT_EQ(integer(GL_FRONT_FACE), state.frontIsClockwise ? GL_CW : GL_CCW);
    for (GLuint i = 0; i < PipelineState::kMaxTargets; ++i) {
        EXPECT_EQ(glIsEnabledi(GL_BLEND, i), state.blend[i] != Blend::replace) << "target " << i;
        if (state.blend[i] == Blend::replace) continue;
        const bool add = state.blend[i] == Blend::add;
        const bool cover = state.blend[i] == Blend::cover;
        const auto has = [i](GLenum what, GLint factor) {
            GLint value = 0;
            glGetIntegeri_v(what, i, &value);
            EXPECT_EQ(value, factor) << "target " << i;
        };
        has(GL_BLEND_SRC_RGB, state.blend[i] == Blend::under ? GL_DST_ALPHA : GL_ONE);
        has(GL_BLEND_DST_RGB, state.blend[i] == Blend::over || cover ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE);
        has(GL_BLEND_SRC_ALPHA, add || cover ? GL_ONE : GL_ZERO);
        has(GL_BLEND_DST_ALPHA, add ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    }
    GLboolean mask[4];
    glGetBooleanv(GL_COLOR_WRITEMASK, mask);
    for (const GLboolean channel : mask) EXPECT_EQ(channel, state.colorWrite);
    GLint polygonMode[2] = {};
    glGetIntegerv(GL_POLYGON_MODE, polygonMode);
    EXPECT_EQ(polygonMode[0], state.wireframe ? GL_LINE : GL_FILL);
}

PipelineState randomState(std::mt19937& random) {
    const auto pick = [&random](unsigned count) { return random() % count; };
    PipelineState state;
    state.depthTest = static_cast<DepthTest>(pick(3));
    state.depthWrite = pick(2) != 0;
    state.culling = static_cast<Culling>(pick(3));
    state.frontIsClockwise = pick(2) != 0;
    for (Blend& blend : state.blend) blend = static_cast<Blend>(pick(6));
    state.colorWrite = pick(2) != 0;
    state.wireframe = pick(2) != 0;
    return state;
}

TEST_F(StateCacheTest, GlHasTheStateAfterAnySequence) {
    gl::StateCache cache;
    expectGlHas({});
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const PipelineState state = randomState(random);
        cache.apply(state);
        expectGlHas(state);
    }
}

TEST_F(StateCacheTest, OnlyDifferencesAreSent) {
    gl::StateCache cache;
    PipelineState state;
    EXPECT_EQ(cache.apply(state), 0);
    state.depthTest = DepthTest::greater;
    state.blend[1] = Blend::add;
    EXPECT_EQ(cache.apply(state), 2);
    EXPECT_EQ(cache.apply(state), 0);
}

TEST_F(StateCacheTest, DepthRunsFromZeroToOneAndNothingIsDithered) {
    const gl::StateCache cache;
    EXPECT_EQ(integer(GL_CLIP_DEPTH_MODE), GL_ZERO_TO_ONE);
    EXPECT_FALSE(glIsEnabled(GL_DITHER));
}

}  // namespace
}  // namespace isoglass::test
