#include "base/error.h"
#include "fuzz/fuzz.h"
#include "volume/series_json.h"

namespace isoglass::fuzz {

// A description is refused with an Error, or it survives its own text, and every time finds its key frames.
void run(std::span<const std::uint8_t> data) {
    SeriesDescription series;
    try {
        series = seriesFromJson(asText(data), "fuzz");
    } catch (const Error&) {
        return;
    }
    const std::string text = toJson(series);
    require(toJson(seriesFromJson(text, "fuzz")) == text, "a description survives being written and read");

    const auto& times = series.time.times;
    const double middle = 0.5 * times.front() + 0.5 * times.back();
    for (const double time : {times.front(), times.back(), middle, -1e300, 1e300, 0.0}) {
        const TimeSample place = locate(series.time, time);
        require(place.frameA < times.size() && place.frameB < times.size(), "a time has its key frames");
        require(place.fraction >= 0 && place.fraction < 1, "a time lies between its key frames");
    }
}

}  // namespace isoglass::fuzz
