#include "base/error.h"
#include "unit/volume/series_fixture.h"
#include "volume/checksum.h"
#include "volume/series_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace isoglass {
namespace {

using test::describe;
using test::MemorySource;

/// A description in which every part says something.
SeriesDescription fullDescription() {
    Lattice lattice = makeUniformLattice({19, 9, 8}, {0.1, -3, 5}, {1.7, 0.3, -2});
    lattice.axes[0].name = "longitude";
    lattice.axes[0].units = "degrees_east";
    lattice.axes[0].period = 360;
    lattice.axes[1].coordinates[4] += 1.0 / 7;
    lattice.axes[2].negated = true;
    lattice.axes[2].units = "m";
    SeriesDescription series = describe(lattice, 3);
    series.name = "TEMP";
    series.longName = "Temp\u00e9rature";
    series.units = "degC";
    series.time.times = {0.1, 366, 1e6 / 3};
    series.time.units = "hours since 0000-01-01";
    series.time.calendar = "noleap";
    series.time.period = 1e6;
    series.provenance = "atlas.nc, NetCDF";
    series.notes = {"Axis z points down.", "A \"quoted\" note\nover two lines."};
    return series;
}

std::vector<std::vector<float>> randomFrames(glm::ivec3 dims, std::size_t count, std::uint32_t missing) {
    std::vector<std::vector<float>> frames;
    for (std::uint32_t i = 0; i < count; ++i) {
        frames.push_back(randomFloats(dims, 10 + i));
        removeSamples(frames.back(), missing, 20 + i);
    }
    return frames;
}

void expectSameAxis(const Axis& a, const Axis& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.units, b.units);
    EXPECT_EQ(a.coordinates, b.coordinates);
    EXPECT_EQ(a.negated, b.negated);
    EXPECT_EQ(a.period, b.period);
}

TEST(Series, EverySampleComesBackBitByBit) {
    const ScratchFolder folder;
    for (const glm::ivec3 dims :
         {glm::ivec3(1), glm::ivec3(8), glm::ivec3(19, 9, 25), glm::ivec3(40, 3, 16)}) {
        for (const std::uint32_t missing : {0u, 20u, 100u}) {
            const SeriesDescription series =
                describe(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), 3);
            MemorySource source(series, randomFrames(dims, 3, missing));
            writeSeries(source, folder / "series.vdb");
            const SeriesFile file(folder / "series.vdb");
            for (std::size_t i = 0; i < 3; ++i) {
                const auto frame = file.read(i);
                EXPECT_EQ(test::firstDifference(*frame, source.frame(i)), -1) << missing << " " << i;
                EXPECT_EQ(frame->bytes(), file.description().frames[i].bytes);
            }
        }
    }
}

TEST(Series, UnusualFloatsComeBackBitByBit) {
    const ScratchFolder folder;
    const glm::ivec3 dims(9, 8, 8);
    auto samples = randomFloats(dims, 1);
    using Limits = std::numeric_limits<float>;
    const std::vector<float> unusual = {-0.0f,         Limits::denorm_min(), -Limits::denorm_min(),
                                        Limits::min(), kLargestValue,        -kLargestValue};
    std::ranges::copy(unusual, samples.begin());
    MemorySource source(describe(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1)), 1), {samples});
    writeSeries(source, folder / "series.vdb");
    EXPECT_EQ(test::firstDifference(*SeriesFile(folder / "series.vdb").read(0), samples), -1);
}

TEST(Series, DescriptionComesBackWhole) {
    const ScratchFolder folder;
    const SeriesDescription wanted = fullDescription();
    MemorySource source(wanted, randomFrames(wanted.lattice.dims(), 3, 10));
    const SeriesDescription written = writeSeries(source, folder / "series.vdb", {.tolerance = 0.125});
    const SeriesFile file(folder / "series.vdb");
    const SeriesDescription& found = file.description();
    EXPECT_EQ(file.path(), folder / "series.vdb");
    EXPECT_EQ(found.name, wanted.name);
    EXPECT_EQ(found.longName, wanted.longName);
    EXPECT_EQ(found.units, wanted.units);
    for (int k = 0; k < 3; ++k) expectSameAxis(found.lattice.axes[k], wanted.lattice.axes[k]);
    EXPECT_EQ(found.time.times, wanted.time.times);
    EXPECT_EQ(found.time.units, wanted.time.units);
    EXPECT_EQ(found.time.calendar, wanted.time.calendar);
    EXPECT_EQ(found.time.period, wanted.time.period);
    EXPECT_TRUE(found.inactiveIsMissing);
    EXPECT_EQ(found.storedError, 0.125);
    EXPECT_EQ(found.keep, std::nullopt);
    EXPECT_EQ(found.provenance, wanted.provenance);
    EXPECT_EQ(found.notes, wanted.notes);
    EXPECT_EQ(toJson(found), toJson(written));
}

TEST(Series, FrameRecordsStateRangeAndCounts) {
    const ScratchFolder folder;
    const glm::ivec3 dims(17, 9, 9);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    auto frames = randomFrames(dims, 3, 25);
    frames[1].assign(frames[1].size(), std::numeric_limits<float>::quiet_NaN());
    MemorySource source(describe(lattice, 3), frames);
    writeSeries(source, folder / "series.vdb");
    const SeriesFile file(folder / "series.vdb");
    for (const std::size_t i : {0u, 2u}) {
        ValueRange range{2, -2};
        std::uint64_t valid = 0;
        for (const float value : frames[i]) {
            if (std::isnan(value)) continue;
            ++valid;
            range = {std::min(range.min, value), std::max(range.max, value)};
        }
        EXPECT_EQ(file.description().frames[i].range, range);
        EXPECT_EQ(file.description().frames[i].validSamples, valid);
        EXPECT_EQ(file.description().frames[i].activeVoxels, valid);
        EXPECT_EQ(file.description().frames[i].checksum, checksum(*makeKeyFrame(lattice, frames[i])));
    }
    EXPECT_EQ(file.description().frames[1].validSamples, 0u);
    EXPECT_GT(file.description().frames[1].range.min, file.description().frames[1].range.max);
}

// Latin-1 text from old files: the series must be written all the same, as valid UTF-8.
TEST(Series, TextThatIsNotUtf8DoesNotSpoilTheFile) {
    const ScratchFolder folder;
    SeriesDescription series = fullDescription();
    series.name = "Temp\xe9rature";
    series.provenance = "Universit\xe4t, \xff\xfe";
    series.notes = {"\x80"};
    MemorySource source(series, randomFrames(series.lattice.dims(), 3, 10));
    writeSeries(source, folder / "series.vdb");
    const SeriesFile file(folder / "series.vdb");
    EXPECT_EQ(file.description().provenance, "Universit\uFFFDt, \uFFFD\uFFFD");
    EXPECT_EQ(file.description().notes, std::vector<std::string>{"\uFFFD"});
    EXPECT_EQ(test::firstDifference(*file.read(2), source.frame(2)), -1);
}

TEST(Series, SameInputGivesTheSameBytes) {
    const ScratchFolder folder;
    const SeriesDescription series = fullDescription();
    MemorySource source(series, randomFrames(series.lattice.dims(), 3, 10));
    writeSeries(source, folder / "a.vdb");
    writeSeries(source, folder / "b.vdb");
    EXPECT_EQ(test::bytesOf(folder / "a.vdb"), test::bytesOf(folder / "b.vdb"));
    auto frames = randomFrames(series.lattice.dims(), 3, 10);
    frames[2][77] = 0.125f;
    MemorySource other(series, frames);
    writeSeries(other, folder / "b.vdb");
    EXPECT_NE(test::bytesOf(folder / "a.vdb"), test::bytesOf(folder / "b.vdb"));
}

TEST(Series, ProgressCountsTheKeyFrames) {
    const ScratchFolder folder;
    const SeriesDescription series = fullDescription();
    MemorySource source(series, randomFrames(series.lattice.dims(), 3, 0));
    std::vector<std::pair<std::size_t, std::size_t>> calls;
    writeSeries(source, folder / "a.vdb", {},
                [&](std::size_t done, std::size_t total) { calls.emplace_back(done, total); });
    EXPECT_EQ(calls, (std::vector<std::pair<std::size_t, std::size_t>>{{1, 3}, {2, 3}, {3, 3}}));
}

TEST(Series, ManyThreadsReadAtOnce) {
    const ScratchFolder folder;
    const SeriesDescription series = fullDescription();
    MemorySource source(series, randomFrames(series.lattice.dims(), 3, 10));
    writeSeries(source, folder / "series.vdb");
    const SeriesFile file(folder / "series.vdb");
    std::array<std::ptrdiff_t, 6> differences;
    differences.fill(-1);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < differences.size(); ++t) {
            threads.emplace_back([&, t] {
                for (int repeat = 0; repeat < 5; ++repeat) {
                    const std::size_t frame = (t + static_cast<std::size_t>(repeat)) % 3;
                    differences[t] = std::max(differences[t],
                                              test::firstDifference(*file.read(frame), source.frame(frame)));
                }
            });
        }
    }
    EXPECT_EQ(*std::ranges::max_element(differences), -1);
}

}  // namespace
}  // namespace isoglass
