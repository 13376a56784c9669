#include "volume/pyramid.h"

#include "support/random_fields.h"
#include "volume/series_file.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace isoglass {
namespace {

struct Case {
    glm::ivec3 dims;
    bool periodic;
    std::uint32_t missingPercent;
};

constexpr std::array<Case, 5> kCases = {{{{33, 20, 9}, false, 0},
                                         {{28, 28, 23}, false, 3},
                                         {{36, 19, 2}, true, 0},
                                         {{37, 17, 64}, true, 20},
                                         {{8, 1, 9}, false, 0}}};

struct Built {
    std::vector<float> samples;
    std::shared_ptr<const KeyFrame> frame;
};

/// Blocks of one value beside noise, so that some bricks are constant and some are not stored at all.
Built build(const Case& c, std::uint32_t seed) {
    Lattice lattice = makeUniformLattice(c.dims, glm::dvec3(0), glm::dvec3(1));
    if (c.periodic) lattice.axes[0].period = c.dims.x;
    Built built;
    built.samples = randomFloats(c.dims, seed);
    removeSamples(built.samples, c.missingPercent, seed + 1);
    for (int z = 0; z < c.dims.z; ++z) {
        for (int y = 0; y < c.dims.y; ++y) {
            for (int x = 0; x < std::min(c.dims.x, 16); ++x) {
                if (y < 16 && c.missingPercent != 3) built.samples[sampleAt(c.dims, {x, y, z})] = 0.25f;
            }
        }
    }
    built.frame = makeKeyFrame(lattice, built.samples);
    return built;
}

bool sameValue(float a, float b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

TEST(Pyramid, LevelsHoldTheSamplesAtMultiplesAndTheLastOne) {
    for (const Case& c : kCases) {
        const Built built = build(c, 5);
        const Pyramid& pyramid = built.frame->pyramid();
        const glm::ivec3 cells = built.frame->cells();
        ASSERT_EQ(pyramid.top(), topLevel(cells));
        for (int level = 1; level <= pyramid.top(); ++level) {
            const KeyFrame& coarse = *pyramid.level(level);
            const int step = 1 << level;
            ASSERT_EQ(coarse.dims(), (cells + step - 1) / step + 1);
            glm::ivec3 i;
            for (i.z = 0; i.z < coarse.dims().z; ++i.z) {
                for (i.y = 0; i.y < coarse.dims().y; ++i.y) {
                    for (i.x = 0; i.x < coarse.dims().x; ++i.x) {
                        glm::ivec3 source = glm::min(i * step, cells);
                        if (c.periodic) source.x %= c.dims.x;
                        ASSERT_TRUE(sameValue(coarse.sample(i), built.samples[sampleAt(c.dims, source)]))
                            << "level " << level << " at " << i.x << ' ' << i.y << ' ' << i.z;
                    }
                }
            }
        }
    }
}

TEST(Pyramid, HullIsThatOfTheBricksBelow) {
    for (const Case& c : kCases) {
        const Built built = build(c, 6);
        const KeyFrame& frame = *built.frame;
        const glm::ivec3 bricks = (frame.cells() + (kBrickSize - 1)) / kBrickSize;
        for (int level = 0; level <= frame.pyramid().top(); ++level) {
            std::map<std::array<int, 3>, ValueRange> wanted;
            glm::ivec3 b;
            for (b.z = 0; b.z < bricks.z; ++b.z) {
                for (b.y = 0; b.y < bricks.y; ++b.y) {
                    for (b.x = 0; b.x < bricks.x; ++b.x) {
                        const ValueRange range = frame.range(frame.linear(b));
                        const auto [found, isNew] =
                            wanted.try_emplace({b.x >> level, b.y >> level, b.z >> level}, range);
                        found->second = {std::min(found->second.min, range.min),
                                         std::max(found->second.max, range.max)};
                    }
                }
            }
            for (const auto& [place, range] : wanted)
                EXPECT_EQ(frame.pyramid().hull(level, {place[0], place[1], place[2]}), range);
        }
    }
}

TEST(Pyramid, TakesNoMoreMemoryThanItsBound) {
    for (const Case& c : kCases) {
        const Built built = build(c, 7);
        EXPECT_LE(built.frame->pyramid().bytes(), Pyramid::largestBytes(c.dims, built.frame->bytes()));
    }
    // A dense frame: the levels are an eighth each of the one below, but for the samples that close bricks.
    const Built dense = build({{128, 128, 128}, false, 0}, 8);
    EXPECT_LT(Pyramid::largestBytes({128, 128, 128}, dense.frame->bytes()), dense.frame->bytes() / 3);
}

TEST(MissingDistance, CountsBricksToTheNearestCellWithoutASample) {
    for (const bool periodic : {false, true}) {
        Lattice lattice = makeUniformLattice({70, 33, 41}, glm::dvec3(0), glm::dvec3(1));
        if (periodic) lattice.axes[0].period = 70;
        std::vector<float> samples = randomFloats(lattice.dims(), 3);
        const std::array<glm::ivec3, 3> missing = {{{0, 5, 5}, {40, 20, 40}, {33, 8, 16}}};
        for (const glm::ivec3 i : missing)
            samples[sampleAt(lattice.dims(), i)] = std::numeric_limits<float>::quiet_NaN();
        const auto frame = makeKeyFrame(lattice, samples);
        const MissingDistance& distance = frame->pyramid().missing();
        ASSERT_FALSE(distance.empty());
        // Bricks whose cells have a missing corner, by looking at every cell; whole bricks count.
        std::vector<glm::ivec3> bricks;
        const glm::ivec3 brickDims = (frame->cells() + 7) / 8;
        glm::ivec3 b;
        for (b.z = 0; b.z < brickDims.z; ++b.z) {
            for (b.y = 0; b.y < brickDims.y; ++b.y) {
                for (b.x = 0; b.x < brickDims.x; ++b.x) {
                    bool touches = false;
                    for (int next = 0; next < 8; ++next) {
                        glm::ivec3 own = b + glm::ivec3(next & 1, next >> 1 & 1, next >> 2);
                        if (periodic && own.x * 8 >= 70) own.x = 0;
                        for (const glm::ivec3 i : missing) touches |= i / 8 == own;
                    }
                    if (touches) bricks.push_back(b);
                }
            }
        }
        glm::ivec3 corner;
        for (corner.z = 0; corner.z <= brickDims.z; ++corner.z) {
            for (corner.y = 0; corner.y <= brickDims.y; ++corner.y) {
                for (corner.x = 0; corner.x <= brickDims.x; ++corner.x) {
                    int wanted = 255;
                    for (const glm::ivec3 brick : bricks) {
                        const glm::ivec3 away =
                            glm::max(glm::max(brick - corner, corner - brick - 1), glm::ivec3(0));
                        wanted = std::min(wanted, away.x + away.y + away.z);
                    }
                    ASSERT_EQ(distance.at(corner), wanted);
                }
            }
        }
    }
}

TEST(MissingDistance, IsEmptyWhereNothingIsMissing) {
    const Lattice lattice = makeUniformLattice({20, 20, 20}, glm::dvec3(0), glm::dvec3(1));
    EXPECT_TRUE(makeKeyFrame(lattice, randomFloats(lattice.dims(), 1))->pyramid().missing().empty());
}

}  // namespace
}  // namespace isoglass
