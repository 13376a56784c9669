#include "volume/time_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// `time` moved by whole periods into [first, first + period). A time that is a key time but for the
/// rounding of the move lands on it exactly, so that it needs one key frame and not two.
double wrap(const TimeAxis& axis, double time) {
    const double first = axis.times.front();
    const double period = *axis.period;
    if (time >= first && time < first + period) return time;
    // Remainders of both are exact and never overflow, unlike the difference of the times.
    double offset = std::fmod(time, period) - std::fmod(first, period);
    while (offset < 0) offset += period;
    while (offset >= period) offset -= period;

    const double rounding =
        4 * std::numeric_limits<double>::epsilon() * std::max({std::abs(time), std::abs(first), period});
    if (period - offset <= rounding) return first;
    const double wrapped = first + offset;
    const auto near = std::ranges::lower_bound(axis.times, wrapped - rounding);
    return near != axis.times.end() && *near <= wrapped + rounding ? *near : wrapped;
}

TimeSample between(std::size_t frameA, std::size_t frameB, double timeA, double timeB, double time) {
    // The difference of two finite times may overflow; that of their halves does not.
    const double scale = std::isfinite(timeB - timeA) ? 1 : 0.5;
    const double fraction = (time * scale - timeA * scale) / (timeB * scale - timeA * scale);
    if (fraction <= 0) return {frameA, frameA, 0};
    if (fraction >= 1) return {frameB, frameB, 0};
    return {frameA, frameB, fraction};
}

}  // namespace

TimeSample locate(const TimeAxis& axis, double time) {
    const std::vector<double>& times = axis.times;
    const std::size_t last = times.size() - 1;
    if (axis.period)
        time = wrap(axis, time);
    else if (time < times.front())
        return {0, 0, 0, TimeSample::Where::beforeFirst};
    else if (time > times.back())
        return {last, last, 0, TimeSample::Where::afterLast};

    const auto after = std::ranges::upper_bound(times, time);
    const auto frame = static_cast<std::size_t>(after - times.begin()) - 1;
    if (times[frame] == time) return {frame, frame, 0};
    if (frame < last) return between(frame, frame + 1, times[frame], times[frame + 1], time);
    return last == 0 ? TimeSample{} : between(last, 0, times[last], times.front() + *axis.period, time);
}

double intervalLength(const TimeAxis& axis, const TimeSample& sample) {
    const double length = axis.times[sample.frameB] - axis.times[sample.frameA];
    return sample.frameB < sample.frameA ? length + *axis.period : length;
}

}  // namespace isoglass
