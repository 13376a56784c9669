#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// The times of a series' key frames, in the series' own units.
struct TimeAxis {
    std::vector<double> times;     ///< strictly increasing, spacing need not be even
    std::string units;             ///< CF form ("hours since 0000-01-01"), a plain unit ("s"), or empty
    std::string calendar;          ///< CF name ("standard", "noleap", ...), empty where there are no dates
    std::optional<double> period;  ///< length after which the series repeats (a climatology's year)
};

/// Where a time lies between two key frames.
struct TimeSample {
    enum class Where { inside, beforeFirst, afterLast };

    std::size_t frameA = 0;  ///< key frame at or before the time
    std::size_t frameB = 0;  ///< key frame after it; equal to frameA where one frame alone is shown
    /// In [0,1): 0 is frameA. Cast to float it may round up to 1.0f, which is frameB.
    double fraction = 0;
    Where where = Where::inside;

    friend bool operator==(const TimeSample&, const TimeSample&) = default;
};

/// Finds the two key frames around `time`. Outside the series the nearest key frame is taken and `where`
/// says so; with a period, the time after the last key frame leads back to the first (December runs
/// into January) and nothing is outside. `axis.times` must not be empty; `time` must be finite.
TimeSample locate(const TimeAxis& axis, double time);

/// From `frameA` to `frameB` of a sample of the axis, in its units; 0 where they are the same.
double intervalLength(const TimeAxis& axis, const TimeSample& sample);

}  // namespace isoglass
