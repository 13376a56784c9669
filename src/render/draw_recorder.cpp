#include "render/draw_recorder.h"

#include "render/uniforms.h"
#include "scene/color_map.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <span>

namespace isoglass {
namespace {

constexpr int kNoLayerLimit = std::numeric_limits<int>::max();

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
        if (meshes.get(draw.mesh).indexCount > 0 && draw.visible()) visible.push_back(&draw);
    }
    return visible;
}

/// Of a surface's mesh, or of what it may move in.
Bounds drawnBounds(const SurfaceDraw& draw, const MeshStore& meshes) {
    return draw.boundsSeries ? transformed(draw.worldFromSeries, *draw.boundsSeries)
                             : boundsWorld(meshes.get(draw.mesh), draw.worldFromSeries);
}

double nearDistanceFor(const FrameDescription& frame, const std::vector<const SurfaceDraw*>& visible,
                       const MeshStore& meshes) {
    std::optional<Bounds> drawn;
    for (const SurfaceDraw* draw : visible) {
        const Bounds bounds = drawnBounds(*draw, meshes);
        if (drawn) {
            drawn->include(bounds);
        } else {
            drawn = bounds;
        }
    }
    return nearDistance(frame.camera, drawn);
}

/// Of where a box may be seen, with a pixel around it; all of the picture where it reaches the eye.
PictureRegion seenRegion(const FrameDescription& frame, const Bounds& box, double near) {
    const PictureRegion whole{{0, 0}, frame.camera.size};
    const ViewAxes axes = viewAxes(frame.camera);
    const glm::dmat4 fromEye = clipFromEye(frame.camera, near);
    glm::dvec2 low(1), high(-1);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                            corner & 4 ? box.high.z : box.low.z);
        const glm::dvec3 fromEyeTo = at - frame.camera.eye;
        if (glm::dot(fromEyeTo, axes.forward) < near) return whole;
        const glm::dvec4 clip = fromEye * glm::dvec4(fromEyeTo, 1);
        low = glm::min(low, glm::dvec2(clip) / clip.w);
        high = glm::max(high, glm::dvec2(clip) / clip.w);
    }
    const glm::dvec2 size(frame.camera.size);
    const auto pixel = [&](const glm::dvec2& clip) {
        return glm::clamp((clip + 1.0) / 2.0, 0.0, 1.0) * size;
    };
    const glm::ivec2 first = glm::max(glm::ivec2(pixel(low)) - 2, 0);
    const glm::ivec2 last = glm::min(glm::ivec2(pixel(high)) + 2, frame.camera.size - 1);
    return {first, last - first + 1};
}

void setShell(const PreparedShell& prepared, float gradientScale, DrawUniforms& uniforms) {
    uniforms.opacityModel = 1 + static_cast<int>(prepared.shell.model);
    uniforms.extinction = prepared.shell.extinction;
    uniforms.thickness = prepared.shell.thickness;
    uniforms.isoWidth = prepared.shell.isoWidth;
    uniforms.maxThickness = prepared.shell.maxThickness;
    uniforms.cosinePower = static_cast<float>(prepared.fit.power);
    uniforms.cosineOffset = static_cast<float>(prepared.fit.offset);
    uniforms.gradientScale = gradientScale;
}

DrawUniforms drawUniforms(const MeshMatrices& matrices, const SurfaceDraw& draw) {
    DrawUniforms uniforms{};
    uniforms.clipFromMesh = matrices.clipFromMesh;
    uniforms.eyeFromMesh = matrices.eyeFromMesh;
    uniforms.colorOpacity = {draw.color, draw.opacity};
    uniforms.depthScale = 1 + static_cast<float>(draw.depthRank) * 0x1p-14f;
    uniforms.motion = draw.motion;
    uniforms.motionLimit = draw.motionLimit;
    if (draw.colorBar) {
        uniforms.colorByValue = 1;
        uniforms.colorLow = static_cast<float>(draw.colorBar->low);
        uniforms.colorScale = static_cast<float>(1 / (draw.colorBar->high - draw.colorBar->low));
    }
    if (draw.shell) setShell(*draw.shell, matrices.gradientScale, uniforms);
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
      frameUniforms_(gl::Buffer::updatable(sizeof(FrameUniforms))),
      illustrationUniforms_(gl::Buffer::updatable(sizeof(IllustrationUniforms))) {}

std::vector<DrawRecorder::PreparedDraw>& DrawRecorder::listOf(const SurfaceDraw& draw) {
    if (frame_.illustration) return draw.secondary ? secondary_ : primary_;
    return draw.opaque() ? opaque_ : semiTransparent_;
}

void DrawRecorder::prepare(const FrameDescription& frame, const MeshStore& meshes,
                           const VolumeStore& volumes) {
    frame_ = frame;
    volume_.prepare(frame.layerDraw, frame.shadedDraw, volumes);
    meshes_ = &meshes;
    visible_ = visibleDraws(frame_, meshes);
    for (auto* list : {&opaque_, &semiTransparent_, &primary_, &secondary_}) list->clear();
    std::size_t offset = 0;
    for (const SurfaceDraw* draw : visible_) {
        const bool mirrored = glm::determinant(glm::dmat3(draw->worldFromSeries)) < 0;
        const std::size_t map = draw->colorBar ? draw->colorBar->map : 0;
        listOf(*draw).push_back({&meshes.get(draw->mesh), offset, mirrored, map});
        offset += uniformStride_;
    }
}

bool DrawRecorder::overlapImpossible() const {
    return semiTransparent_.size() == 1 && semiTransparent_.front().mesh->flat;
}

void DrawRecorder::upload(glm::dvec2 shiftPixels, int subframes) {
    const double near = nearDistanceFor(frame_, visible_, *meshes_);
    glm::dmat4 fromEye = clipFromEye(frame_.camera, near);
    // What a sample sees moves against the sample; a pixel is 2/size wide in clip space.
    const glm::dvec2 shift = -2.0 * shiftPixels / glm::dvec2(frame_.camera.size);
    for (int column = 0; column < 4; ++column) {
        fromEye[column].x += shift.x * fromEye[column].w;
        fromEye[column].y += shift.y * fromEye[column].w;
    }
    volume_.upload(frame_.camera, shift, near);
    std::vector<std::byte> bytes(visible_.size() * uniformStride_);
    for (std::size_t i = 0; i < visible_.size(); ++i) {
        const SurfaceDraw& draw = *visible_[i];
        const DrawUniforms uniforms = drawUniforms(
            meshMatrices(fromEye, frame_.camera.eye, draw.worldFromSeries, meshes_->get(draw.mesh).origin),
            draw);
        std::memcpy(bytes.data() + i * uniformStride_, &uniforms, sizeof uniforms);
    }
    uploadUniforms(bytes);
    uploadFrameUniforms(subframes);
    if (!frame_.illustration) return;
    uploadIllustration(shiftPixels);
    aroundSurfaces_ = regionOf(near);
}

void DrawRecorder::uploadFrameUniforms(int subframes) {
    const Lighting& lighting = frame_.lighting;
    const FrameUniforms shared{
        .background = {frame_.background * frame_.backgroundOpacity, frame_.backgroundOpacity},
        .ambient = lighting.ambient,
        .diffuse = lighting.diffuse,
        .specular = lighting.specular,
        .shininess = lighting.shininess,
        .exposure = frame_.exposure,
        .accumulationShare = 1 / static_cast<float>(subframes),
        .layerLimit = frame_.method == TransparencyMethod::peel ? frame_.layers : kNoLayerLimit};
    frameUniforms_.write(0, std::as_bytes(std::span(&shared, 1)));
    glBindBufferBase(GL_UNIFORM_BUFFER, FrameUniforms::kBinding, frameUniforms_.name());
}

/// Meshes lie within their boxes, and boxes that are given may be much larger, but moved meshes need those.
PictureRegion DrawRecorder::regionOf(double near) const {
    glm::ivec2 low(frame_.camera.size), high(0);
    for (const SurfaceDraw* draw : visible_) {
        const Bounds bounds = draw->motion == 0 ? boundsWorld(meshes_->get(draw->mesh), draw->worldFromSeries)
                                                : drawnBounds(*draw, *meshes_);
        const PictureRegion region = seenRegion(frame_, bounds, near);
        low = glm::min(low, region.origin);
        high = glm::max(high, region.origin + region.size);
    }
    return {low, glm::max(high - low, glm::ivec2(0))};
}

void DrawRecorder::uploadIllustration(glm::dvec2 shiftPixels) {
    const IllustrativeStyle& style = *frame_.illustration;
    const ViewAxes axes = viewAxes(frame_.camera);
    const glm::dvec3 light(style.light);
    const double height = 2 * std::tan(frame_.camera.fovDegrees * M_PI / 360);
    const double angle = style.hatchAngle * M_PI / 180;
    const IllustrationUniforms uniforms{
        .light =
            glm::vec4(glm::normalize(light.x * axes.right + light.y * axes.up - light.z * axes.forward), 0),
        .paper = {style.paper * frame_.backgroundOpacity, frame_.backgroundOpacity},
        .frontColor = {style.front, 1},
        .backColor = {style.back, 1},
        .hatchRow = glm::dvec2(std::cos(angle), std::sin(angle)) / double(style.hatchSize),
        .shiftPixels = shiftPixels,
        .hatchCross = style.hatchCross,
        .alpha = style.alpha,
        .beta = style.beta,
        .normalThreshold = style.normalThreshold,
        .depthThreshold = static_cast<float>(style.depthThreshold * height / frame_.camera.size.y)};
    illustrationUniforms_.write(0, std::as_bytes(std::span(&uniforms, 1)));
    glBindBufferBase(GL_UNIFORM_BUFFER, IllustrationUniforms::kBinding, illustrationUniforms_.name());
}

void DrawRecorder::uploadUniforms(const std::vector<std::byte>& bytes) {
    if (bytes.empty()) return;
    if (!uniforms_ || uniforms_->bytes() < bytes.size()) uniforms_ = gl::Buffer::updatable(bytes.size());
    uniforms_->write(0, bytes);
}

const gl::Buffer& DrawRecorder::colorMapUniforms(std::size_t map) {
    if (const auto found = colorMaps_.find(map); found != colorMaps_.end()) return found->second;
    ColorMapUniforms uniforms{};
    const auto colors = colorMap(map);
    for (std::size_t i = 0; i < colors.size(); ++i) uniforms.colors[i] = {colors[i], 0};
    return colorMaps_.emplace(map, gl::Buffer::immutable(std::as_bytes(std::span(&uniforms, 1))))
        .first->second;
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
        glBindBufferBase(GL_UNIFORM_BUFFER, ColorMapUniforms::kBinding,
                         colorMapUniforms(draw.colorMap).name());
        glBindVertexArray(draw.mesh->vertexArray.name());
        glDrawElements(GL_TRIANGLES, draw.mesh->indexCount, GL_UNSIGNED_INT, nullptr);
    }
}

void DrawRecorder::drawFullScreen() {
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DrawRecorder::drawVolume() {
    volume_.bind();
    drawFullScreen();
}

}  // namespace isoglass
