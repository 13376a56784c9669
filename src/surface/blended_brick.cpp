#include "surface/blended_brick.h"

#include "surface/box_field.h"
#include "surface/cell_form.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

namespace {

/// Places of a cube of n^3 values with a border, z fastest.
constexpr int boxPlace(int n, glm::ivec3 v) {
    return ((v.x + 1) * (n + 2) + v.y + 1) * (n + 2) + v.z + 1;
}

/// Mean of the two vertices that each vertex of an m^3 cube lies between, on the lattice of twice the
/// spacing: `coarse(x, y)` is a row along z. Adds its share `weights` to `values`.
template <int m, typename Coarse>
void blendRows(const Coarse& coarse, const float* weights, float* values) {
    for (int x = 0; x < m; ++x) {
        for (int y = 0; y < m; ++y) {
            const float* low = coarse(x / 2, y / 2);
            const float* high = coarse((x + 1) / 2, (y + 1) / 2);
            for (int z = 0; z < m; ++z, ++values, ++weights) {
                const float mean = 0.5f * (low[z / 2] + high[(z + 1) / 2]);
                if (*weights >= 1) {
                    *values = mean;
                } else if (*weights > 0) {
                    *values += *weights * (mean - *values);
                }
            }
        }
    }
}

float derivative(const AxisTable& axis, int i, int first, int last, float before, float here, float after) {
    const bool hasBefore = i > first && !std::isnan(before);
    const bool hasAfter = i < last && !std::isnan(after);
    if (hasBefore && hasAfter) return axis.previous[i] * (here - before) + axis.next[i] * (after - here);
    if (hasAfter) return axis.inverseNext[i] * (after - here);
    if (hasBefore) return axis.inversePrevious[i] * (here - before);
    return 0;
}

}  // namespace

float blendWeight(float sizeRatio) {
    return std::clamp((sizeRatio - kBlendFrom) / (2 - kBlendFrom), 0.0f, 1.0f);
}

void BlendedBrick::load(const LevelFields& fields, LevelBrick node) {
    fields_ = &fields;
    node_ = node;
    sizesKnown_ = false;
    ++loads_;
    gatherBrick(fields.space.levels[node.level], fields.fields[node.level], node.brick, fields.sign, scratch_,
                own_);
    // Beyond the domain the field has the value at the nearest index.
    const glm::ivec3 last = fields.space.cellsAt(node.level) - node.brick * kBrickSize;
    hasMissing_ = false;
    for (int x = 0; x < kCornersPerSide; ++x) {
        for (int y = 0; y < kCornersPerSide; ++y) {
            const float* row = &own_.values[BrickField::at(std::min(x, last.x), std::min(y, last.y), 0)];
            float* out = &values_[cornerPlace(x, y, 0)];
            for (int z = 0; z < kCornersPerSide; ++z) out[z] = row[std::min(z, last.z)];
        }
    }
    if (!own_.complete)
        hasMissing_ = std::any_of(values_.begin(), values_.end(), [](float v) { return std::isnan(v); });

    const float ownSize = static_cast<float>(1 << node.level);
    blendedLevels_ = 0;
    if (node.level == fields.space.top()) return;
    if (!(blendWeight(fields.sizes.largest(node) / ownSize) > 0)) return;
    blendedLevels_ = 1;
    loadCoarser(fields);
}

/// Evaluates from the top down, so that each vertex of each level is computed once.
void BlendedBrick::loadCoarser(const LevelFields& fields) {
    float largest = 0;
    for (int place = 0; place < kBrickCorners; ++place) {
        weights_[place] = blendWeight(sizeRatio(place));
        largest = std::max(largest, weights_[place]);
    }
    if (largest == 0) {
        blendedLevels_ = 0;
        return;
    }
    const int level = node_.level;
    gatherBox(fields.fields[level + 1], fields.space.cellsAt(level + 1), node_.brick * (kHalf - 1) - 1,
              kHalf + 2, fields.sign, half_.data());
    largest = 0;
    if (level + 1 < fields.space.top()) {
        for (int place = 0; place < kHalf * kHalf * kHalf; ++place) {
            const glm::ivec3 local(place / (kHalf * kHalf), place / kHalf % kHalf, place % kHalf);
            // Vertices of the next level are every second one of the brick.
            halfWeights_[place] = blendWeight(0.5f * sizeRatio(cornerPlace(2 * local)));
            largest = std::max(largest, halfWeights_[place]);
        }
    }
    std::array<float, kHalf * kHalf * kHalf> half;
    for (int x = 0; x < kHalf; ++x) {
        for (int y = 0; y < kHalf; ++y)
            std::copy_n(&half_[boxPlace(kHalf, {x, y, 0})], kHalf, &half[(x * kHalf + y) * kHalf]);
    }
    if (largest > 0) {
        blendedLevels_ = 2;
        gatherBox(fields.fields[level + 2], fields.space.cellsAt(level + 2), node_.brick * (kQuarter - 1) - 1,
                  kQuarter + 2, fields.sign, quarter_.data());
        const auto row = [&](int x, int y) { return &quarter_[boxPlace(kQuarter, {x, y, 0})]; };
        blendRows<kHalf>(row, halfWeights_.data(), half.data());
    }
    const auto row = [&](int x, int y) { return &half[(x * kHalf + y) * kHalf]; };
    blendRows<kCornersPerSide>(row, weights_.data(), values_.data());
}

const std::array<float, kBrickCorners>& BlendedBrick::sizes() {
    if (!sizesKnown_) fields_->sizes.inBrick(node_, sizes_);
    sizesKnown_ = true;
    return sizes_;
}

/// A channel at a vertex of the level `levelsUp` above that of the brick.
template <typename Value, typename OnLevel>
Value BlendedBrick::blended(int levelsUp, glm::ivec3 local, const OnLevel& onLevel) const {
    if (levelsUp == blendedLevels_) return onLevel(levelsUp, local);
    const float weight = levelsUp == 0 ? weights_[cornerPlace(local)]
                                       : halfWeights_[(local.x * kHalf + local.y) * kHalf + local.z];
    if (weight == 0) return onLevel(levelsUp, local);
    using Scalar = typename Value::value_type;
    const Value low = blended<Value>(levelsUp + 1, local / 2, onLevel);
    const Value high = blended<Value>(levelsUp + 1, (local + 1) / 2, onLevel);
    const Value mean = Scalar(0.5) * (low + high);
    if (weight == 1) return mean;
    const Value own = onLevel(levelsUp, local);
    return own + Scalar(weight) * (mean - own);
}

const Channels& BlendedBrick::channels(glm::ivec3 corner) {
    const int place = cornerPlace(corner);
    Channels& channels = channels_[place];
    if (channelsOf_[place] == loads_) return channels;
    channelsOf_[place] = loads_;
    channels.position = position(corner);
    channels.gradient = gradient(corner);
    return channels;
}

glm::dvec3 BlendedBrick::position(glm::ivec3 corner) const {
    return blended<glm::dvec3>(0, corner, [&](int levelsUp, glm::ivec3 local) {
        const int level = node_.level + levelsUp;
        return fields_->space.position((node_.brick * (kBrickSize >> levelsUp) + local) * (1 << level));
    });
}

glm::vec3 BlendedBrick::gradient(glm::ivec3 corner) const {
    return blended<glm::vec3>(0, corner,
                              [&](int levelsUp, glm::ivec3 local) { return levelGradient(levelsUp, local); });
}

/// Differences of one level; beyond the domain those at its end.
glm::vec3 BlendedBrick::levelGradient(int levelsUp, glm::ivec3 local) const {
    const int level = node_.level + levelsUp;
    const IndexSpace& space = fields_->space.levels[level];
    const glm::ivec3 last = fields_->space.cellsAt(level);
    const glm::ivec3 first = node_.brick * (kBrickSize >> levelsUp);
    if (levelsUp == 0 && own_.complete) {
        // All neighbours are there.
        const float* value = &own_.values[BrickField::at(local.x, local.y, local.z)];
        constexpr std::array<int, 3> kStride = {BrickField::kStrideX, BrickField::kStrideY, 1};
        glm::vec3 result;
        for (int k = 0; k < 3; ++k) {
            const AxisTable& axis = space.axes[k];
            const int i = first[k] + local[k];
            result[k] = axis.previous[i] * (*value - value[-kStride[k]]) +
                        axis.next[i] * (value[kStride[k]] - *value);
        }
        return result;
    }
    const glm::ivec3 at = glm::min(local, last - first);
    const float* value = nullptr;
    std::array<int, 3> stride;
    switch (levelsUp) {
        case 0:
            value = &own_.values[BrickField::at(at.x, at.y, at.z)];
            stride = {BrickField::kStrideX, BrickField::kStrideY, 1};
            break;
        case 1:
            value = &half_[boxPlace(kHalf, at)];
            stride = {(kHalf + 2) * (kHalf + 2), kHalf + 2, 1};
            break;
        default:
            value = &quarter_[boxPlace(kQuarter, at)];
            stride = {(kQuarter + 2) * (kQuarter + 2), kQuarter + 2, 1};
    }
    glm::vec3 result;
    for (int k = 0; k < 3; ++k) {
        // A periodic axis goes on beyond its last sample; levels above 0 are cut open there.
        const int beyond = space.periodic[k] ? 1 : 0;
        const int i = first[k] + at[k];
        result[k] = derivative(space.axes[k], i, -beyond, last[k] + beyond, value[-stride[k]], *value,
                               value[stride[k]]);
    }
    return result;
}

}  // namespace isoglass
