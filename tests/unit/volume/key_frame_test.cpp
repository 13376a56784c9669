#include "unit/volume/series_fixture.h"
#include "volume/checksum.h"
#include "volume/narrow_band.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

const std::vector<glm::ivec3> kSizes = {{1, 1, 1},    {2, 3, 5},   {8, 8, 8},   {9, 8, 7},
                                        {16, 17, 15}, {25, 5, 33}, {7, 24, 16}, {40, 8, 1}};

/// Random samples in which whole bricks are constant or missing.
std::vector<float> patchwork(glm::ivec3 dims, std::uint32_t missingPercent, std::uint32_t seed) {
    auto samples = randomFloats(dims, seed);
    removeSamples(samples, missingPercent, seed + 1);
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x) {
                const auto kind = static_cast<std::uint32_t>(x / 8 * 5 + y / 8 * 3 + z / 8 * 7) + seed;
                if (kind % 4 == 0) samples[sampleAt(dims, {x, y, z})] = 0.25f * static_cast<float>(kind % 3);
                if (kind % 4 == 1) samples[sampleAt(dims, {x, y, z})] = kMissing;
            }
        }
    }
    return samples;
}

ValueRange bruteForceRange(const Lattice& lattice, const std::vector<float>& samples, glm::ivec3 brick) {
    const glm::ivec3 dims = lattice.dims();
    ValueRange range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (int dz = 0; dz <= 8; ++dz) {
        for (int dy = 0; dy <= 8; ++dy) {
            for (int dx = 0; dx <= 8; ++dx) {
                glm::ivec3 i = brick * 8 + glm::ivec3(dx, dy, dz);
                bool exists = true;
                for (int k = 0; k < 3; ++k) {
                    // The sample that closes a periodic axis, where it falls on the brick's far side.
                    if (lattice.axes[k].period && i[k] == dims[k]) i[k] = 0;
                    exists = exists && i[k] < dims[k];
                }
                if (!exists) continue;
                const float value = samples[sampleAt(dims, i)];
                if (std::isnan(value)) continue;
                range = {std::min(range.min, value), std::max(range.max, value)};
            }
        }
    }
    return range;
}

TEST(KeyFrame, SamplesAreThoseGiven) {
    for (const glm::ivec3 dims : kSizes) {
        const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
        for (const std::uint32_t missing : {0u, 10u, 100u}) {
            const auto random = patchwork(dims, missing, 1);
            EXPECT_EQ(test::firstDifference(*makeKeyFrame(lattice, random), random), -1);
            const auto plain = randomFloats(dims, 2);
            EXPECT_EQ(test::firstDifference(*makeKeyFrame(lattice, plain), plain), -1);
        }
    }
}

TEST(KeyFrame, BricksCoverTheDomain) {
    for (const glm::ivec3 dims : kSizes) {
        const auto frame =
            makeKeyFrame(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), randomFloats(dims, 3));
        EXPECT_EQ(frame->dims(), dims);
        EXPECT_EQ(frame->brickDims(), (dims + 7) / 8);
        EXPECT_EQ(frame->brickCount(), sampleCount((dims + 7) / 8));
    }
}

TEST(KeyFrame, ConstantBricksTakeNoSamplesAndMissingOnesSaySo) {
    const glm::ivec3 dims(24, 8, 8);
    std::vector<float> samples = randomFloats(dims, 4);
    for (int z = 0; z < 8; ++z) {
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) {
                samples[sampleAt(dims, {x, y, z})] = 3;
                samples[sampleAt(dims, {x + 8, y, z})] = kMissing;
            }
        }
    }
    const auto frame = makeKeyFrame(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), samples);
    EXPECT_EQ(frame->brick(0).samples, nullptr);
    EXPECT_EQ(frame->brick(0).constant, 3);
    EXPECT_FALSE(frame->brick(0).missing);
    EXPECT_TRUE(frame->brick(1).missing);
    EXPECT_EQ(frame->brick(1).samples, nullptr);
    EXPECT_NE(frame->brick(2).samples, nullptr);
    EXPECT_EQ(frame->brick(2).valid, nullptr) << "no mask where nothing is missing";
}

TEST(KeyFrame, OneMissingSampleGivesAMask) {
    const glm::ivec3 dims(9, 9, 9);
    auto samples = randomFloats(dims, 5);
    samples[sampleAt(dims, {3, 4, 5})] = kMissing;
    const auto frame = makeKeyFrame(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), samples);
    ASSERT_NE(frame->brick(0).valid, nullptr);
    for (int x = 0; x < 8; ++x) {
        const std::uint64_t hole = x == 3 ? std::uint64_t{1} << (4 * 8 + 5) : 0;
        EXPECT_EQ(frame->brick(0).valid[x], ~hole) << x;
    }
    EXPECT_EQ(frame->brick(1).valid, nullptr) << "beyond the domain is not missing";
}

TEST(KeyFrame, ClosedRangesAreThoseOfAllNineCubedSamples) {
    for (const glm::ivec3 dims : kSizes) {
        for (int periodic = 0; periodic < 8; ++periodic) {
            Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
            for (int k = 0; k < 3; ++k) {
                if (periodic >> k & 1) lattice.axes[k].period = dims[k];
            }
            for (const std::uint32_t missing : {0u, 30u, 97u}) {
                const auto samples = patchwork(dims, missing, 6 + static_cast<std::uint32_t>(periodic));
                const auto frame = makeKeyFrame(lattice, samples);
                const glm::ivec3 bricks = frame->brickDims();
                for (int z = 0; z < bricks.z; ++z) {
                    for (int y = 0; y < bricks.y; ++y) {
                        for (int x = 0; x < bricks.x; ++x) {
                            ASSERT_EQ(frame->range(frame->linear({x, y, z})),
                                      bruteForceRange(lattice, samples, {x, y, z}))
                                << dims.x << "x" << dims.y << "x" << dims.z << " brick " << x << " " << y
                                << " " << z << " periodic " << periodic;
                        }
                    }
                }
            }
        }
    }
}

/// One stored brick; `fill` stands under missing samples and outside the domain.
KeyFrame makeOneBrick(glm::ivec3 dims, float fill, std::uint64_t holes) {
    KeyFrame::Pool pool;
    pool.samples.assign(kBrickSamples, fill);
    pool.valid.assign(kBrickSize, 0);
    for (int x = 0; x < dims.x; ++x) {
        for (int y = 0; y < dims.y; ++y) {
            for (int z = 0; z < dims.z; ++z) {
                if (x == 2 && holes >> (y * 8 + z) & 1) continue;
                pool.samples[static_cast<std::size_t>((x * 8 + y) * 8 + z)] = static_cast<float>(x + y - z);
                pool.valid[static_cast<std::size_t>(x)] |= std::uint64_t{1} << (y * 8 + z);
            }
        }
    }
    BrickView view;
    view.samples = pool.samples.data();
    view.valid = pool.valid.data();
    return {dims, glm::bvec3(false), std::move(pool), {view}, {0}};
}

TEST(KeyFrame, RangeAndChecksumIgnoreWhatStandsUnderMissingSamples) {
    const glm::ivec3 dims(5, 6, 8);
    const KeyFrame a = makeOneBrick(dims, 1e30f, 0b1001);
    const KeyFrame b = makeOneBrick(dims, -7, 0b1001);
    const KeyFrame other = makeOneBrick(dims, -7, 0b1011);
    EXPECT_EQ(a.range(0), (ValueRange{-7, 9}));
    EXPECT_EQ(b.range(0), a.range(0));
    EXPECT_TRUE(std::isnan(a.sample({2, 0, 3})));
    EXPECT_EQ(checksum(a), checksum(b));
    EXPECT_NE(checksum(a), checksum(other)) << "which samples are missing counts";
}

TEST(KeyFrame, ChecksumSeesEveryValidSample) {
    const glm::ivec3 dims(17, 8, 8);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const auto samples = randomFloats(dims, 7);
    const std::uint32_t sum = checksum(*makeKeyFrame(lattice, samples));
    EXPECT_EQ(checksum(*makeKeyFrame(lattice, samples)), sum);
    for (const std::size_t i : {std::size_t{0}, samples.size() / 2, samples.size() - 1}) {
        auto changed = samples;
        changed[i] = std::nextafter(changed[i], 2.0f);
        EXPECT_NE(checksum(*makeKeyFrame(lattice, changed)), sum) << i;
    }
}

TEST(KeyFrame, MemoryFollowsTheStoredBricks) {
    const glm::ivec3 dims(64, 64, 64);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const std::size_t dense = sampleCount(dims) * sizeof(float);
    const auto noise = makeKeyFrame(lattice, randomFloats(dims, 8));
    const auto flat = makeKeyFrame(lattice, std::vector<float>(sampleCount(dims), 1));
    EXPECT_GE(noise->bytes(), dense);
    // Tables take below 64 bytes for each brick of 2048.
    EXPECT_LT(noise->bytes(), dense + dense / 32);
    EXPECT_LT(flat->bytes(), dense / 32);
}

TEST(NarrowBand, HoldsTheDistanceInTheBandAndItsEndsElsewhere) {
    const auto frame = makeNarrowBandSphere(41, 10.5, 3);
    for (int z = 0; z < 41; ++z) {
        for (int y = 0; y < 41; ++y) {
            for (int x = 0; x < 41; ++x) {
                const double distance =
                    std::sqrt((x - 20.0) * (x - 20) + (y - 20.0) * (y - 20) + (z - 20.0) * (z - 20)) - 10.5;
                // A difference of two floats below 64 that are rounded once each.
                EXPECT_NEAR(frame->sample({x, y, z}), std::clamp(distance, -3.0, 3.0),
                            64 * std::numeric_limits<float>::epsilon());
            }
        }
    }
}

}  // namespace
}  // namespace isoglass
