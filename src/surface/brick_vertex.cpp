#include "surface/brick_vertex.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

constexpr std::array<int, 3> kStride = {BrickField::kStrideX, BrickField::kStrideY, 1};

/// Derivative where a neighbour may be missing: one-sided, or zero where both are.
float guardedDerivative(const AxisTable& axis, int i, float before, float after) {
    if (std::isnan(before)) return std::isnan(after) ? 0.0f : axis.inverseNext[i] * after;
    if (std::isnan(after)) return axis.inversePrevious[i] * before;
    return axis.previous[i] * before + axis.next[i] * after;
}

bool usable(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) &&
           (v.x != 0 || v.y != 0 || v.z != 0);
}

}  // namespace

glm::vec3 VertexMaker::gradient(glm::ivec3 sample) const {
    const float* value = &field_.values[BrickField::at(sample.x, sample.y, sample.z)];
    glm::vec3 result;
    for (int k = 0; k < 3; ++k) {
        const AxisTable& axis = space_.axes[k];
        const int i = first_[k] + sample[k];
        const float before = *value - value[-kStride[k]];
        const float after = value[kStride[k]] - *value;
        result[k] = field_.complete ? axis.previous[i] * before + axis.next[i] * after
                                    : guardedDerivative(axis, i, before, after);
    }
    return result;
}

glm::dvec3 VertexMaker::world(glm::ivec3 sample) const {
    const glm::ivec3 i = first_ + sample;
    return {space_.axes[0].coordinate[i.x], space_.axes[1].coordinate[i.y], space_.axes[2].coordinate[i.z]};
}

void VertexMaker::make(glm::ivec3 low, int direction, VertexBuffer& out) const {
    const glm::ivec3 high = low + edgeVector(direction);
    const EdgeCrossing crossing(field_, low, high, iso_);
    const glm::dvec3 lowWorld = world(low);
    const glm::dvec3 edge = world(high) - lowWorld;
    out.positions.emplace_back(lowWorld + crossing.t * edge);
    out.normals.push_back(edgeBlendedNormal(gradient(low), gradient(high), crossing, edge));
}

EdgeCrossing::EdgeCrossing(const BrickField& field, glm::ivec3 low, glm::ivec3 high, float iso) {
    // In double the difference of two floats neither overflows nor vanishes, so t is in [0,1] for any
    // finite ends on different sides of the iso-value.
    const double lowValue = field.values[BrickField::at(low.x, low.y, low.z)];
    difference = field.values[BrickField::at(high.x, high.y, high.z)] - lowValue;
    t = (static_cast<double>(iso) - lowValue) / difference;
}

glm::vec3 edgeBlendedNormal(glm::vec3 lowGradient, glm::vec3 highGradient, const EdgeCrossing& crossing,
                            glm::dvec3 edge) {
    const glm::vec3 normal = -(lowGradient + static_cast<float>(crossing.t) * (highGradient - lowGradient));
    return usable(normal) ? normal : edgeNormal(crossing.difference, edge);
}

glm::vec3 edgeNormal(double difference, glm::dvec3 edge) {
    // Scaled first: the square of a length may be no double where the length is one.
    const double largest = std::max({std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
    const glm::dvec3 scaled = edge / largest;
    const glm::vec3 normal(scaled * (-difference / (largest * glm::dot(scaled, scaled))));
    if (usable(normal)) return normal;
    return glm::vec3(glm::normalize(scaled) * (difference > 0 ? -1.0 : 1.0));
}

}  // namespace isoglass
