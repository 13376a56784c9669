#include "pipeline/played_series.h"

#include "base/error.h"
#include "volume/calendar.h"
#include "volume/series_set.h"

#include <vector>

namespace isoglass {

namespace {

double axisTime(const SceneTime& time, const ClockMap& clock, const TimeAxis& axis) {
    const double seconds = std::holds_alternative<double>(time)
                               ? std::get<double>(time)
                               : axisTimeFromDate(axis, std::get<std::string>(time)) * secondsPerUnit(axis);
    return axisTimeFromSeconds(axis, clock.offset + clock.scale * seconds);
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

}  // namespace isoglass
