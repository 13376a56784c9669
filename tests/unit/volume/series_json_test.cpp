#include "volume/series_json.h"

#include "base/error.h"
#include "unit/volume/series_fixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass {
namespace {

SeriesDescription validSeries() {
    SeriesDescription series = test::describe(makeUniformLattice({4, 3, 2}, glm::dvec3(0), glm::dvec3(1)), 3);
    series.frames.resize(3);
    series.time.period = 3;
    series.lattice.axes[0].period = 4;
    return series;
}

/// The message with which a description is refused, "accepted" where it is not.
std::string refusal(const std::string& text) {
    try {
        seriesFromJson(text, "series.vdb");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string refusalOf(const SeriesDescription& series) {
    return refusal(toJson(series));
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(SeriesJson, ValidDescriptionIsAccepted) {
    EXPECT_EQ(refusalOf(validSeries()), "accepted");
}

TEST(SeriesJson, DamagedTextIsRefusedWithItsPlace) {
    const std::string text = toJson(validSeries());
    for (std::size_t length = 0; length < text.size(); ++length) {
        ASSERT_TRUE(contains(refusal(text.substr(0, length)), "(series.vdb)")) << length;
    }
    for (const char* key : {"version",      "name",       "long_name", "units",
                            "axes",         "time",       "frames",    "inactive_is_missing",
                            "stored_error", "provenance", "notes",     "coordinates",
                            "negated",      "times",      "calendar",  "range",
                            "valid",        "active",     "crc32",     "bytes"}) {
        const std::string quoted = '"' + std::string(key) + '"';
        EXPECT_TRUE(contains(refusal(replaced(text, quoted, "\"x\"")), "damaged")) << key;
    }
    EXPECT_TRUE(contains(refusal(replaced(text, "\"version\":1", "\"version\":3")), "version"));
    EXPECT_TRUE(contains(refusal(replaced(text, "\"notes\":[]", "\"notes\":7")), "damaged"));
    EXPECT_TRUE(contains(refusal("[]"), "damaged"));
    EXPECT_TRUE(contains(refusal("null"), "damaged"));
}

TEST(SeriesJson, KeyFramesMustBeAsManyAsTimes) {
    SeriesDescription series = validSeries();
    series.frames.resize(2);
    EXPECT_TRUE(contains(refusalOf(series), "3 times but 2 key frames"));
}

TEST(SeriesJson, LevelsAreAllThereOrNone) {
    SeriesDescription series = validSeries();
    series.lattice = makeUniformLattice({20, 3, 2}, glm::dvec3(0), glm::dvec3(1));  // two coarser levels
    EXPECT_EQ(refusalOf(series), "accepted");
    series.frames[1].levels = {{.checksum = 1, .bytes = 2}, {.checksum = 3, .bytes = 4}};
    EXPECT_EQ(refusalOf(series), "accepted");
    const SeriesDescription read = seriesFromJson(toJson(series), "series.vdb");
    ASSERT_EQ(read.frames[1].levels.size(), 2u);
    EXPECT_EQ(read.frames[1].levels[1].checksum, 3u);
    EXPECT_EQ(read.frames[1].levels[1].bytes, 4u);
    series.frames[1].levels[0].heightsChecksum = 5;
    EXPECT_TRUE(contains(refusalOf(series), "do not agree on heights"));
    series.frames[1].levels.resize(1);
    series.frames[1].levels[0].heightsChecksum.reset();
    EXPECT_TRUE(contains(refusalOf(series), "1 coarser levels instead of 2"));
}

TEST(SeriesJson, TimesMustIncrease) {
    for (const std::vector<double>& times :
         {std::vector<double>{0, 2, 1}, {0, 1, 1}, {2, 1, 0}, {}, {0, HUGE_VAL, 2}}) {
        SeriesDescription series = validSeries();
        series.time.times = times;
        series.time.period.reset();
        series.frames.resize(times.size());
        EXPECT_NE(refusalOf(series), "accepted") << times.size();
    }
}

TEST(SeriesJson, AxesMustBeStrictlyMonotonic) {
    for (const std::vector<double>& coordinates :
         {std::vector<double>{0, 2, 1}, {0, 1, 1, 2}, {3, 2, 2}, {}}) {
        SeriesDescription series = validSeries();
        series.lattice.axes[1].coordinates = coordinates;
        EXPECT_NE(refusalOf(series), "accepted");
    }
    SeriesDescription descending = validSeries();
    descending.lattice.axes[1].coordinates = {2, 1, 0};
    EXPECT_EQ(refusalOf(descending), "accepted");
}

// A period up to the span would put the closing sample on or before the last one.
TEST(SeriesJson, PeriodsMustBeFiniteAndLongerThanTheSpan) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double period : {0.0, -3.0, 1.0, 2.0, kInfinity, -kInfinity, std::nan("")}) {
        SeriesDescription series = validSeries();
        series.time.period = period;
        EXPECT_TRUE(contains(refusalOf(series), "damaged")) << "time " << period;
        series = validSeries();
        series.lattice.axes[1].period = period;
        EXPECT_TRUE(contains(refusalOf(series), "damaged")) << "axis " << period;
        series.lattice.axes[1].coordinates = {2, 1, 0};
        EXPECT_TRUE(contains(refusalOf(series), "damaged")) << "descending axis " << period;
    }
    SeriesDescription series = validSeries();
    series.time.period = 2.0001;
    series.lattice.axes[1].period = 2.0001;
    EXPECT_EQ(refusalOf(series), "accepted");
    const std::string text = toJson(series);
    EXPECT_TRUE(contains(refusal(replaced(text, "2.0001", "2")), "axis y"));
}

TEST(SeriesJson, FloatsAndDoublesComeBackExactly) {
    SeriesDescription series = validSeries();
    series.frames[0].range = {-0x1.fffffep127f, 0x1p-149f};
    series.frames[1].range = {0.1f, 1.0f / 3};
    series.frames[2].range = {std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()};
    series.frames[0].checksum = 0xffffffff;
    series.frames[0].bytes = 1ull << 60;
    series.time.times = {-0.1, 1.0 / 3, 1 + 0x1p-52};
    series.keep = ValueRange{0.1f, 0.7f};
    const SeriesDescription found = seriesFromJson(toJson(series), "series.vdb");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(found.frames[i].range, series.frames[i].range) << i;
    EXPECT_EQ(found.frames[0].checksum, 0xffffffff);
    EXPECT_EQ(found.frames[0].bytes, 1ull << 60);
    EXPECT_EQ(found.time.times, series.time.times);
    EXPECT_EQ(found.keep, series.keep);
}

}  // namespace
}  // namespace isoglass
