#include "base/error.h"
#include "support/terrain_lattice.h"
#include "unit/volume/series_fixture.h"
#include "volume/series_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass {
namespace {

using test::firstDifference;
using test::MemorySource;
using test::TerrainLattice;

constexpr std::size_t kFrames = 3;
constexpr glm::ivec3 kDims(13, 20, 9);

class TerrainSource final : public FrameSource {
  public:
    explicit TerrainSource(const TerrainLattice& terrain)
        : description_(test::describe(terrain.lattice, kFrames)) {
        for (std::size_t i = 0; i < kFrames; ++i) {
            heights.push_back(terrain.heights(0.4 * static_cast<double>(i)));
            samples.push_back(randomFloats(kDims, static_cast<std::uint32_t>(i)));
            removeSamples(samples.back(), 20, 9);
            // A height may be missing where the sample is.
            for (std::size_t s = 0; s < samples.back().size(); s += 3)
                if (std::isnan(samples.back()[s])) heights.back()[s] = samples.back()[s];
        }
    }

    const SeriesDescription& description() const override { return description_; }
    void read(std::size_t frame, std::span<float> out) override {
        std::ranges::copy(samples[frame], out.begin());
    }
    void readHeights(std::size_t frame, std::span<float> out) override {
        std::ranges::copy(heights[frame], out.begin());
    }

    std::vector<std::vector<float>> samples;
    std::vector<std::vector<float>> heights;

  private:
    SeriesDescription description_;
};

TEST(SeriesHeights, AreReadBackBitByBit) {
    const ScratchFolder folder;
    for (const int mirror : {0, 4}) {
        const TerrainLattice terrain(kDims, mirror);
        TerrainSource source(terrain);
        const auto path = folder / "series.vdb";
        const SeriesDescription written =
            writeSeries(source, path, {.tolerance = 0.1, .keep = ValueRange{2, 3}});
        const SeriesFile file(path);
        const HeightField& found = file.description().lattice.heights.value();
        EXPECT_EQ(found, written.lattice.heights);
        EXPECT_EQ(found.name, "terrain");
        float low = 1;
        float high = 1;
        for (std::size_t i = 0; i < kFrames; ++i) {
            const auto frame = file.read(i);
            ASSERT_TRUE(frame->heights());
            EXPECT_EQ(firstDifference(*frame->heights(), source.heights[i]), -1)
                << "tolerance and kept range are for the samples alone";
            EXPECT_EQ(frame->bytes(), file.description().frames[i].bytes);
            EXPECT_GT(frame->bytes(), frame->heights()->bytes());
            for (const float height : source.heights[i]) {
                low = std::fmin(low, height);
                high = std::fmax(high, height);
            }
        }
        EXPECT_EQ(found.min, low);
        EXPECT_EQ(found.max, high);
        EXPECT_EQ(file.description().lattice.mirrored(), mirror == 4);
    }
}

TEST(SeriesHeights, SameSourceGivesTheSameBytes) {
    const ScratchFolder folder;
    const TerrainLattice terrain(kDims);
    TerrainSource source(terrain);
    writeSeries(source, folder / "a.vdb");
    writeSeries(source, folder / "b.vdb");
    EXPECT_EQ(test::bytesOf(folder / "a.vdb"), test::bytesOf(folder / "b.vdb"));
}

TEST(SeriesHeights, SourceWithoutHeightsCannotAnnounceThem) {
    const ScratchFolder folder;
    const TerrainLattice terrain(kDims);
    MemorySource source(test::describe(terrain.lattice, 1), {terrain.heights(0)});
    EXPECT_THROW(writeSeries(source, folder / "series.vdb"), std::logic_error);
    EXPECT_FALSE(std::filesystem::exists(folder / "series.vdb"));
}

SeriesDescription described() {
    SeriesDescription series = test::describe(TerrainLattice(kDims).lattice, 2);
    series.frames.resize(2);
    for (FrameRecord& frame : series.frames) frame.heightsChecksum = 7;
    return series;
}

std::string refusalOf(const SeriesDescription& series) {
    try {
        seriesFromJson(toJson(series), "series.vdb");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

TEST(SeriesHeights, DescriptionThatContradictsItselfIsRefused) {
    EXPECT_EQ(refusalOf(described()), "accepted");
    EXPECT_EQ(seriesFromJson(toJson(described()), "").frames[1].heightsChecksum, 7u);
    SeriesDescription series = described();
    series.frames[1].heightsChecksum.reset();
    EXPECT_NE(refusalOf(series).find("do not agree on heights"), std::string::npos);
    series = described();
    series.lattice.heights.reset();
    EXPECT_NE(refusalOf(series).find("do not agree on heights"), std::string::npos);
    series = described();
    series.lattice.heights->max = -3;
    EXPECT_NE(refusalOf(series).find("range of heights"), std::string::npos);
    series = described();
    series.lattice.axes[2].period = 100;
    EXPECT_NE(refusalOf(series).find("periodic"), std::string::npos);
}

/// Programs that know no heights must refuse the file instead of showing it flat.
TEST(SeriesHeights, HaveAVersionOfTheirOwn) {
    SeriesDescription series = described();
    EXPECT_NE(toJson(series).find("\"version\":2"), std::string::npos);
    series.lattice.heights.reset();
    EXPECT_NE(toJson(series).find("\"version\":1"), std::string::npos);
}

TEST(SeriesHeights, WidenTheBoundsOfTheLattice) {
    Lattice lattice = makeUniformLattice({3, 3, 3}, glm::dvec3(0), glm::dvec3(1));
    lattice.heights = HeightField{"h", "m", -5, 9};
    EXPECT_EQ(lattice.bounds()[0], glm::dvec3(0, 0, -5));
    EXPECT_EQ(lattice.bounds()[1], glm::dvec3(2, 2, 9));
}

}  // namespace
}  // namespace isoglass
