#include "volume/cf_time.h"

#include "base/error.h"
#include "volume/calendar.h"
#include "volume/import_times.h"
#include "volume/wrf_times.h"

#include <cmath>
#include <cstddef>
#include <optional>
#include <sstream>

namespace isoglass {

namespace {

constexpr double kYearTolerance = 0.05;
/// A header announces any length in a few bytes; a longer series is not believed.
constexpr std::size_t kMostFrames = std::size_t{1} << 24;

std::string formatted(double value, const std::string& units) {
    std::ostringstream text;
    text.precision(12);
    text << value;
    const std::string unit = units.substr(0, units.find(" since "));
    return text.str() + (unit.empty() ? "" : " " + unit);
}

void readClock(const NetcdfFile& file, const NetcdfVariable& coordinate, TimeAxis& axis,
               std::vector<std::string>& notes) {
    const std::string source = "Time axis " + coordinate.name;
    axis.units = file.text(coordinate, "units").value_or("");
    try {
        const TimeUnits units = parseTimeUnits(axis.units);
        if (!units.reference) return;
        axis.calendar = file.text(coordinate, "calendar").value_or("standard");
        const std::optional<Calendar> calendar = calendarFromName(axis.calendar);
        if (!calendar) {
            notes.push_back(source + " has the calendar \"" + axis.calendar +
                            "\", which is not known: it has no dates.");
            axis.calendar = "none";
        } else if (*calendar != Calendar::none) {
            dayNumber(*units.reference, *calendar);
        }
    } catch (const Error& error) {
        notes.push_back(source + " is taken as seconds without dates, because its units \"" + axis.units +
                        "\" are not understood: " + error.what() + ".");
        axis.units.clear();
        axis.calendar.clear();
    }
}

bool hasReferenceDate(const NetcdfFile& file, const NetcdfVariable& coordinate) {
    return file.text(coordinate, "units").value_or("").find(" since ") != std::string::npos;
}

std::optional<double> yearLength(const TimeAxis& axis) {
    const std::optional<Calendar> calendar = calendarFromName(axis.calendar);
    const std::optional<double> days = calendar ? daysPerYear(*calendar) : std::nullopt;
    if (!days) return std::nullopt;
    return *days * 86400 / secondsPerUnit(axis);
}

void readCycle(const NetcdfFile& file, const NetcdfVariable& coordinate, TimeAxis& axis,
               std::vector<std::string>& notes) {
    const bool modulo = file.has(coordinate, "modulo");
    if ((!modulo && !file.has(coordinate, "climatology")) || axis.times.size() < 2) return;
    const double span = axis.times.back() - axis.times.front();
    const double cover =
        span / static_cast<double>(axis.times.size() - 1) * static_cast<double>(axis.times.size());
    const std::string source = "Time axis " + coordinate.name + " is cyclic (attribute " +
                               (modulo ? "modulo" : "climatology") + "): it repeats after ";

    const std::optional<double> year = yearLength(axis);
    if (const std::optional<double> number = numericModulo(file, coordinate)) {
        if (!(*number > span)) {
            notes.push_back("Time axis " + coordinate.name + " has modulo " + formatted(*number, axis.units) +
                            ", which its key frames exceed: it is not cyclic here.");
            return;
        }
        axis.period = number;
        notes.push_back(source + formatted(*number, axis.units) + ".");
    } else if (year && std::abs(cover - *year) <= kYearTolerance * *year && *year > span) {
        axis.period = year;
        notes.push_back(source + formatted(*year, axis.units) + ", the year of the calendar " +
                        axis.calendar + ".");
    } else {
        axis.period = cover;
        notes.push_back(source + formatted(cover, axis.units) + ", the mean step times the key frames.");
    }
}

}  // namespace

TimeAxis readTimeAxis(const NetcdfFile& file, const NetcdfVariable& variable, const GridShape& shape,
                      const std::vector<double>& replacement, std::vector<std::string>& notes) {
    TimeAxis axis;
    const NetcdfVariable* coordinate = shape.time ? shape.coordinates[*shape.time] : nullptr;
    const std::size_t frames = shape.time ? file.dimension(variable.dimensions[*shape.time]).length : 1;
    if (frames == 0) throw Error("the variable has no time steps", file.place(variable));
    if (frames > kMostFrames)
        throw Error(std::to_string(frames) + " time steps are too many", file.place(variable));

    std::string place = file.place(coordinate ? *coordinate : variable);
    const bool dated = coordinate && hasReferenceDate(file, *coordinate);
    if (shape.time && !dated && replacement.empty()) {
        const auto dates = readWrfTimes(file, variable.dimensions[*shape.time], notes);
        if (dates) {
            requireTimes(dates->times, frames, file.path().string() + ", variable Times");
            return *dates;
        }
    }
    if (!replacement.empty()) {
        axis.times = replacement;
        place = "--times";
        notes.push_back("Times are those of --times, not of the source.");
    } else if (coordinate) {
        axis.times = file.values(*coordinate);
    } else {
        for (std::size_t i = 0; i < frames; ++i) axis.times.push_back(static_cast<double>(i));
        if (shape.time)
            notes.push_back(
                "Time dimension " + file.dimension(variable.dimensions[*shape.time]).name +
                " has no coordinates in the source: key frames are one second apart; --times gives others.");
    }
    requireTimes(axis.times, frames, place);
    if (coordinate) {
        readClock(file, *coordinate, axis, notes);
        readCycle(file, *coordinate, axis, notes);
    }
    return axis;
}

}  // namespace isoglass
