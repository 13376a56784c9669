#pragma once

#include "surface/extract.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

#include <array>

namespace isoglass {

/// Samples along one side of a gathered brick: its own 8, one before and two after.
inline constexpr int kFieldSize = kBrickSize + 3;

/// The field of one brick at one time, with a border of neighbours: local samples -1 .. 9.
struct BrickField {
    /// z fastest, sample (x,y,z) at `at(x,y,z)`; NaN where it is missing or outside the domain.
    alignas(64) std::array<float, kFieldSize * kFieldSize * kFieldSize> values;
    bool complete = false;  ///< no value is NaN

    static constexpr int kStrideX = kFieldSize * kFieldSize;
    static constexpr int kStrideY = kFieldSize;
    static constexpr int at(int x, int y, int z) { return (x + 1) * kStrideX + (y + 1) * kStrideY + z + 1; }
};

/// Gathers brick `brick` of the extraction and interpolates it in time. `sign` is 1 or -1 and multiplies
/// every value. `scratch` is working memory of the same thread.
void gatherBrick(const IndexSpace& space, const TimedField& field, glm::ivec3 brick, float sign,
                 BrickField& scratch, BrickField& out);

}  // namespace isoglass
