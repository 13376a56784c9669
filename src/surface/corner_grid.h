#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace isoglass {

/// A value at each corner of blocks, x fastest.
struct CornerGrid {
    CornerGrid() = default;
    CornerGrid(glm::ivec3 n, float value);

    std::size_t place(glm::ivec3 i) const {
        return (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
    }
    /// Beyond the end that at the nearest corner.
    float at(glm::ivec3 i) const { return values[place(glm::min(i, dims - 1))]; }

    glm::ivec3 dims{0};
    std::vector<float> values;
};

/// Along every axis, one after the other: no value above its neighbour's and `growth`. What is the smallest
/// over all corners of a value and `growth` times the steps to it, but for rounding. The result does not
/// depend on `threads`.
void limitGrowth(CornerGrid& grid, float growth, int threads);

/// Smallest over the corners of the closed cubes of 1, 2, 4, ... steps a side: one grid each, of as many
/// cubes as there are, the last of one. `grid` has at least two corners along each axis.
std::vector<CornerGrid> smallestInCubes(const CornerGrid& grid, int threads);

}  // namespace isoglass
