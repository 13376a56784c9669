#include "volume/calendar.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace isoglass {

namespace {

constexpr std::int64_t kMillisecondsPerDay = 86'400'000;
constexpr double kSecondsPerDay = 86400;
/// UDUNITS: the tropical year of 365.242198781 days.
constexpr double kSecondsPerYear = 365.242198781 * kSecondsPerDay;
/// Day numbers of 0000-01-01 Julian and of 1582-10-15, both from 0000-01-01 Gregorian.
constexpr std::int64_t kJulianOrigin = -2;
constexpr std::int64_t kGregorianStart = 578'101;

struct CalendarNames {
    Calendar calendar;
    std::string_view name;
};

constexpr std::array kCalendarNames{
    CalendarNames{Calendar::standard, "standard"},
    CalendarNames{Calendar::standard, "gregorian"},
    CalendarNames{Calendar::prolepticGregorian, "proleptic_gregorian"},
    CalendarNames{Calendar::julian, "julian"},
    CalendarNames{Calendar::noLeap, "noleap"},
    CalendarNames{Calendar::noLeap, "365_day"},
    CalendarNames{Calendar::allLeap, "all_leap"},
    CalendarNames{Calendar::allLeap, "366_day"},
    CalendarNames{Calendar::days360, "360_day"},
    CalendarNames{Calendar::none, "none"},
    CalendarNames{Calendar::none, ""},
};

struct UnitName {
    std::string_view name;
    double seconds;
};

constexpr std::array kUnitNames{
    UnitName{"", 1},
    UnitName{"ms", 1e-3},
    UnitName{"msec", 1e-3},
    UnitName{"msecs", 1e-3},
    UnitName{"millisecond", 1e-3},
    UnitName{"milliseconds", 1e-3},
    UnitName{"s", 1},
    UnitName{"sec", 1},
    UnitName{"secs", 1},
    UnitName{"second", 1},
    UnitName{"seconds", 1},
    UnitName{"min", 60},
    UnitName{"mins", 60},
    UnitName{"minute", 60},
    UnitName{"minutes", 60},
    UnitName{"h", 3600},
    UnitName{"hr", 3600},
    UnitName{"hrs", 3600},
    UnitName{"hour", 3600},
    UnitName{"hours", 3600},
    UnitName{"d", kSecondsPerDay},
    UnitName{"day", kSecondsPerDay},
    UnitName{"days", kSecondsPerDay},
    UnitName{"week", 7 * kSecondsPerDay},
    UnitName{"weeks", 7 * kSecondsPerDay},
    UnitName{"month", kSecondsPerYear / 12},
    UnitName{"months", kSecondsPerYear / 12},
    UnitName{"yr", kSecondsPerYear},
    UnitName{"yrs", kSecondsPerYear},
    UnitName{"year", kSecondsPerYear},
    UnitName{"years", kSecondsPerYear},
};

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
    return lower;
}

std::int64_t floorDiv(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

bool isLeapYear(std::int64_t year, Calendar rule) {
    switch (rule) {
        case Calendar::prolepticGregorian:
            return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
        case Calendar::julian:
            return year % 4 == 0;
        case Calendar::allLeap:
            return true;
        default:
            return false;
    }
}

int daysInMonth(std::int64_t year, int month, Calendar rule) {
    if (rule == Calendar::days360) return 30;
    constexpr std::array kDays{31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return kDays[month - 1] + (month == 2 && isLeapYear(year, rule) ? 1 : 0);
}

/// Days from 0000-01-01 to the first day of `year`, by one rule for all years.
std::int64_t dayOfYearStart(std::int64_t year, Calendar rule) {
    const std::int64_t fourths = floorDiv(year + 3, 4);
    switch (rule) {
        case Calendar::prolepticGregorian:
            return 365 * year + fourths - floorDiv(year + 99, 100) + floorDiv(year + 399, 400);
        case Calendar::julian:
            return kJulianOrigin + 365 * year + fourths;
        case Calendar::allLeap:
            return 366 * year;
        case Calendar::days360:
            return 360 * year;
        default:
            return 365 * year;
    }
}

std::int64_t dayByRule(const Date& date, Calendar rule) {
    std::int64_t day = dayOfYearStart(date.year, rule) + date.day - 1;
    for (int month = 1; month < date.month; ++month) day += daysInMonth(date.year, month, rule);
    return day;
}

Date dateByRule(std::int64_t day, Calendar rule) {
    Date date;
    date.year = static_cast<std::int64_t>(std::floor(static_cast<double>(day) / *daysPerYear(rule)));
    while (dayOfYearStart(date.year, rule) > day) --date.year;
    while (dayOfYearStart(date.year + 1, rule) <= day) ++date.year;
    std::int64_t rest = day - dayOfYearStart(date.year, rule);
    for (; rest >= daysInMonth(date.year, date.month, rule); ++date.month)
        rest -= daysInMonth(date.year, date.month, rule);
    date.day = static_cast<int>(rest) + 1;
    return date;
}

std::int64_t instantMilliseconds(const Date& date, Calendar calendar) {
    return dayNumber(date, calendar) * kMillisecondsPerDay + date.millisecondOfDay -
           std::int64_t{date.zoneMinutes} * 60'000;
}

/// Reads a date from the front of a text, field by field.
class DateScanner {
  public:
    explicit DateScanner(std::string_view text) : text_(text), rest_(text) {}

    Date scan() {
        skipBlanks();
        Date date;
        const bool negative = accept('-');
        if (!negative) accept('+');
        date.year = number() * (negative ? -1 : 1);
        expect('-');
        date.month = static_cast<int>(number());
        expect('-');
        date.day = static_cast<int>(number());
        if (!accept('T') && !accept('t')) skipBlanks();
        if (!rest_.empty() && isDigit(rest_.front())) date.millisecondOfDay = timeOfDay();
        skipBlanks();
        date.zoneMinutes = zone();
        skipBlanks();
        if (!rest_.empty()) fail();
        if (std::abs(date.year) > kLargestYear || date.month < 1 || date.month > 12 || date.day < 1 ||
            date.day > 31)
            fail();
        return date;
    }

  private:
    static bool isDigit(char c) { return c >= '0' && c <= '9'; }

    [[noreturn]] void fail() const {
        throw Error("not a date", "\"" + std::string(text_) + "\"",
                    "write YYYY-MM-DD or YYYY-MM-DDTHH:MM:SS");
    }

    void skipBlanks() {
        while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    }

    bool accept(char c) {
        if (rest_.empty() || rest_.front() != c) return false;
        rest_.remove_prefix(1);
        return true;
    }

    void expect(char c) {
        if (!accept(c)) fail();
    }

    std::int64_t number() {
        if (rest_.empty() || !isDigit(rest_.front())) fail();
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{} || value > kLargestYear) fail();
        digits_ = static_cast<std::size_t>(end - rest_.data());
        rest_.remove_prefix(digits_);
        return value;
    }

    std::int64_t timeOfDay() {
        const std::int64_t hour = number();
        expect(':');
        const std::int64_t minute = number();
        const std::int64_t second = accept(':') ? number() : 0;
        if (hour > 23 || minute > 59 || second > 59) fail();
        return ((hour * 60 + minute) * 60 + second) * 1000 + (accept('.') ? millisecond() : 0);
    }

    std::int64_t millisecond() {
        std::int64_t value = 0;
        std::int64_t weight = 100;
        for (; !rest_.empty() && isDigit(rest_.front()); rest_.remove_prefix(1), weight /= 10)
            value += weight * (rest_.front() - '0');
        return value;
    }

    int zone() {
        for (const std::string_view utc : {"utc", "gmt", "z"})
            if (lowerCase(rest_) == utc) {
                rest_ = {};
                return 0;
            }
        const bool west = accept('-');
        if (!west && !accept('+')) return 0;
        std::int64_t hours = number();
        std::int64_t minutes = 0;
        if (accept(':'))
            minutes = number();
        else if (digits_ > 2) {
            minutes = hours % 100;
            hours /= 100;
        }
        if (hours > 23 || minutes > 59) fail();
        const int ahead = static_cast<int>(hours * 60 + minutes);
        return west ? -ahead : ahead;
    }

    std::string_view text_;
    std::string_view rest_;
    std::size_t digits_ = 0;  ///< length of the number read last
};

struct Clock {
    TimeUnits units;
    Calendar calendar;
    std::int64_t referenceMilliseconds;
};

Clock clockOf(const TimeAxis& axis) {
    const TimeUnits units = parseTimeUnits(axis.units);
    const std::optional<Calendar> calendar = calendarFromName(axis.calendar);
    if (!units.reference || !calendar || *calendar == Calendar::none)
        throw Error("the series has no dates",
                    "time units \"" + axis.units + "\", calendar \"" + axis.calendar + "\"",
                    "give times as numbers, in seconds");
    return {units, *calendar, instantMilliseconds(*units.reference, *calendar)};
}

}  // namespace

std::optional<Calendar> calendarFromName(std::string_view name) {
    const auto* found = std::ranges::find(kCalendarNames, lowerCase(name), &CalendarNames::name);
    if (found == kCalendarNames.end()) return std::nullopt;
    return found->calendar;
}

std::optional<double> daysPerYear(Calendar calendar) {
    switch (calendar) {
        case Calendar::standard:
        case Calendar::prolepticGregorian:
            return 365.2425;
        case Calendar::julian:
            return 365.25;
        case Calendar::noLeap:
            return 365;
        case Calendar::allLeap:
            return 366;
        case Calendar::days360:
            return 360;
        case Calendar::none:
            break;
    }
    return std::nullopt;
}

std::int64_t dayNumber(const Date& date, Calendar calendar) {
    Calendar rule = calendar;
    bool exists = calendar != Calendar::none;
    if (calendar == Calendar::standard) {
        const std::int64_t gregorian = dayByRule(date, Calendar::prolepticGregorian);
        const std::int64_t julian = dayByRule(date, Calendar::julian);
        rule = gregorian >= kGregorianStart ? Calendar::prolepticGregorian : Calendar::julian;
        exists = gregorian >= kGregorianStart || julian < kGregorianStart;
    }
    if (!exists || date.day > daysInMonth(date.year, date.month, rule))
        throw Error("no such day in the calendar of the series",
                    formatDate({date.year, date.month, date.day}));
    return dayByRule(date, rule);
}

Date dateOfDay(std::int64_t dayNumber, Calendar calendar) {
    if (calendar == Calendar::standard)
        return dateByRule(dayNumber,
                          dayNumber >= kGregorianStart ? Calendar::prolepticGregorian : Calendar::julian);
    return dateByRule(dayNumber, calendar);
}

TimeUnits parseTimeUnits(std::string_view text) {
    const std::string lower = lowerCase(text);
    const std::size_t since = lower.find(" since ");
    std::string unit = lower.substr(0, since);
    unit.erase(0, unit.find_first_not_of(' '));
    unit.erase(unit.find_last_not_of(' ') + 1);
    const auto* found = std::ranges::find(kUnitNames, unit, &UnitName::name);
    if (found == kUnitNames.end() || (since != std::string::npos && unit.empty()))
        throw Error("not units of time", "\"" + std::string(text) + "\"",
                    "write UNIT or \"UNIT since YYYY-MM-DD\" with seconds, minutes, hours, days, weeks, "
                    "months or years");
    TimeUnits units{found->seconds, std::nullopt};
    if (since != std::string::npos) units.reference = parseDate(text.substr(since + 7));
    return units;
}

Date parseDate(std::string_view text) {
    return DateScanner(text).scan();
}

std::string formatDate(const Date& date) {
    const std::int64_t ms = date.millisecondOfDay;
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%s%04lld-%02d-%02dT%02d:%02d:%02d", date.year < 0 ? "-" : "",
                  static_cast<long long>(std::abs(date.year)), date.month, date.day,
                  static_cast<int>(ms / 3'600'000), static_cast<int>(ms / 60'000 % 60),
                  static_cast<int>(ms / 1000 % 60));
    std::string result = text.data();
    if (ms % 1000 != 0) {
        std::snprintf(text.data(), text.size(), ".%03d", static_cast<int>(ms % 1000));
        result += text.data();
    }
    return result;
}

double secondsPerUnit(const TimeAxis& axis) {
    return parseTimeUnits(axis.units).secondsPerUnit;
}

double axisTimeFromSeconds(const TimeAxis& axis, double seconds) {
    return seconds / secondsPerUnit(axis);
}

double axisTimeFromDate(const TimeAxis& axis, std::string_view isoDate) {
    const Clock clock = clockOf(axis);
    const std::int64_t elapsed =
        instantMilliseconds(parseDate(isoDate), clock.calendar) - clock.referenceMilliseconds;
    return static_cast<double>(elapsed) / 1000 / clock.units.secondsPerUnit;
}

std::string dateFromAxisTime(const TimeAxis& axis, double time) {
    const Clock clock = clockOf(axis);
    const double elapsed = time * clock.units.secondsPerUnit * 1000;
    constexpr double kLargestElapsed = 2.0 * kLargestYear * 366 * kMillisecondsPerDay;
    if (!(std::abs(elapsed) <= kLargestElapsed))
        throw Error("time is too far from the reference date", std::to_string(time) + " " + axis.units);
    const std::int64_t instant = clock.referenceMilliseconds + std::llround(elapsed);
    const std::int64_t day = floorDiv(instant, kMillisecondsPerDay);
    Date date = dateOfDay(day, clock.calendar);
    date.millisecondOfDay = instant - day * kMillisecondsPerDay;
    return formatDate(date);
}

bool hasDates(const TimeAxis& axis) {
    const Calendar calendar = calendarFromName(axis.calendar).value_or(Calendar::none);
    return calendar != Calendar::none && parseTimeUnits(axis.units).reference.has_value();
}

}  // namespace isoglass
