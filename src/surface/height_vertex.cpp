#include "surface/height_vertex.h"

#include "surface/brick_vertex.h"

#include <glm/vec2.hpp>

#include <cmath>

namespace isoglass {

namespace {

constexpr std::array<int, 3> kStride = {BrickField::kStrideX, BrickField::kStrideY, 1};

/// Differences of one channel to the neighbours before and after a sample; NaN where there is none.
struct Differences {
    float before;
    float after;

    Differences(const float* value, int stride)
        : before(*value - value[-stride]), after(value[stride] - *value) {}
};

/// Derivatives of the field and of the heights along x or y of the lattice, both by the differences that the
/// field has: central, one-sided, or none.
glm::vec2 alongLattice(const AxisTable& axis, int i, Differences field, Differences height) {
    if (!std::isnan(field.before) && !std::isnan(field.after))
        return {axis.previous[i] * field.before + axis.next[i] * field.after,
                axis.previous[i] * height.before + axis.next[i] * height.after};
    if (!std::isnan(field.after)) return axis.inverseNext[i] * glm::vec2(field.after, height.after);
    if (!std::isnan(field.before)) return axis.inversePrevious[i] * glm::vec2(field.before, height.before);
    return glm::vec2(0);
}

/// Derivative of the field along its column, of second order on uneven steps.
float alongColumn(Differences field, Differences height) {
    if (std::isnan(field.before)) return std::isnan(field.after) ? 0.0f : field.after / height.after;
    if (std::isnan(field.after)) return field.before / height.before;
    const float both = height.before + height.after;
    return (field.before / height.before) * (height.after / both) +
           (field.after / height.after) * (height.before / both);
}

}  // namespace

glm::vec3 HeightVertexMaker::gradient(glm::ivec3 sample) const {
    const int at = BrickField::at(sample.x, sample.y, sample.z);
    const auto field = [&](int k) { return Differences(&field_.values[at], kStride[k]); };
    const auto height = [&](int k) { return Differences(&heights_.values[at], kStride[k]); };
    const float z = alongColumn(field(2), height(2));
    glm::vec3 result(0, 0, z);
    for (int k = 0; k < 2; ++k) {
        const glm::vec2 along = alongLattice(space_.axes[k], first_[k] + sample[k], field(k), height(k));
        result[k] = along.x - z * along.y;
    }
    return result;
}

glm::dvec3 HeightVertexMaker::world(glm::ivec3 sample) const {
    const glm::ivec3 i = first_ + sample;
    const double height = heights_.values[BrickField::at(sample.x, sample.y, sample.z)];
    return {space_.axes[0].coordinate[i.x], space_.axes[1].coordinate[i.y], height - space_.origin.z};
}

void HeightVertexMaker::make(glm::ivec3 low, int direction, VertexBuffer& out) const {
    const glm::ivec3 high = low + edgeVector(direction);
    const EdgeCrossing crossing(field_, low, high, iso_);
    const glm::dvec3 lowWorld = world(low);
    const glm::dvec3 edge = world(high) - lowWorld;
    out.positions.emplace_back(lowWorld + crossing.t * edge);
    out.normals.push_back(edgeBlendedNormal(gradient(low), gradient(high), crossing, edge));
}

}  // namespace isoglass
