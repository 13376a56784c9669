#include "render/volume_samples.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace isoglass {
namespace {

constexpr int kBrickCells = 8;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

glm::vec2 rangeOfBrick(const VolumeSamples& volume, glm::ivec3 brick) {
    const glm::ivec3 low = brick * kBrickCells;
    const glm::ivec3 high = glm::min(low + kBrickCells, volume.dims - 1);
    glm::vec2 range(kInfinity, -kInfinity);
    bool missing = false;
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            const std::size_t row = (static_cast<std::size_t>(z) * volume.dims.y + y) * volume.dims.x;
            for (int x = low.x; x <= high.x; ++x) {
                const float value = volume.values[row + x];
                missing = missing || std::isnan(value);
                range.x = std::min(range.x, value);  // stays where the value is a NaN
                range.y = std::max(range.y, value);
            }
        }
    }
    const bool some = range.x <= range.y;
    return missing && some ? glm::vec2(-kInfinity, kInfinity) : range;
}

}  // namespace

VolumeSamples makeVolumeSamples(glm::ivec3 dims, std::vector<float> values) {
    VolumeSamples volume{.dims = dims,
                         .values = std::move(values),
                         .bricks = (dims - 1 + (kBrickCells - 1)) / kBrickCells,
                         .ranges = {}};
    glm::ivec3 brick;
    for (brick.z = 0; brick.z < volume.bricks.z; ++brick.z) {
        for (brick.y = 0; brick.y < volume.bricks.y; ++brick.y) {
            for (brick.x = 0; brick.x < volume.bricks.x; ++brick.x)
                volume.ranges.push_back(rangeOfBrick(volume, brick));
        }
    }
    return volume;
}

}  // namespace isoglass
