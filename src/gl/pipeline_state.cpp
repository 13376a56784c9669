#include "gl/pipeline_state.h"

#include <epoxy/gl.h>

namespace isoglass::gl {
namespace {

void enable(GLenum capability, bool on) {
    on ? glEnable(capability) : glDisable(capability);
}

void setDepthTest(DepthTest test) {
    enable(GL_DEPTH_TEST, test != DepthTest::off);
    glDepthFunc(test == DepthTest::greaterOrEqual ? GL_GEQUAL : GL_GREATER);
}

void setCulling(Culling culling) {
    enable(GL_CULL_FACE, culling != Culling::none);
    glCullFace(culling == Culling::frontFaces ? GL_FRONT : GL_BACK);
}

void setBlend(GLuint target, Blend blend) {
    if (blend == Blend::replace) return glDisablei(GL_BLEND, target);
    glEnablei(GL_BLEND, target);
    if (blend == Blend::add) return glBlendFunci(target, GL_ONE, GL_ONE);
    if (blend == Blend::cover) return glBlendFunci(target, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    const GLenum source = blend == Blend::under ? GL_DST_ALPHA : GL_ONE;
    const GLenum destination = blend == Blend::over ? GL_ONE_MINUS_SRC_ALPHA : GL_ONE;
    glBlendFuncSeparatei(target, source, destination, GL_ZERO, GL_ONE_MINUS_SRC_ALPHA);
}

void setColorWrite(bool on) {
    const GLboolean mask = on ? GL_TRUE : GL_FALSE;
    glColorMask(mask, mask, mask, mask);
}

void setWireframe(bool on) {
    glPolygonMode(GL_FRONT_AND_BACK, on ? GL_LINE : GL_FILL);
}

}  // namespace

StateCache::StateCache() {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_DITHER);
    setDepthTest(current_.depthTest);
    glDepthMask(current_.depthWrite ? GL_TRUE : GL_FALSE);
    setCulling(current_.culling);
    glFrontFace(current_.frontIsClockwise ? GL_CW : GL_CCW);
    for (GLuint i = 0; i < PipelineState::kMaxTargets; ++i) setBlend(i, current_.blend[i]);
    setColorWrite(current_.colorWrite);
    setWireframe(current_.wireframe);
}

int StateCache::apply(const PipelineState& state) {
    int changes = 0;
    const auto differs = [&changes](const auto& before, const auto& after) {
        changes += before != after;
        return before != after;
    };
    if (differs(current_.depthTest, state.depthTest)) setDepthTest(state.depthTest);
    if (differs(current_.depthWrite, state.depthWrite)) glDepthMask(state.depthWrite ? GL_TRUE : GL_FALSE);
    if (differs(current_.culling, state.culling)) setCulling(state.culling);
    if (differs(current_.frontIsClockwise, state.frontIsClockwise)) {
        glFrontFace(state.frontIsClockwise ? GL_CW : GL_CCW);
    }
    for (GLuint i = 0; i < PipelineState::kMaxTargets; ++i) {
        if (differs(current_.blend[i], state.blend[i])) setBlend(i, state.blend[i]);
    }
    if (differs(current_.colorWrite, state.colorWrite)) setColorWrite(state.colorWrite);
    if (differs(current_.wireframe, state.wireframe)) setWireframe(state.wireframe);
    current_ = state;
    return changes;
}

}  // namespace isoglass::gl
