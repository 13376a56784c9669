#include "volume/calendar.h"

#include "unit/import/import_check.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace isoglass {

namespace {

using test::failsWith;

constexpr std::array kDatedCalendars{Calendar::standard, Calendar::prolepticGregorian,
                                     Calendar::julian,   Calendar::noLeap,
                                     Calendar::allLeap,  Calendar::days360};

TimeAxis axis(const std::string& units, const std::string& calendar = "standard") {
    return {{0}, units, calendar, std::nullopt};
}

TEST(Calendar, NamesOfTheConventionsAreKnownInAnyCase) {
    EXPECT_EQ(calendarFromName("Gregorian"), Calendar::standard);
    EXPECT_EQ(calendarFromName("standard"), Calendar::standard);
    EXPECT_EQ(calendarFromName("PROLEPTIC_GREGORIAN"), Calendar::prolepticGregorian);
    EXPECT_EQ(calendarFromName("365_day"), calendarFromName("noleap"));
    EXPECT_EQ(calendarFromName("366_day"), calendarFromName("all_leap"));
    EXPECT_EQ(calendarFromName("360_day"), Calendar::days360);
    EXPECT_EQ(calendarFromName("julian"), Calendar::julian);
    EXPECT_EQ(calendarFromName(""), Calendar::none);
    EXPECT_EQ(calendarFromName("mayan"), std::nullopt);
}

TEST(Calendar, EveryDayFollowsTheOneBeforeIt) {
    // Three centuries around year 0 and around the change of 1582: all rules of leap years occur.
    for (const Calendar calendar : kDatedCalendars)
        for (const std::int64_t start : {-60'000, 540'000})
            for (std::int64_t day = start; day < start + 110'000; ++day) {
                const Date date = dateOfDay(day, calendar);
                ASSERT_EQ(dayNumber(date, calendar), day)
                    << formatDate(date) << " calendar " << int(calendar);
            }
}

TEST(Calendar, KnownJulianDayNumbersAreMet) {
    // Julian day numbers at noon, less that of 0000-01-01 Gregorian (1721060).
    constexpr std::int64_t kOrigin = 1'721'060;
    EXPECT_EQ(dayNumber({2000, 1, 1}, Calendar::standard), 2'451'545 - kOrigin);
    EXPECT_EQ(dayNumber({1582, 10, 15}, Calendar::standard), 2'299'161 - kOrigin);
    EXPECT_EQ(dayNumber({1582, 10, 4}, Calendar::standard), 2'299'160 - kOrigin);
    EXPECT_EQ(dayNumber({-4712, 1, 1}, Calendar::julian), -kOrigin);
    EXPECT_EQ(dayNumber({-4713, 11, 24}, Calendar::prolepticGregorian), -kOrigin);
    EXPECT_EQ(dayNumber({1970, 1, 1}, Calendar::prolepticGregorian), 2'440'588 - kOrigin);
}

TEST(Calendar, YearsHaveTheirLength) {
    const auto length = [](std::int64_t year, Calendar calendar) {
        return dayNumber({year + 1, 1, 1}, calendar) - dayNumber({year, 1, 1}, calendar);
    };
    EXPECT_EQ(length(0, Calendar::prolepticGregorian), 366);
    EXPECT_EQ(length(0, Calendar::standard), 366);
    EXPECT_EQ(length(1582, Calendar::standard), 355);
    EXPECT_EQ(length(1500, Calendar::standard), 366);
    EXPECT_EQ(length(1500, Calendar::prolepticGregorian), 365);
    EXPECT_EQ(length(1900, Calendar::julian), 366);
    EXPECT_EQ(length(1900, Calendar::standard), 365);
    EXPECT_EQ(length(2000, Calendar::noLeap), 365);
    EXPECT_EQ(length(2001, Calendar::allLeap), 366);
    EXPECT_EQ(length(-1, Calendar::days360), 360);
}

TEST(Calendar, DaysThatDoNotExistAreRefused) {
    EXPECT_TRUE(failsWith(
        [] {
            dayNumber({2001, 2, 29}, Calendar::standard);
        },
        {"no such day", "2001-02-29"}));
    EXPECT_TRUE(failsWith([] { dayNumber({1582, 10, 5}, Calendar::standard); }, {"1582-10-05"}));
    EXPECT_TRUE(failsWith([] { dayNumber({1582, 10, 14}, Calendar::standard); }, {"1582-10-14"}));
    EXPECT_TRUE(failsWith([] { dayNumber({2000, 1, 31}, Calendar::days360); }, {"2000-01-31"}));
    EXPECT_TRUE(failsWith([] { dayNumber({2000, 2, 29}, Calendar::noLeap); }, {"2000-02-29"}));
    EXPECT_TRUE(failsWith([] { dayNumber({2000, 1, 1}, Calendar::none); }, {"no such day"}));
    EXPECT_NO_THROW(dayNumber({2000, 2, 30}, Calendar::days360));
    EXPECT_NO_THROW(dayNumber({2001, 2, 29}, Calendar::allLeap));
}

TEST(Calendar, UnitsOfTimeHaveTheirSeconds) {
    EXPECT_EQ(parseTimeUnits("").secondsPerUnit, 1);
    EXPECT_EQ(parseTimeUnits("s").secondsPerUnit, 1);
    EXPECT_EQ(parseTimeUnits("milliseconds").secondsPerUnit, 1e-3);
    EXPECT_EQ(parseTimeUnits("minutes since 2000-01-01").secondsPerUnit, 60);
    EXPECT_EQ(parseTimeUnits("hour since 0000-01-01 00:00:00").secondsPerUnit, 3600);
    EXPECT_EQ(parseTimeUnits(" Hours ").secondsPerUnit, 3600);
    EXPECT_EQ(parseTimeUnits("Days Since 1900-1-1").secondsPerUnit, 86400);
    EXPECT_EQ(parseTimeUnits("weeks").secondsPerUnit, 604800);
    EXPECT_DOUBLE_EQ(parseTimeUnits("years").secondsPerUnit, 365.242198781 * 86400);
    EXPECT_DOUBLE_EQ(parseTimeUnits("months since 0000-01-01").secondsPerUnit, 365.242198781 / 12 * 86400);
    for (const char* bad :
         {"metres", "since 2000-01-01", "days since", "days since yesterday", "hours of 2000-01-01"})
        EXPECT_TRUE(failsWith([bad] { parseTimeUnits(bad); }, {"not"})) << bad;
}

TEST(Calendar, ReferenceDatesAreReadAsTheConventionsWriteThem) {
    const auto reference = [](const char* units) { return *parseTimeUnits(units).reference; };
    EXPECT_EQ(reference("s since 1992-10-8 15:15:42.5 -6:00"), (Date{1992, 10, 8, 54'942'500, -360}));
    EXPECT_EQ(reference("s since 1992-10-08T15:15:42Z"), (Date{1992, 10, 8, 54'942'000, 0}));
    EXPECT_EQ(reference("s since 1992-10-08 15:15 +0530"), (Date{1992, 10, 8, 54'900'000, 330}));
    EXPECT_EQ(reference("s since 1-1-1 00:00:0.0 UTC"), (Date{1, 1, 1, 0, 0}));
    EXPECT_EQ(reference("s since 1992-10-08 15:15 +1"), (Date{1992, 10, 8, 54'900'000, 60}));
    EXPECT_EQ(reference("hours since 0000-01-01"), (Date{0, 1, 1, 0, 0}));
    EXPECT_EQ(reference("hours since -0044-03-15"), (Date{-44, 3, 15, 0, 0}));
}

TEST(Calendar, WhatIsNoDateIsRefused) {
    for (const char* bad : {"", "2000", "2000-01", "2000-13-01", "2000-00-10", "2000-01-32",
                            "2000-01-01T24:00", "2000-01-01T12:60", "2000-01-01T12", "2000-01-01T12:00:60",
                            "2000-01-01 noon", "99999999999-01-01", "2000-01-01T00:00+99", "2000-01-01x"})
        EXPECT_TRUE(failsWith([bad] { parseDate(bad); }, {"not a date", bad})) << bad;
}

TEST(Calendar, DatesAreWrittenAsIso8601) {
    EXPECT_EQ(formatDate({0, 1, 15, 6 * 3'600'000}), "0000-01-15T06:00:00");
    EXPECT_EQ(formatDate({-44, 3, 15, 86'399'001}), "-0044-03-15T23:59:59.001");
    EXPECT_EQ(formatDate({12000, 12, 31}), "12000-12-31T00:00:00");
    EXPECT_EQ(parseDate("0000-01-15T06:00:00"), (Date{0, 1, 15, 6 * 3'600'000}));
    EXPECT_EQ(parseDate("-0044-03-15T23:59:59.0019"), (Date{-44, 3, 15, 86'399'001}));
}

TEST(Calendar, DateAndTimeOfASeriesTranslateBothWays) {
    const TimeAxis climatology = axis("hour since 0000-01-01 00:00:00");
    EXPECT_EQ(dateFromAxisTime(climatology, 366), "0000-01-16T06:00:00");
    EXPECT_EQ(axisTimeFromDate(climatology, "0000-01-16T06:00"), 366);
    EXPECT_EQ(axisTimeFromDate(climatology, "-0001-12-31"), -24);
    EXPECT_EQ(dateFromAxisTime(axis("days since 2000-01-01", "360_day"), 59), "2000-02-30T00:00:00");
    EXPECT_EQ(dateFromAxisTime(axis("days since 2000-02-28", "noleap"), 1), "2000-03-01T00:00:00");
    EXPECT_EQ(dateFromAxisTime(axis("days since 1582-10-04"), 1), "1582-10-15T00:00:00");
    // The clock of the reference date is six hours behind UTC.
    EXPECT_EQ(dateFromAxisTime(axis("hours since 2000-01-01 00:00 -6:00"), 0), "2000-01-01T06:00:00");
    EXPECT_EQ(axisTimeFromDate(axis("hours since 2000-01-01"), "2000-01-01T06:00+06:00"), 0);
}

TEST(Calendar, MillisecondsSurviveAtModernEpochs) {
    const char* moment = "2033-05-18T03:33:20.007";
    const TimeAxis seconds = axis("seconds since 1970-01-01");
    EXPECT_EQ(axisTimeFromDate(seconds, moment), 2'000'000'000.007);
    for (const char* units : {"seconds since 1970-01-01", "days since 1970-01-01", "hours since 0001-01-01",
                              "weeks since 1900-01-01", "months since 1850-01-01"})
        EXPECT_EQ(dateFromAxisTime(axis(units), axisTimeFromDate(axis(units), moment)), moment) << units;
}

TEST(Calendar, SceneSecondsFollowTheUnitsOfTheSeries) {
    EXPECT_EQ(axisTimeFromSeconds(axis("hours since 2000-01-01"), 7200), 2);
    EXPECT_EQ(axisTimeFromSeconds(axis("", ""), 7200), 7200);
    EXPECT_EQ(secondsPerUnit(axis("s", "")), 1);
    EXPECT_EQ(secondsPerUnit(axis("hours", "")), 3600);
    EXPECT_TRUE(failsWith([] { secondsPerUnit(axis("furlongs", "")); }, {"not units of time", "furlongs"}));
}

TEST(Calendar, SeriesWithoutDatesRefusesThem) {
    for (const TimeAxis& dateless :
         {axis("", ""), axis("hours", "standard"), axis("days since 2000-01-01", "none"),
          axis("days since 2000-01-01", "")}) {
        EXPECT_FALSE(hasDates(dateless));
        EXPECT_TRUE(
            failsWith([&] { axisTimeFromDate(dateless, "2000-01-01"); }, {"has no dates", "seconds"}));
        EXPECT_TRUE(failsWith([&] { dateFromAxisTime(dateless, 0); }, {"has no dates"}));
    }
    EXPECT_TRUE(hasDates(axis("days since 2000-01-01")));
}

TEST(Calendar, TimesBeyondAllYearsAreRefused) {
    EXPECT_TRUE(failsWith([] { dateFromAxisTime(axis("days since 2000-01-01"), 1e300); }, {"too far"}));
    EXPECT_TRUE(
        failsWith([] { dateFromAxisTime(axis("days since 2000-01-01"), std::nan("")); }, {"too far"}));
}

}  // namespace

}  // namespace isoglass
