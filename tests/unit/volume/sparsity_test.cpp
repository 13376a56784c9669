#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass {
namespace {

using test::MemorySource;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

void fill(std::vector<float>& samples, glm::ivec3 dims, glm::ivec3 from, glm::ivec3 to, float value) {
    for (int z = from.z; z < to.z; ++z) {
        for (int y = from.y; y < to.y; ++y) {
            for (int x = from.x; x < to.x; ++x) samples[sampleAt(dims, {x, y, z})] = value;
        }
    }
}

SeriesDescription writeOne(const Lattice& lattice, const std::vector<float>& samples,
                           const std::filesystem::path& path, const SparsityOptions& options = {}) {
    MemorySource source(test::describe(lattice, 1), {samples});
    return writeSeries(source, path, options);
}

TEST(Sparsity, ConstantBricksBecomeTilesAndMissingSamplesAreNotStored) {
    const ScratchFolder folder;
    const glm::ivec3 dims(32, 16, 16);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    auto samples = randomFloats(dims, 1);
    const auto active = [&] { return writeOne(lattice, samples, folder / "a.vdb").frames[0].activeVoxels; };
    EXPECT_EQ(active(), sampleCount(dims));
    fill(samples, dims, {0, 0, 0}, {8, 8, 8}, 3);
    EXPECT_EQ(active(), sampleCount(dims) - 512) << "one tile";
    fill(samples, dims, {8, 0, 0}, {16, 8, 8}, kMissing);
    EXPECT_EQ(active(), sampleCount(dims) - 1024) << "one brick missing";
    samples[sampleAt(dims, {20, 12, 12})] = kMissing;
    EXPECT_EQ(active(), sampleCount(dims) - 1025);
    samples[sampleAt(dims, {3, 3, 3})] = 3.0000002f;
    EXPECT_EQ(active(), sampleCount(dims) - 513) << "an ulp beside the constant: stored";
    const SeriesDescription series = writeOne(lattice, samples, folder / "a.vdb");
    EXPECT_EQ(series.frames[0].validSamples, sampleCount(dims) - 513);
    EXPECT_EQ(test::firstDifference(*SeriesFile(folder / "a.vdb").read(0), samples), -1);
}

TEST(Sparsity, ConstantSeriesTakesNextToNothing) {
    const ScratchFolder folder;
    const glm::ivec3 dims(128, 128, 128);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const SeriesDescription series =
        writeOne(lattice, std::vector<float>(sampleCount(dims), 1), folder / "a.vdb");
    EXPECT_EQ(series.frames[0].activeVoxels, 0u);
    EXPECT_EQ(series.frames[0].validSamples, sampleCount(dims));
    // The axes' coordinates as text and one node of tiles, against 8 MiB of samples.
    EXPECT_LT(std::filesystem::file_size(folder / "a.vdb"), 100'000u);
    EXPECT_EQ(SeriesFile(folder / "a.vdb").read(0)->sample({127, 0, 64}), 1);
}

TEST(Sparsity, ToleranceBoundsEveryError) {
    const ScratchFolder folder;
    // 33 samples: bricks at the domain's end hold one or a few planes, as most series' do.
    for (const int count : {32, 33}) {
        const Lattice lattice = makeUnitLattice(count);
        auto samples = sampleField(lattice, blobs, 0);
        removeSamples(samples, count == 33 ? 1 : 0, 1);
        std::uint64_t before = std::numeric_limits<std::uint64_t>::max();
        for (const double tolerance : {0.0, 0.001, 0.03, 0.2}) {
            const SeriesDescription series =
                writeOne(lattice, samples, folder / "a.vdb", {.tolerance = tolerance});
            const auto frame = SeriesFile(folder / "a.vdb").read(0);
            EXPECT_EQ(series.storedError, tolerance);
            double largest = 0;
            std::size_t i = 0;
            for (int z = 0; z < count; ++z) {
                for (int y = 0; y < count; ++y) {
                    for (int x = 0; x < count; ++x, ++i) {
                        const float found = frame->sample({x, y, z});
                        ASSERT_EQ(std::isnan(found), std::isnan(samples[i]));
                        if (std::isnan(found)) continue;
                        largest = std::max(largest, std::abs(static_cast<double>(found) - samples[i]));
                    }
                }
            }
            EXPECT_LE(largest, tolerance) << count;
            if (count == 32) {
                EXPECT_LT(series.frames[0].activeVoxels, before) << "sparser at tolerance " << tolerance;
                EXPECT_EQ(largest > 0, tolerance > 0) << "something was given up";
            }
            before = series.frames[0].activeVoxels;
        }
    }
}

TEST(Sparsity, BrickSpanningTwiceTheToleranceIsOneValueAndNoWiderOne) {
    const ScratchFolder folder;
    const glm::ivec3 dims(8);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    std::vector<float> samples(512, 1);
    samples[0] = 1.5f;
    EXPECT_EQ(writeOne(lattice, samples, folder / "a.vdb", {.tolerance = 0.25}).frames[0].activeVoxels, 0u);
    EXPECT_EQ(SeriesFile(folder / "a.vdb").read(0)->sample({3, 3, 3}), 1.25f);
    EXPECT_EQ(writeOne(lattice, samples, folder / "a.vdb", {.tolerance = 0.2499}).frames[0].activeVoxels,
              512u);
}

// Far samples become one value on their side of the interval; everything else stays bit by bit.
TEST(Sparsity, KeepMovesNoSampleAcrossTheInterval) {
    const ScratchFolder folder;
    const Lattice lattice = makeUnitLattice(72);
    const auto samples = sampleField(lattice, growingSphere, 0);
    constexpr ValueRange kKeep{0.28f, 0.32f};
    const SeriesDescription series = writeOne(lattice, samples, folder / "a.vdb", {.keep = kKeep});
    EXPECT_EQ(series.keep, kKeep);
    EXPECT_LT(series.frames[0].activeVoxels, sampleCount(glm::ivec3(72)));
    EXPECT_GT(series.frames[0].activeVoxels, 0u);
    const auto frame = SeriesFile(folder / "a.vdb").read(0);
    std::size_t moved = 0;
    std::size_t i = 0;
    for (int z = 0; z < 72; ++z) {
        for (int y = 0; y < 72; ++y) {
            for (int x = 0; x < 72; ++x, ++i) {
                const float found = frame->sample({x, y, z});
                if (found == samples[i]) continue;
                ++moved;
                const float side = samples[i] < kKeep.min ? std::nextafter(kKeep.min, 0.0f)
                                                          : std::nextafter(kKeep.max, 1.0f);
                ASSERT_EQ(found, side);
                ASSERT_TRUE(samples[i] < kKeep.min || samples[i] > kKeep.max);
            }
        }
    }
    EXPECT_GT(moved, 0u);
}

}  // namespace
}  // namespace isoglass
