#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace isoglass {

/// The samples of one key frame as rays find them.
struct VolumeSamples {
    /// Samples along x, y, z; the one that closes a periodic axis is there, too.
    glm::ivec3 dims{0};
    std::vector<float> values;  ///< x fastest; NaN where missing
    /// Bricks of 8^3 cells along each axis.
    glm::ivec3 bricks{0};
    /// Of each brick, x fastest: the smallest and the largest value in its closed cells. +inf, -inf where
    /// none of its samples is valid; -inf, +inf where some are and some are missing.
    std::vector<glm::vec2> ranges;
};

/// Samples with the ranges of their bricks; at least two along each axis. Pure.
VolumeSamples makeVolumeSamples(glm::ivec3 dims, std::vector<float> values);

}  // namespace isoglass
