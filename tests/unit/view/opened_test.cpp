#include "app/view/opened.h"

#include "base/error.h"
#include "scene/scene_file.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <gtest/gtest.h>

#include <fstream>

namespace isoglass {
namespace {

TEST(MomentText, DatesToTheMinuteOrTheSecond) {
    TimeAxis axis{
        .times = {0, 6, 12}, .units = "hours since 2005-08-28", .calendar = "standard", .period = {}};
    EXPECT_EQ(momentText(axis, 7.51), "2005-08-28 07:30");
    axis.units = "seconds since 2005-08-28";
    EXPECT_EQ(momentText(axis, 61), "2005-08-28 00:01:01");
}

TEST(MomentText, PlainTimesWithTheirUnits) {
    EXPECT_EQ(momentText({.times = {0, 1}, .units = "s", .calendar = "", .period = {}}, 2.5), "2.5 s");
    EXPECT_EQ(momentText({.times = {0, 1}, .units = "", .calendar = "", .period = {}}, 3), "3");
}

class OpenedTest : public testing::Test {
  protected:
    ScratchFolder folder_;

    std::filesystem::path writeSeries(std::vector<double> times, std::optional<double> period = {}) const {
        SeriesDescription description = test::describe(makeUnitLattice(9), times.size());
        description.time.times = times;
        description.time.period = period;
        std::vector<std::vector<float>> frames;
        for (const double time : times) frames.push_back(sampleField(description.lattice, blobs, time));
        test::MemorySource source(std::move(description), std::move(frames));
        const auto path = folder_ / "blobs.vdb";
        isoglass::writeSeries(source, path);
        return path;
    }

    std::filesystem::path writeScene(const std::string& name, const std::string& time) const {
        const auto path = folder_ / name;
        std::ofstream(path) << R"({"version": 1, "volumes": [{"series": "blobs.vdb",
            "surfaces": [{"iso": 0.5}]}], "time": )"
                            << time << "}";
        return path;
    }

    static Opened open(const std::filesystem::path& path) { return openForViewing(path, {64, 48}, {}); }
};

TEST_F(OpenedTest, SeriesAndScenesWhateverTheirNames) {
    const auto series = writeSeries({0, 1, 4});
    EXPECT_EQ(open(series).scene.image.size, glm::ivec2(64, 48));
    EXPECT_EQ(open(writeScene("some.txt", R"({"from": 0, "to": 4, "duration": 2})")).scene.time.duration, 2);
    EXPECT_EQ(open(series).name, "blobs");
}

TEST_F(OpenedTest, KeyPositionsAreThoseOfTheKeyFramesOnTheTimeline) {
    const auto series = writeSeries({0, 1, 4});
    EXPECT_EQ(open(series).keyPositions(), (std::vector<double>{0, 0.25, 1}));
    const auto part = writeScene("part.json", R"({"from": 0.5, "to": 2.5, "duration": 2})");
    EXPECT_EQ(open(part).keyPositions(), (std::vector<double>{0.25}));
    const auto backwards = writeScene("back.json", R"({"from": 4, "to": 0, "duration": 2})");
    EXPECT_EQ(open(backwards).keyPositions(), (std::vector<double>{0, 0.75, 1}));
    EXPECT_TRUE(open(writeScene("still.json", R"({"from": 1})")).keyPositions().empty());
}

TEST_F(OpenedTest, ACyclicSeriesHasItsKeyFramesInEveryTurn) {
    writeSeries({0, 1, 2, 3}, 4.0);
    const auto turns = writeScene("turns.json", R"({"from": 2, "to": 8, "duration": 2})");
    const std::vector<double> positions = open(turns).keyPositions();
    ASSERT_EQ(positions.size(), 6u);
    // Six sixths, each within the rounding of a few operations.
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(positions[i], static_cast<double>(i) / 6, 1e-15);
}

TEST_F(OpenedTest, WhatCannotBeOpenedIsNamed) {
    EXPECT_THROW(open(folder_ / "none.vdb"), Error);
    EXPECT_THROW(open(folder_.path()), Error);
    std::ofstream(folder_ / "text.txt") << "hello";
    EXPECT_THROW(open(folder_ / "text.txt"), Error);
}

}  // namespace
}  // namespace isoglass
