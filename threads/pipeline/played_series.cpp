#include "pipeline/played_series.h"

#include "base/error.h"
#include "volume/calendar.h"
#include "volume/series_set.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace isoglass {

namespace {

constexpr double kSamePosition = 1e-9;

double axisTime(const SceneTime& time, const ClockMap& clock, const TimeAxis& axis) {
    const double seconds = std::holds_alternative<double>(time)
                               ? std::get<double>(time)
                               : axisTimeFromDate(axis, std::get<std::string>(time)) * secondsPerUnit(axis);
    return axisTimeFromSeconds(axis, clock.offset + clock.scale * seconds);
}

/// The first key time after `time`, or the last one before it where not `later`, and neither where there is
/// none. Of a series with a period every repetition counts.
std::optional<double> keyTimeBeyond(const TimeAxis& axis, double time, bool later) {
    const std::vector<double>& times = axis.times;
    const double turns = axis.period ? std::floor((time - times.front()) / *axis.period) : 0;
    const double shift = axis.period ? turns * *axis.period : 0;
    if (later) {
        const auto next = std::ranges::upper_bound(times, time - shift);
        if (next != times.end()) return *next + shift;
        return axis.period ? std::optional(times.front() + *axis.period + shift) : std::nullopt;
    }
    const auto next = std::ranges::lower_bound(times, time - shift);
    if (next != times.begin()) return *std::prev(next) + shift;
    return axis.period ? std::optional(times.back() - *axis.period + shift) : std::nullopt;
}

}  // namespace

std::shared_ptr<const SeriesFile> openSeries(const Volume& volume) {
    std::vector<std::filesystem::path> names = {volume.series};
    names.insert(names.end(), volume.moreSeries.begin(), volume.moreSeries.end());
    return openSeriesSet(names);
}

void checkGrid(const Volume& volume, const SeriesDescription& series) {
    if (volume.grid.empty() || volume.grid == series.name) return;
    throw Error("volume '" + volume.name + "' asks for grid '" + volume.grid + "', but the series holds '" +
                    series.name + "'",
                volume.series.string(), "name that grid, or leave \"grid\" out");
}

PlayedSeries playSeries(const Volume& volume, const Timeline& timeline,
                        std::shared_ptr<const SeriesFile> file) {
    const TimeAxis& axis = file->description().time;
    return {file, axisTime(timeline.from, volume.time, axis), axisTime(timeline.to, volume.time, axis)};
}

double keyPositionBeyond(const PlayedSeries& played, double position, bool forwards) {
    const double end = forwards ? 1 : 0;
    const double length = played.to - played.from;
    if (!(std::abs(length) > 0)) return end;
    const double beyond = position + (forwards ? kSamePosition : -kSamePosition);
    const bool later = forwards == (length > 0);
    const auto time = keyTimeBeyond(played.file->description().time, played.timeAt(beyond), later);
    if (!time) return end;
    const double found = (*time - played.from) / length;
    return forwards ? std::min(found, end) : std::max(found, end);
}

}  // namespace isoglass
