#pragma once

#include "volume/time_axis.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace isoglass {

/// The calendars of the CF conventions (section 4.4.1).
enum class Calendar {
    standard,            ///< Julian up to 1582-10-04, Gregorian from 1582-10-15; also "gregorian"
    prolepticGregorian,  ///< Gregorian at all times
    julian,              ///< a leap year every fourth year at all times
    noLeap,              ///< 365 days every year; also "365_day"
    allLeap,             ///< 366 days every year; also "366_day"
    days360,             ///< twelve months of 30 days; "360_day"
    none,                ///< times without dates
};

/// A date and a time of day. Years are astronomical: year 0 exists and is a leap year wherever every
/// 400th year is one, -1 is the year before it.
struct Date {
    std::int64_t year = 0;
    int month = 1;  ///< 1 .. 12
    int day = 1;    ///< 1 .. length of the month
    std::int64_t millisecondOfDay = 0;
    int zoneMinutes = 0;  ///< minutes that the clock is ahead of UTC

    friend bool operator==(const Date&, const Date&) = default;
};

/// What a CF units string says: the length of one unit, and the date of time 0 where it has one.
struct TimeUnits {
    double secondsPerUnit = 1;
    std::optional<Date> reference;
};

/// Largest magnitude of a year that is understood.
inline constexpr std::int64_t kLargestYear = 10'000'000;

/// The calendar that a CF name means, whatever its case; nothing for names that CF does not know. An
/// empty name is `none`: a series whose source has dates always names their calendar.
std::optional<Calendar> calendarFromName(std::string_view name);

/// Mean length of a year in days: 365.2425, 365.25, 365, 366 or 360. Nothing for `none`.
std::optional<double> daysPerYear(Calendar calendar);

/// Days from 0000-01-01 of the proleptic Gregorian calendar (standard, proleptic, julian) or of the
/// calendar itself (the others). Throws Error where the calendar has no such day.
std::int64_t dayNumber(const Date& date, Calendar calendar);

/// The inverse of `dayNumber`: year, month and day at 00:00 UTC.
Date dateOfDay(std::int64_t dayNumber, Calendar calendar);

/// Reads "UNIT" or "UNIT since DATE [TIME] [ZONE]", empty for seconds.
///
/// Units from milliseconds to weeks in the usual spellings ("h", "hr", "hour", "Hours"). Months and
/// years have the fixed lengths that UDUNITS gives them, whatever the calendar: a year is 365.242198781
/// days, a month a twelfth of it. Throws Error for anything else.
TimeUnits parseTimeUnits(std::string_view text);

/// Reads "YYYY-MM-DD", then optionally "T" or a blank and "HH:MM" or "HH:MM:SS[.SSS]", then a zone ("Z",
/// "UTC", "+01:00", "-0330", "+5"). Years may be 0 or negative; fields may have fewer digits. Throws Error.
/// Whether the day exists depends on the calendar: `dayNumber` checks it.
Date parseDate(std::string_view text);

/// ISO 8601: "0000-01-15T06:00:00", with milliseconds where they are not zero, always UTC and so without
/// a zone. `date.zoneMinutes` must be 0.
std::string formatDate(const Date& date);

/// \name Scene time to series time
/// Scene times are numbers or strings. A number is seconds on the clock of the series: the series' time
/// is that number divided by `secondsPerUnit`. A string is an absolute ISO date, translated with the
/// series' own reference date and calendar; a series without them refuses dates.
///@{

/// Seconds in one unit of the axis; 1 where it has no units. Throws Error where they are no units of time.
double secondsPerUnit(const TimeAxis& axis);

/// The series' own time at `seconds` on its clock.
double axisTimeFromSeconds(const TimeAxis& axis, double seconds);

/// The series' own time at an ISO date. Throws Error where the series has no dates, or not that one.
/// To the millisecond for times up to 1e12 seconds from the reference date.
double axisTimeFromDate(const TimeAxis& axis, std::string_view isoDate);

/// The ISO date of a time of the series, rounded to the millisecond. Throws Error where it has no dates.
std::string dateFromAxisTime(const TimeAxis& axis, double time);

/// True when the axis has a reference date and a calendar, so that the two functions above work.
bool hasDates(const TimeAxis& axis);
///@}

}  // namespace isoglass
