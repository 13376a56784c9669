#include "unit/import/import_check.h"
#include "unit/import/netcdf_writer.h"
#include "volume/calendar.h"

#include <gtest/gtest.h>

namespace isoglass {

namespace {

using test::failsWith;
using test::hasNote;
using test::NetcdfWriter;
using test::scratchFile;
using test::writeStandardVolume;

std::unique_ptr<FrameSource> open(NetcdfWriter& writer, const ImportOptions& options = {}) {
    return openNetcdf(writer.close(), options);
}

/// A series of tiny volumes at `times`.
NetcdfWriter& writeSeries(NetcdfWriter& writer, const std::vector<double>& times, const std::string& units) {
    writer.dimension("time", times.size()).dimension("z", 2).dimension("y", 2).dimension("x", 2);
    writer.variable("F", NC_FLOAT, {"time", "z", "y", "x"});
    writer.coordinate("time", times, units);
    return writer.values("F", std::vector<double>(8 * times.size(), 1));
}

std::vector<double> months(double first, double step) {
    std::vector<double> times;
    for (int month = 0; month < 12; ++month) times.push_back(first + month * step);
    return times;
}

TEST(NetcdfTime, UnitsAndCalendarAreKept) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {0, 1, 5}, "days since 1999-12-31").text("time", "calendar", "noleap");
    const TimeAxis time = open(writer)->description().time;
    EXPECT_EQ(time.times, (std::vector<double>{0, 1, 5}));
    EXPECT_EQ(time.units, "days since 1999-12-31");
    EXPECT_EQ(time.calendar, "noleap");
    EXPECT_FALSE(time.period);
    EXPECT_EQ(dateFromAxisTime(time, time.times[2]), "2000-01-05T00:00:00");
}

TEST(NetcdfTime, CalendarIsTheStandardOneWhereNoneIsNamed) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {0, 1}, "days since 1999-12-31");
    EXPECT_EQ(open(writer)->description().time.calendar, "standard");
}

TEST(NetcdfTime, PlainUnitsHaveNoCalendar) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {0, 1}, "hours");
    const TimeAxis time = open(writer)->description().time;
    EXPECT_EQ(time.calendar, "");
    EXPECT_EQ(secondsPerUnit(time), 3600);
}

TEST(NetcdfTime, UnitsThatAreNotUnderstoodAreDroppedAndSaid) {
    for (const char* units : {"model steps", "hours since 0000-00-00", "days since 2001-02-29"}) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writeSeries(writer, {0, 1}, units);
        const SeriesDescription description = open(writer)->description();
        EXPECT_EQ(description.time.units, "") << units;
        EXPECT_EQ(description.time.calendar, "") << units;
        EXPECT_TRUE(hasNote(description, units));
    }
}

TEST(NetcdfTime, UnknownCalendarHasNoDates) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {0, 1}, "days since 2000-01-01").text("time", "calendar", "mayan");
    const SeriesDescription description = open(writer)->description();
    EXPECT_EQ(description.time.calendar, "none");
    EXPECT_TRUE(hasNote(description, "mayan"));
}

TEST(NetcdfTime, VolumeWithoutTimeIsOneKeyFrame) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writer.dimension("z", 2).dimension("y", 2).dimension("x", 2).variable("F", NC_FLOAT, {"z", "y", "x"});
    writer.values("F", {1, 2, 3, 4, 5, 6, 7, 8});
    const auto source = open(writer);
    EXPECT_EQ(source->description().time.times, std::vector<double>{0});
    EXPECT_EQ(test::readFrame(*source, 0), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST(NetcdfTime, GivenTimesReplaceThoseOfTheSource) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {5, 5, 3}, "hours since 2000-01-01");
    const auto path = writer.close();
    const SeriesDescription description = openNetcdf(path, {"", {0, 6, 24}})->description();
    EXPECT_EQ(description.time.times, (std::vector<double>{0, 6, 24}));
    EXPECT_EQ(description.time.units, "hours since 2000-01-01");
    EXPECT_TRUE(hasNote(description, "--times"));
    EXPECT_TRUE(failsWith([&] { openNetcdf(path, {"", {0, 6}}); }, {"2 times for 3 key frames", "--times"}));
    EXPECT_TRUE(failsWith([&] { openNetcdf(path, {"", {0, 6, 6}}); }, {"index 2", "--times"}));
}

TEST(NetcdfTime, TimesThatDoNotIncreaseAreRefused) {
    NetcdfWriter equal(scratchFile("a.nc"));
    writeSeries(equal, {0, 2, 2, 3}, "hours");
    EXPECT_TRUE(failsWith([&] { open(equal); }, {"strictly increase", "index 2", "a.nc, variable time"}));
    NetcdfWriter falling(scratchFile("b.nc"));
    writeSeries(falling, {3, 2, 1}, "hours");
    EXPECT_TRUE(failsWith([&] { open(falling); }, {"strictly increase", "index 1"}));
}

TEST(NetcdfTime, BlankModuloIsTheYearOfTheCalendar) {
    const auto period = [](const char* calendar, double step) {
        NetcdfWriter writer(scratchFile("a.nc"));
        writeSeries(writer, months(step / 2, step), "days since 0000-01-01")
            .text("time", "calendar", calendar);
        writer.text("time", "modulo", " ");
        const SeriesDescription description = open(writer)->description();
        EXPECT_TRUE(hasNote(description, "cyclic (attribute modulo)"));
        return description.time.period.value_or(-1);
    };
    EXPECT_EQ(period("standard", 30.4), 365.2425);
    EXPECT_EQ(period("proleptic_gregorian", 30.4), 365.2425);
    EXPECT_EQ(period("julian", 30.4), 365.25);
    EXPECT_EQ(period("noleap", 30.4), 365);
    EXPECT_EQ(period("all_leap", 30.4), 366);
    EXPECT_EQ(period("360_day", 30), 360);
    // Twelve steps of two hours are a day, and no year.
    EXPECT_DOUBLE_EQ(period("standard", 1.0 / 12), 1);
    EXPECT_DOUBLE_EQ(period("none", 30.4), 12 * 30.4);
}

TEST(NetcdfTime, ModuloGivesThePeriod) {
    NetcdfWriter number(scratchFile("a.nc"));
    writeSeries(number, {0, 3, 6, 9}, "hours").numbers("time", "modulo", NC_DOUBLE, {24});
    EXPECT_EQ(open(number)->description().time.period, 24);
    NetcdfWriter text(scratchFile("b.nc"));
    writeSeries(text, {0, 3, 6, 9}, "hours").text("time", "modulo", "12.5");
    EXPECT_EQ(open(text)->description().time.period, 12.5);
}

TEST(NetcdfTime, ModuloShorterThanTheSeriesIsNotUsed) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {0, 3, 6, 9}, "hours").numbers("time", "modulo", NC_DOUBLE, {9});
    const SeriesDescription description = open(writer)->description();
    EXPECT_FALSE(description.time.period);
    EXPECT_TRUE(hasNote(description, "not cyclic"));
}

TEST(NetcdfTime, ClimatologyIsCyclic) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {45, 136, 228, 319}, "days since 1960-01-01");
    writer.dimension("nv", 2).variable("climatology_bounds", NC_DOUBLE, {"time", "nv"});
    writer.text("time", "climatology", "climatology_bounds");
    const SeriesDescription description = open(writer)->description();
    EXPECT_EQ(description.time.period, 365.2425);
    EXPECT_TRUE(hasNote(description, "attribute climatology"));
}

TEST(NetcdfTime, OneKeyFrameIsNotCyclic) {
    NetcdfWriter writer(scratchFile("a.nc"));
    writeSeries(writer, {45}, "days since 1960-01-01").text("time", "modulo", " ");
    EXPECT_FALSE(open(writer)->description().time.period);
}

}  // namespace

}  // namespace isoglass
