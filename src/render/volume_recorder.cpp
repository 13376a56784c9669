#include "render/volume_recorder.h"

#include "base/error.h"
#include "render/uniforms.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace isoglass {
namespace {

enum Unit {
    valuesA = 16,
    valuesB = 17,
    rangesA = 18,
    rangesB = 19,
    axisTables = 20,
    transfer = 21,
    visibleRanges = 22
};

/// Of a step: axes that are off by less are even.
constexpr double kEven = 1e-6;

/// How "local" coordinates of an axis come from those of the series: direction * (x - middle).
struct LocalAxis {
    double middle;
    double direction;  ///< -1 where the series' coordinates decrease

    double operator()(double x) const { return direction * (x - middle); }
};

LocalAxis localAxis(const std::vector<double>& coordinates) {
    return {0.5 * (coordinates.front() + coordinates.back()),
            coordinates.back() < coordinates.front() ? -1.0 : 1.0};
}

bool isEven(const std::vector<double>& coordinates) {
    const double step =
        (coordinates.back() - coordinates.front()) / static_cast<double>(coordinates.size() - 1);
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
        const double even = coordinates.front() + static_cast<double>(i) * step;
        if (std::abs(coordinates[i] - even) > kEven * std::abs(step)) return false;
    }
    return true;
}

std::array<glm::vec4, 3> columns(const glm::dmat3& matrix) {
    return {glm::vec4(glm::vec3(matrix[0]), 0), glm::vec4(glm::vec3(matrix[1]), 0),
            glm::vec4(glm::vec3(matrix[2]), 0)};
}

/// The largest element becomes 1.
glm::dmat3 scaledToOne(glm::dmat3 matrix) {
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(matrix[column][row]));
    }
    return matrix / largest;
}

glm::vec4 direction(const glm::dvec3& v) {
    return {glm::vec3(v), 0};
}

/// `turned` and `middle` are those of LocalAxis.
void setPlanes(const VolumeDraw& volume, const glm::dvec3& turned, const glm::dvec3& middle,
               const glm::dmat3& localFromWorld, VolumeUniforms& uniforms) {
    for (std::size_t i = 0; i < volume.planes.size(); ++i) {
        const glm::dvec3 normal(volume.planes[i]);
        const glm::dvec3 gradient = (turned * normal) * localFromWorld;
        const double length = glm::length(gradient);
        uniforms.planes[i] =
            glm::vec4(glm::dvec4(turned * normal, volume.planes[i].w + glm::dot(normal, middle)) / length);
        uniforms.planeNormals[i] = direction(gradient / length);
    }
    uniforms.planeCount = static_cast<int>(volume.planes.size());
}

void setSolids(const VolumeDraw& volume, const glm::dvec3& turned, const glm::dvec3& middle,
               const glm::dmat3& localFromWorld, VolumeUniforms& uniforms) {
    static_assert(std::tuple_size_v<decltype(VolumeUniforms::solids)> == kMostSolids);
    const glm::dmat4 localFromSeries = glm::translate(glm::scale(glm::dmat4(1), turned), -middle);
    for (std::size_t i = 0; i < volume.solids.size(); ++i) {
        const SolidClip& solid = volume.solids[i];
        const glm::dmat4 rows = glm::transpose(glm::inverse(localFromSeries * solid.seriesFromSolid));
        uniforms.solids[i] = {static_cast<int>(solid.shape), static_cast<int>(solid.keep), 0, 0};
        for (int k = 0; k < 3; ++k) {
            const std::size_t row = 3 * i + static_cast<std::size_t>(k);
            uniforms.solidRows[row] = rows[k];
            uniforms.solidGradients[row] = direction(glm::dvec3(rows[k]) * localFromWorld);
        }
    }
    uniforms.solidCount = static_cast<int>(volume.solids.size());
}

}  // namespace

VolumeRecorder::VolumeRecorder() : uniforms_(gl::Buffer::updatable(sizeof(VolumeUniforms))) {}

void VolumeRecorder::prepare(const std::optional<LayerDraw>& layers, const std::optional<ShadedDraw>& shaded,
                             const VolumeStore& volumes) {
    layers_ = layers;
    shaded_ = shaded;
    volumes_ = &volumes;
    if (draw() == nullptr) return;
    if (draw()->planes.size() > kMostVolumePlanes) {
        throw Error(std::to_string(draw()->planes.size()) + " planes cut a volume that rays go through",
                    "clip", "use at most " + std::to_string(kMostVolumePlanes));
    }
    if (draw()->solids.size() > kMostSolids) {
        throw Error(std::to_string(draw()->solids.size()) + " solids clip a volume that rays go through",
                    "clip", "use at most " + std::to_string(kMostSolids));
    }
    evenAxes_ = std::ranges::all_of(draw()->axes, isEven);
}

const VolumeDraw* VolumeRecorder::draw() const {
    if (layers_) return &*layers_;
    return shaded_ ? &*shaded_ : nullptr;
}

bool VolumeRecorder::lightsCuts() const {
    return shaded_ && shaded_->style.lit && shaded_->style.cut &&
           !(shaded_->planes.empty() && shaded_->solids.empty());
}

VolumeVariant VolumeRecorder::variant() const {
    VolumeVariant variant;
    if (draw() == nullptr) return variant;
    const bool two = draw()->fraction > 0;
    if (two) variant.defines.push_back("TWO_KEY_FRAMES");
    if (!evenAxes_) variant.defines.push_back("UNEVEN_AXES");
    if (!draw()->solids.empty()) variant.defines.push_back("SOLIDS");
    if (lightsCuts()) variant.defines.push_back("CUT_LIGHT");
    if (layers_ && layers_->wholeRay) variant.defines.push_back("WHOLE_RAY");
    if (layers_ && layers_->output == LayerDraw::Output::measure) variant.defines.push_back("MEASURE");
    variant.units = {valuesA, rangesA};
    if (two) variant.units = {valuesA, valuesB, rangesA, rangesB};
    if (!evenAxes_) variant.units.push_back(axisTables);
    if (shaded_) variant.units.insert(variant.units.end(), {transfer, visibleRanges});
    return variant;
}

void VolumeRecorder::upload(const CameraView& camera, glm::dvec2 clipShift, double nearDistance) {
    if (draw() == nullptr) return;
    const VolumeDraw& volume = *draw();
    VolumeUniforms uniforms{};
    glm::dvec3 middle, turned;
    for (int k = 0; k < 3; ++k) {
        const std::vector<double>& axis = volume.axes[static_cast<std::size_t>(k)];
        const LocalAxis local = localAxis(axis);
        middle[k] = local.middle;
        turned[k] = local.direction;
        const double length = local(axis.back()) - local(axis.front());
        uniforms.boxLow[k] = static_cast<float>(local(axis.front()));
        uniforms.boxHigh[k] = static_cast<float>(local(axis.back()));
        uniforms.indexPerUnit[k] = static_cast<float>(static_cast<double>(axis.size() - 1) / length);
        uniforms.samples[k] = static_cast<int>(axis.size());
    }
    const glm::dmat4 seriesFromWorld = glm::inverse(volume.worldFromSeries);
    const glm::dmat3 localFromWorld =
        glm::dmat3(glm::dvec3(turned.x, 0, 0), glm::dvec3(0, turned.y, 0), glm::dvec3(0, 0, turned.z)) *
        glm::dmat3(seriesFromWorld);
    const glm::dvec3 eyeSeries(seriesFromWorld * glm::dvec4(camera.eye, 1));
    uniforms.eye = direction(turned * (eyeSeries - middle));
    const ViewAxes view = viewAxes(camera);
    const double height = std::tan(camera.fovDegrees * M_PI / 360);
    const double width = height * camera.size.x / camera.size.y;
    uniforms.forward = direction(localFromWorld * view.forward);
    uniforms.right = direction(width * (localFromWorld * view.right));
    uniforms.up = direction(height * (localFromWorld * view.up));
    uniforms.worldFromLocal = columns(glm::inverse(localFromWorld));
    uniforms.normalFromLocal = columns(scaledToOne(glm::transpose(localFromWorld)));
    setPlanes(volume, turned, middle, localFromWorld, uniforms);
    setSolids(volume, turned, middle, localFromWorld, uniforms);
    uniforms.shift = clipShift;
    uniforms.fraction = volume.fraction;
    uniforms.nearDistance = static_cast<float>(nearDistance);
    if (layers_) setLayers(uniforms);
    if (shaded_) setMedium(uniforms);
    uniforms_.write(0, std::as_bytes(std::span(&uniforms, 1)));
    if (!evenAxes_) uploadAxes();
}

void VolumeRecorder::setLayers(VolumeUniforms& uniforms) const {
    const LayerStyle& style = layers_->style;
    uniforms.iso = layers_->iso;
    uniforms.stepCells = static_cast<float>(style.step);
    uniforms.layersWanted = style.count;
    uniforms.firstLayer = style.show == LayerStyle::Show::nth ? style.count : style.first;
    uniforms.show = static_cast<int>(style.show);
    uniforms.silhouette = static_cast<float>(style.silhouette);
    for (int layer = 0; layer < style.count; ++layer)
        uniforms.layerColors[static_cast<std::size_t>(layer)] = {layerColor(style, layer, layers_->color),
                                                                 layerOpacity(style, layer)};
}

void VolumeRecorder::setMedium(VolumeUniforms& uniforms) {
    const VolumeStyle& style = shaded_->style;
    if (tableStyle_ != style) {
        table_ = makeTransferTable(style);
        constexpr int kEntries = TransferTable::kEntries, kBins = TransferTable::kBins;
        transfer_.emplace(GL_RGBA32F, glm::ivec2(kEntries, 1));
        visibleRanges_.emplace(GL_R32F, glm::ivec2(kBins));
        glTextureSubImage2D(transfer_->name(), 0, 0, 0, kEntries, 1, GL_RGBA, GL_FLOAT,
                            table_.entries.data());
        glTextureSubImage2D(visibleRanges_->name(), 0, 0, 0, kBins, kBins, GL_RED, GL_FLOAT,
                            table_.visible.data());
        tableStyle_ = style;
    }
    uniforms.stepCells = static_cast<float>(style.step);
    uniforms.transferLow = table_.low;
    uniforms.transferScale = table_.scale;
    uniforms.perUnit = static_cast<float>(1 / style.unit.value());
    uniforms.litByGradient = style.lit;
    if (!style.cut) return;
    uniforms.cutThickness = static_cast<float>(style.cut->thickness);
    uniforms.cutWeight = static_cast<int>(style.cut->weight);
}

void VolumeRecorder::uploadAxes() {
    std::size_t longest = 0;
    const auto& axes = draw()->axes;
    for (const auto& axis : axes) longest = std::max(longest, axis.size());
    std::vector<float> rows(3 * longest, 0);
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& axis = axes[k];
        const LocalAxis local = localAxis(axis);
        for (std::size_t i = 0; i < axis.size(); ++i)
            rows[k * longest + i] = static_cast<float>(local(axis[i]));
    }
    axisTables_.emplace(GL_R32F, glm::ivec2(static_cast<int>(longest), 3));
    glTextureSubImage2D(axisTables_->name(), 0, 0, 0, static_cast<GLsizei>(longest), 3, GL_RED, GL_FLOAT,
                        rows.data());
}

void VolumeRecorder::bind() const {
    const GpuVolume& first = volumes_->get(draw()->first);
    const GpuVolume& second = draw()->fraction > 0 ? volumes_->get(draw()->second) : first;
    glBindBufferBase(GL_UNIFORM_BUFFER, VolumeUniforms::kBinding, uniforms_.name());
    glBindTextureUnit(valuesA, first.values.name());
    glBindTextureUnit(valuesB, second.values.name());
    glBindTextureUnit(rangesA, first.ranges.name());
    glBindTextureUnit(rangesB, second.ranges.name());
    glBindTextureUnit(axisTables, axisTables_ ? axisTables_->name() : 0);
    glBindTextureUnit(transfer, transfer_ ? transfer_->name() : 0);
    glBindTextureUnit(visibleRanges, visibleRanges_ ? visibleRanges_->name() : 0);
}

}  // namespace isoglass
