#include "base/error.h"
#include "support/terrain_lattice.h"
#include "unit/volume/series_fixture.h"
#include "volume/checksum.h"
#include "volume/narrow_band.h"
#include "volume/pyramid.h"
#include "volume/series_set.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <limits>

namespace isoglass {
namespace {

using test::MemorySource;

constexpr std::size_t kFrames = 2;

std::vector<float> samplesOf(const KeyFrame& frame) {
    std::vector<float> samples;
    const glm::ivec3 dims = frame.dims();
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x) samples.push_back(frame.sample({x, y, z}));
        }
    }
    return samples;
}

/// Also in the same bricks.
void expectSame(const KeyFrame& read, const KeyFrame& built) {
    ASSERT_EQ(read.dims(), built.dims());
    EXPECT_EQ(test::firstDifference(read, samplesOf(built)), -1);
    EXPECT_EQ(checksum(read), checksum(built));
    for (std::size_t i = 0; i < read.brickCount(); ++i) ASSERT_EQ(read.range(i), built.range(i)) << i;
}

void expectLevelsOfPyramids(const SeriesFile& file, int levels) {
    for (std::size_t i = 0; i < file.description().frames.size(); ++i) {
        const auto frame = file.read(i);
        const Pyramid& pyramid = frame->pyramid();
        ASSERT_EQ(pyramid.top(), levels);
        ASSERT_EQ(file.description().frames[i].levels.size(), static_cast<std::size_t>(levels));
        for (int level = 1; level <= levels; ++level) {
            const auto read = file.readLevel(i, level);
            expectSame(*read, *pyramid.level(level));
            EXPECT_EQ(read->bytes(), file.description().frames[i].levels[level - 1].bytes);
            ASSERT_EQ(read->heights() != nullptr, frame->heights() != nullptr);
            if (read->heights()) expectSame(*read->heights(), *frame->heights()->pyramid().level(level));
        }
    }
}

struct Case {
    glm::ivec3 dims;
    bool periodic;
    std::uint32_t missingPercent;
    int levels;
};

/// Noise beside a block of one value and a block that is missing altogether.
MemorySource makeSource(const Case& c) {
    Lattice lattice = makeUniformLattice(c.dims, glm::dvec3(0), glm::dvec3(1));
    if (c.periodic) lattice.axes[0].period = c.dims.x;
    std::vector<std::vector<float>> frames;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
        std::vector<float> samples = randomFloats(c.dims, 7 + frame);
        removeSamples(samples, c.missingPercent, 70 + frame);
        for (int z = 0; z < c.dims.z; ++z) {
            for (int y = 0; y < c.dims.y; ++y) {
                for (int x = 0; x < std::min(c.dims.x, 32); ++x) {
                    if (y >= 16) continue;
                    float& sample = samples[sampleAt(c.dims, {x, y, z})];
                    sample = x < 16 ? 0.25f : std::numeric_limits<float>::quiet_NaN();
                }
            }
        }
        frames.push_back(std::move(samples));
    }
    return {test::describe(lattice, kFrames), std::move(frames)};
}

TEST(StoredLevels, AreThoseOfThePyramidBitByBit) {
    const ScratchFolder folder;
    for (const Case& c : std::array<Case, 5>{{{{65, 33, 20}, false, 0, 3},
                                              {{70, 31, 17}, true, 10, 4},
                                              {{33, 1, 9}, false, 3, 2},
                                              {{9, 9, 9}, false, 0, 0},
                                              {{40, 20, 12}, false, 100, 3}}}) {
        MemorySource source = makeSource(c);
        writeSeries(source, folder / "series.vdb");
        expectLevelsOfPyramids(SeriesFile(folder / "series.vdb"), c.levels);
    }
}

TEST(StoredLevels, BringTheirHeights) {
    const ScratchFolder folder;
    const test::TerrainLattice terrain({33, 20, 9}, 0);
    class Source final : public FrameSource {
      public:
        explicit Source(const test::TerrainLattice& of)
            : terrain(of), series(test::describe(of.lattice, 1)) {}
        const SeriesDescription& description() const override { return series; }
        void read(std::size_t, std::span<float> out) override {
            std::ranges::copy(randomFloats({33, 20, 9}, 3), out.begin());
        }
        void readHeights(std::size_t, std::span<float> out) override {
            std::ranges::copy(terrain.heights(0.3), out.begin());
        }
        const test::TerrainLattice& terrain;
        SeriesDescription series;
    } source(terrain);
    writeSeries(source, folder / "series.vdb");
    expectLevelsOfPyramids(SeriesFile(folder / "series.vdb"), 2);
}

/// What is not stored there has the value of the tree, not none.
TEST(StoredLevels, OfANarrowBandHaveItsBackground) {
    const ScratchFolder folder;
    writeNarrowBandSphere(folder / "band.vdb", 70, 20, 3);
    const SeriesFile file(folder / "band.vdb");
    expectLevelsOfPyramids(file, 4);
    EXPECT_EQ(file.readLevel(0, 1)->sample({0, 0, 0}), 3);
}

TEST(StoredLevels, LieWhereTheirSamplesAre) {
    Lattice lattice = makeUniformLattice({11, 9, 1}, glm::dvec3(2), glm::dvec3(0.5));
    for (double& x : lattice.axes[0].coordinates) x = 20 - x * x;  // uneven, descending
    lattice.axes[1].period = 7;
    for (int level = 0; level <= 2; ++level) {
        const Lattice coarse = coarseLattice(lattice, level);
        EXPECT_EQ(coarse.bounds(), lattice.bounds());
        for (std::size_t k = 0; k < 3; ++k) {
            const Axis& fine = lattice.axes[k];
            for (std::size_t i = 0; i < coarse.axes[k].size(); ++i) {
                EXPECT_EQ(coarse.axes[k].coordinates[i], fine.coordinate(std::min(i << level, fine.cells())));
            }
        }
    }
    EXPECT_EQ(coarseLattice(lattice, 2).dims(), glm::ivec3(4, 4, 1));
    EXPECT_EQ(coarseLattice(lattice, 0).axes[1].period, 7);
}

TEST(StoredLevels, MayBeLeftOut) {
    const ScratchFolder folder;
    MemorySource source = makeSource({{65, 33, 20}, false, 5, 3});
    writeSeries(source, folder / "with.vdb");
    writeSeries(source, folder / "without.vdb", {.levels = false});
    const SeriesFile with(folder / "with.vdb");
    const SeriesFile without(folder / "without.vdb");
    EXPECT_LT(std::filesystem::file_size(without.path()), std::filesystem::file_size(with.path()));
    for (std::size_t i = 0; i < kFrames; ++i) {
        EXPECT_TRUE(without.description().frames[i].levels.empty());
        expectSame(*without.read(i), *with.read(i));
    }
    EXPECT_THROW(without.readLevel(0, 1), Error);
    EXPECT_THROW(with.readLevel(0, 4), Error);
    EXPECT_THROW(with.readLevel(0, -1), Error);
    EXPECT_THROW(with.readLevel(kFrames, 0), Error);
}

TEST(StoredLevels, OfSeveralFilesInARow) {
    const ScratchFolder folder;
    for (const int file : {0, 1}) {
        MemorySource source = makeSource({{33, 20, 9}, false, 5, 2});
        SeriesDescription series = source.description();
        for (double& time : series.time.times) time += 10 * file;
        MemorySource shifted(series, {source.frame(0), source.frame(1)});
        writeSeries(shifted, folder / ("part" + std::to_string(file) + ".vdb"));
    }
    const std::vector<std::filesystem::path> names = {folder / "part*.vdb"};
    expectLevelsOfPyramids(*openSeriesSet(names), 2);
}

/// The levels come first in the file.
TEST(StoredLevels, DamageIsNamed) {
    const ScratchFolder folder;
    const auto path = folder / "series.vdb";
    MemorySource source = makeSource({{65, 33, 20}, false, 5, 3});
    writeSeries(source, path);
    const SeriesFile file(path);
    std::string bytes = test::bytesOf(path);
    constexpr std::size_t kInsideTheFirst = 20'000;
    for (std::size_t i = 0; i < 64; ++i) {
        char& byte = bytes.at(kInsideTheFirst + i);
        byte = static_cast<char>(~byte);
    }
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    try {
        file.readLevel(0, 1);
        FAIL() << "nothing was noticed";
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("key frame 0, level 1"), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace isoglass
