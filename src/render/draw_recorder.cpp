#include "render/draw_recorder.h"

#include "render/uniforms.h"

#include <glm/ext/matrix_transform.hpp>

#include <cstring>
#include <span>

namespace isoglass {
namespace {

std::size_t roundedUp(std::size_t value, std::size_t step) {
    return (value + step - 1) / step * step;
}

std::size_t uniformStride() {
    GLint alignment = 1;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    return roundedUp(sizeof(DrawUniforms), static_cast<std::size_t>(alignment));
}

Bounds boundsWorld(const GpuMesh& mesh, const glm::dmat4& worldFromSeries) {
    return transformed(glm::translate(worldFromSeries, mesh.origin), mesh.bounds);
}

std::vector<const SurfaceDraw*> visibleDraws(const FrameDescription& frame, const MeshStore& meshes) {
    std::vector<const SurfaceDraw*> visible;
    for (const SurfaceDraw& draw : frame.draws) {
        if (meshes.get(draw.mesh).indexCount > 0 && draw.opacity > 0) visible.push_back(&draw);
    }
    return visible;
}

glm::dmat4 clipFromEyeFor(const FrameDescription& frame, const std::vector<const SurfaceDraw*>& visible,
                          const MeshStore& meshes) {
    std::optional<Bounds> drawn;
    for (const SurfaceDraw* draw : visible) {
        const Bounds bounds = boundsWorld(meshes.get(draw->mesh), draw->worldFromSeries);
        if (drawn) {
            drawn->include(bounds);
        } else {
            drawn = bounds;
        }
    }
    return clipFromEye(frame.camera, nearDistance(frame.camera, drawn));
}

DrawUniforms drawUniforms(const MeshMatrices& matrices, const SurfaceDraw& draw) {
    DrawUniforms uniforms{matrices.clipFromMesh, matrices.eyeFromMesh, {}, {draw.color, draw.opacity}};
    for (int column = 0; column < 3; ++column) {
        uniforms.normalFromMesh[static_cast<std::size_t>(column)] =
            glm::vec4(matrices.normalFromMesh[column], 0);
    }
    return uniforms;
}

}  // namespace

DrawRecorder::DrawRecorder(gl::StateCache& state)
    : state_(state),
      uniformStride_(uniformStride()),
      frameUniforms_(gl::Buffer::updatable(sizeof(FrameUniforms))) {}

void DrawRecorder::prepare(const FrameDescription& frame, const MeshStore& meshes) {
    opaque_.clear();
    semiTransparent_.clear();
    const std::vector<const SurfaceDraw*> visible = visibleDraws(frame, meshes);
    const glm::dmat4 fromEye = clipFromEyeFor(frame, visible, meshes);
    std::vector<std::byte> bytes(visible.size() * uniformStride_);
    std::size_t offset = 0;
    for (const SurfaceDraw* draw : visible) {
        const GpuMesh& mesh = meshes.get(draw->mesh);
        const MeshMatrices matrices =
            meshMatrices(fromEye, frame.camera.eye, draw->worldFromSeries, mesh.origin);
        const DrawUniforms uniforms = drawUniforms(matrices, *draw);
        std::memcpy(bytes.data() + offset, &uniforms, sizeof uniforms);
        auto& list = draw->opacity >= 1 ? opaque_ : semiTransparent_;
        list.push_back({&mesh, offset, matrices.mirrored});
        offset += uniformStride_;
    }
    uploadUniforms(bytes);
    const Lighting& lighting = frame.lighting;
    const FrameUniforms shared{.ambient = lighting.ambient,
                               .diffuse = lighting.diffuse,
                               .specular = lighting.specular,
                               .shininess = lighting.shininess,
                               .exposure = frame.exposure,
                               .supersample = frame.supersample};
    frameUniforms_.write(0, std::as_bytes(std::span(&shared, 1)));
    glBindBufferBase(GL_UNIFORM_BUFFER, FrameUniforms::kBinding, frameUniforms_.name());
}

void DrawRecorder::uploadUniforms(const std::vector<std::byte>& bytes) {
    if (bytes.empty()) return;
    if (!uniforms_ || uniforms_->bytes() < bytes.size()) uniforms_ = gl::Buffer::updatable(bytes.size());
    uniforms_->write(0, bytes);
}

void DrawRecorder::beginPass(const gl::PipelineState& state) {
    passState_ = state;
    state_.apply(state);
}

void DrawRecorder::draw(const std::vector<PreparedDraw>& draws) {
    gl::PipelineState state = passState_;
    for (const PreparedDraw& draw : draws) {
        state.frontIsClockwise = draw.mirrored;
        state_.apply(state);
        glBindBufferRange(GL_UNIFORM_BUFFER, DrawUniforms::kBinding, uniforms_->name(),
                          static_cast<GLintptr>(draw.uniformOffset), sizeof(DrawUniforms));
        glBindVertexArray(draw.mesh->vertexArray.name());
        glDrawElements(GL_TRIANGLES, draw.mesh->indexCount, GL_UNSIGNED_INT, nullptr);
    }
}

void DrawRecorder::drawFullScreen() {
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace isoglass
