#include "unit/import/import_check.h"
#include "volume/calendar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace isoglass {

namespace {

using test::failsWith;
using test::hasNote;
using test::readFrame;

const std::filesystem::path kExcerpt = std::filesystem::path(ISOGLASS_DATA_FOLDER) / "ocean_excerpt.nc";

std::size_t missingCount(const std::vector<float>& samples) {
    return static_cast<std::size_t>(
        std::ranges::count_if(samples, [](float value) { return std::isnan(value); }));
}

/// Folder of the real data, empty where the machine has none.
std::filesystem::path realData() {
    const char* folder = std::getenv("ISOGLASS_DATA");
    return folder ? folder : "";
}

TEST(OceanExcerpt, AxesAreThoseOfTheAtlas) {
    const SeriesDescription description = openNetcdf(kExcerpt, {})->description();
    EXPECT_EQ(description.name, "TEMP");
    EXPECT_EQ(description.longName, "Temperature");
    EXPECT_EQ(description.units, "");
    const auto& [x, y, z] = description.lattice.axes;
    ASSERT_EQ(x.size(), 36u);
    ASSERT_EQ(y.size(), 23u);
    ASSERT_EQ(z.size(), 19u);
    EXPECT_EQ(x.coordinates.front(), 20.5);
    EXPECT_EQ(x.coordinates.back(), 370.5);
    EXPECT_EQ(x.period, 360);
    EXPECT_EQ(y.coordinates.front(), -89.5);
    EXPECT_FALSE(y.period);
    EXPECT_TRUE(z.negated);
    EXPECT_EQ(z.coordinates[1], -10);
    EXPECT_EQ(z.coordinates.back(), -1000);
    EXPECT_TRUE(hasNote(description, "ZAXLEVIT19 points down"));
    EXPECT_EQ(description.provenance,
              "ocean_excerpt.nc, NetCDF, variable TEMP; history: FERRET V6.08   28-Nov-07");
}

TEST(OceanExcerpt, YearIsCyclic) {
    const TimeAxis time = openNetcdf(kExcerpt, {})->description().time;
    ASSERT_EQ(time.times.size(), 12u);
    EXPECT_EQ(time.times[0], 366);
    EXPECT_EQ(time.units, "hour since 0000-01-01 00:00:00");
    // 365.2425 days of 24 hours.
    EXPECT_DOUBLE_EQ(*time.period, 8765.82);
    EXPECT_EQ(dateFromAxisTime(time, time.times[0]), "0000-01-16T06:00:00");
    const TimeSample newYear = locate(time, axisTimeFromDate(time, "0000-12-31T12:00"));
    EXPECT_EQ(newYear.frameA, 11u);
    EXPECT_EQ(newYear.frameB, 0u);
}

TEST(OceanExcerpt, LandIsMissingInEveryMonth) {
    const auto source = openNetcdf(kExcerpt, {});
    const std::vector<float> january = readFrame(*source, 0);
    for (std::size_t month = 0; month < 12; ++month) {
        const std::vector<float> samples = readFrame(*source, month);
        // The whole atlas misses 39.4 %; every 20th column of it differs by 1 % at most.
        EXPECT_NEAR(static_cast<double>(missingCount(samples)) / static_cast<double>(samples.size()), 0.394,
                    0.01);
        for (std::size_t i = 0; i < samples.size(); ++i) {
            ASSERT_EQ(std::isnan(samples[i]), std::isnan(january[i])) << "sample " << i;
            // Sea water is liquid and nowhere warmer than 35 degrees.
            ASSERT_FALSE(samples[i] < -3 || samples[i] > 35) << samples[i] << " at " << i;
        }
    }
}

TEST(ReliefExcerpt, IsNoVolume) {
    const auto relief = std::filesystem::path(ISOGLASS_DATA_FOLDER) / "relief_excerpt.nc";
    EXPECT_TRUE(failsWith([&] { openNetcdf(relief, {}); }, {"ROSE(ETOPO60Y, ETOPO60X)"}));
}

TEST(RealData, StormSequenceIsRead) {
    if (realData().empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(realData() / "storm"))
        if (entry.path().filename().string().starts_with("Storm.pvm-t")) files.push_back(entry.path());
    std::ranges::sort(files);
    const auto source = openPvm(files, {});
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.name, "Storm");
    EXPECT_EQ(description.time.times.size(), 21u);
    EXPECT_EQ(description.lattice.axes[0].size(), 28u);
    EXPECT_EQ(description.lattice.axes[1].size(), 28u);
    EXPECT_EQ(description.lattice.axes[2].size(), 23u);
    float largest = 0;
    for (std::size_t frame = 0; frame < 21; ++frame)
        largest = std::max(largest, std::ranges::max(readFrame(*source, frame)));
    // The surfaces of the published figure are at 25, 76 and 128.
    EXPECT_GT(largest, 128);
    EXPECT_LE(largest, 255);
}

TEST(RealData, ForecastWithAuxiliaryTimesIsRead) {
    if (realData().empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const std::filesystem::path file = realData() / "katrina" / "mercator_sample.nc";
    EXPECT_TRUE(failsWith([&] { openNetcdf(file, {}); },
                          {"several", "QCLOUD(Time, bottom_top, south_north, west_east)"}));
    const auto source = openNetcdf(file, {"QCLOUD", {}});
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.units, "kg kg-1");
    EXPECT_EQ(description.time.times, (std::vector<double>{720, 900, 1080, 1260}));
    EXPECT_EQ(dateFromAxisTime(description.time, 720), "2005-08-28T12:00:00");
    EXPECT_EQ(description.lattice.axes[2].size(), 14u);
    EXPECT_TRUE(hasNote(description, "Axis bottom_top has no coordinates"));
    EXPECT_EQ(description.lattice.axes[0].coordinates.back(), 470'000) << "47 cells of 10 km";
    const std::vector<float> samples = readFrame(*source, 3);
    EXPECT_EQ(missingCount(samples), 0u);
    EXPECT_GE(std::ranges::min(samples), 0);
    EXPECT_GT(std::ranges::max(samples), 5e-5f);
}

TEST(RealData, WindOfTheForecastIsDerivedAtItsHeights) {
    if (realData().empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const std::filesystem::path file = realData() / "katrina" / "mercator_sample.nc";
    const auto source = openNetcdf(file, {"speed = sqrt(U^2 + V^2)", {}, "(PH + PHB) / 9.81"});
    const SeriesDescription& description = source->description();
    EXPECT_EQ(description.lattice.dims(), glm::ivec3(48, 48, 14));
    std::vector<float> heights(test::sampleCount(description));
    for (std::size_t frame = 0; frame < 4; ++frame) {
        const std::vector<float> speed = readFrame(*source, frame);
        EXPECT_EQ(missingCount(speed), 0u);
        EXPECT_GT(std::ranges::max(speed), 35) << "a hurricane";
        EXPECT_LT(std::ranges::max(speed), 100) << "faster than any wind at sea";
        source->readHeights(frame, heights);
        // Over the sea and the low land around it the lowest of the 14 levels lies tens of metres high; the
        // highest is where the pressure has halved, as the file's cut says: five to six kilometres.
        EXPECT_GT(std::ranges::min(heights), 0);
        EXPECT_LT(std::ranges::min(heights), 100);
        EXPECT_GT(std::ranges::max(heights), 5000);
        EXPECT_LT(std::ranges::max(heights), 6000);
    }
}

}  // namespace

}  // namespace isoglass
