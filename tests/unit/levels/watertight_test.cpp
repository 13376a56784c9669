#include "unit/levels/watertight_check.h"
#include "unit/surface/surface_check.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace isoglass {
namespace {

using test::expectWatertight;
using test::Kind;
using test::LevelCase;
using test::levelCounts;
using test::Totals;

/// How many random views to try: ISOGLASS_VIEWS, else as many as take a few seconds.
std::uint32_t viewCount() {
    const char* count = std::getenv("ISOGLASS_VIEWS");
    return count ? static_cast<std::uint32_t>(std::atoi(count)) : 30;
}

// Sizes that are no multiple of bricks or levels, down to one cell.
constexpr std::array<glm::ivec3, 9> kDims = {{{33, 33, 33},
                                              {61, 57, 64},
                                              {48, 37, 50},
                                              {100, 20, 31},
                                              {70, 70, 2},
                                              {2, 90, 35},
                                              {65, 65, 65},
                                              {130, 9, 12},
                                              {57, 61, 44}}};

TEST(Levels, RandomViewsAreWatertight) {
    Totals totals;
    for (std::uint32_t seed = 0; seed < viewCount() && !HasFailure(); ++seed) {
        const auto kind = static_cast<Kind>(seed % test::kKinds);
        expectWatertight(test::makeLevelCase(seed, kind, kDims[seed % kDims.size()]), totals);
    }
    std::printf("%zu views, %zu triangles, bricks by%s\n", totals.views, totals.triangles,
                levelCounts(totals).c_str());
    for (int level = 0; level <= 2; ++level) EXPECT_GT(totals.bricks[level], 50u) << level;
}

/// Makes the case one of the error metric, from so much that all is coarse to nothing.
void useErrorMetric(LevelCase& c, std::uint32_t seed) {
    test::Dice dice(seed + 1000);
    View& view = *c.options.view;
    view.cellPixels = 0;
    view.errorPixels = std::exp(dice.between(std::log(1.0), std::log(300.0)));
}

TEST(Levels, RandomViewsByTheErrorMetricAreWatertight) {
    Totals totals;
    constexpr std::array kSmoothKinds = {Kind::blobs, Kind::gyroid, Kind::rough, Kind::blobs, Kind::steps};
    constexpr std::array<glm::ivec3, 4> kLargeDims = {
        {{90, 70, 81}, {65, 65, 65}, {130, 19, 60}, {70, 70, 2}}};
    for (std::uint32_t seed = 0; seed < viewCount() && !HasFailure(); ++seed) {
        LevelCase c = test::makeLevelCase(seed + 2000, kSmoothKinds[seed % kSmoothKinds.size()],
                                          kLargeDims[seed % kLargeDims.size()]);
        useErrorMetric(c, seed);
        expectWatertight(c, totals);
    }
    std::printf("%zu views, %zu triangles, bricks by%s\n", totals.views, totals.triangles,
                levelCounts(totals).c_str());
    for (int level = 0; level <= 2; ++level) EXPECT_GT(totals.bricks[level], 20u) << level;
}

TEST(Levels, ThreadsDoNotChangeABit) {
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        LevelCase c = test::makeLevelCase(seed + 3000, static_cast<Kind>(seed % test::kKinds),
                                          seed % 2 == 0 ? glm::ivec3(90, 70, 81) : glm::ivec3(65));
        if (seed % 2 == 1) useErrorMetric(c, seed);
        if (seed % 4 >= 2) {
            for (std::size_t i = 0; i < 40; ++i)
                c.samples[i % 2][7919 * i + 101] = std::numeric_limits<float>::quiet_NaN();
            test::rebuild(c);
        }
        c.options.still = seed % 3 == 0;
        c.options.threads = 1;
        const SurfaceMesh one = extractSurface(c.lattice, c.field, c.options).mesh;
        EXPECT_FALSE(one.empty()) << c.name;
        for (const int threads : {2, 3, 7}) {
            c.options.threads = threads;
            EXPECT_TRUE(test::sameBytes(one, extractSurface(c.lattice, c.field, c.options).mesh))
                << c.name << ", " << threads << " threads";
        }
    }
}

// Each hole of a few samples, or a slab as land under an ocean; in one of the key frames or in both.
TEST(Levels, ViewsOfFieldsWithMissingSamplesAreWatertightBesideThem) {
    Totals totals;
    constexpr std::array kKindsOfWater = {Kind::blobs, Kind::gyroid, Kind::steps};
    for (std::uint32_t seed = 0; seed < viewCount() / 3 && !HasFailure(); ++seed) {
        const glm::ivec3 dims = seed % 2 == 0 ? glm::ivec3(170, 28, 33) : glm::ivec3(40, 120, 41);
        LevelCase c = test::makeLevelCase(seed + 500, kKindsOfWater[seed % kKindsOfWater.size()], dims);
        test::Dice dice(seed);
        for (int hole = 0; hole < 3; ++hole) {
            glm::ivec3 begin;
            glm::ivec3 end;
            for (int k = 0; k < 3; ++k) {
                begin[k] = static_cast<int>(dice.below(dims[k]));
                end[k] = std::min(dims[k], begin[k] + 1 + static_cast<int>(dice.below(hole == 0 ? 12 : 3)));
            }
            const std::uint32_t which = dice.below(3);
            glm::ivec3 i;
            for (i.z = begin.z; i.z < end.z; ++i.z) {
                for (i.y = begin.y; i.y < end.y; ++i.y) {
                    for (i.x = begin.x; i.x < end.x; ++i.x) {
                        const std::size_t place =
                            (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
                        if (which != 1) c.samples[0][place] = std::numeric_limits<float>::quiet_NaN();
                        if (which != 0) c.samples[1][place] = std::numeric_limits<float>::quiet_NaN();
                    }
                }
            }
        }
        test::rebuild(c);
        if (seed % 2 == 1) useErrorMetric(c, seed);
        expectWatertight(c, totals);
    }
    std::printf("%zu views, %zu triangles, bricks by%s\n", totals.views, totals.triangles,
                levelCounts(totals).c_str());
    for (int level = 0; level <= 1; ++level) EXPECT_GT(totals.bricks[level], 20u) << level;
}

}  // namespace
}  // namespace isoglass
