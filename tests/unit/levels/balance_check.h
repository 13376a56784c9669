#pragma once

#include "unit/levels/lattice_values.h"

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace isoglass::test {

inline bool touch(LevelBrick a, LevelBrick b) {
    const glm::ivec3 firstA = a.brick * (1 << a.level);
    const glm::ivec3 firstB = b.brick * (1 << b.level);
    return glm::all(glm::lessThanEqual(firstA, firstB + (1 << b.level))) &&
           glm::all(glm::lessThanEqual(firstB, firstA + (1 << a.level)));
}

/// Sizes grow so slowly that bricks that touch are at most one level apart, and the bounds of bricks hold.
inline void expectBalanced(const LevelSpace& space, const SizeField& sizes) {
    const std::vector<LevelBrick> bricks = coverWithBricks(space, sizes);
    for (const LevelBrick& brick : bricks) {
        float low = 1e30f;
        float high = 0;
        glm::ivec3 v;
        for (v.z = 0; v.z <= kBrickSize; ++v.z) {
            for (v.y = 0; v.y <= kBrickSize; ++v.y) {
                for (v.x = 0; v.x <= kBrickSize; ++v.x) {
                    const float size = sizes.at((brick.brick * kBrickSize + v) * (1 << brick.level));
                    low = std::min(low, size);
                    high = std::max(high, size);
                }
            }
        }
        const float cell = static_cast<float>(1 << brick.level);
        EXPECT_GE(low, cell);
        EXPECT_TRUE(high < 4 * cell || brick.level == space.top()) << high;
        // Bounds hold for every vertex, bit by bit but for the rounding of a mean near missing samples.
        EXPECT_LE(sizes.smallest(brick), low * 1.000001f);
        EXPECT_GE(sizes.largest(brick), high);
        EXPECT_LE(high - low, sizes.growthPerBrick() * cell * 1.00001f);
    }
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        for (std::size_t j = i + 1; j < bricks.size(); ++j) {
            const bool apart = std::abs(bricks[i].level - bricks[j].level) > 1;
            EXPECT_FALSE(apart && touch(bricks[i], bricks[j]));
        }
    }
}

}  // namespace isoglass::test
