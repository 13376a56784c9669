#pragma once

#include "volume/series_description.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

/// A range widened by what rounding does to values that are interpolated in time and blended over two levels:
/// each of the three steps rounds twice, by at most half an ulp of the magnitude; 8 ulp leave room. The
/// smallest float covers products that underflow.
inline ValueRange widened(ValueRange range) {
    if (!(range.min <= range.max)) return range;
    const float slack =
        8 * std::numeric_limits<float>::epsilon() * std::max(std::abs(range.min), std::abs(range.max)) +
        std::numeric_limits<float>::denorm_min();
    return {range.min - slack, range.max + slack};
}

/// Range at `fraction` of the way between two key frames; empty where one of them has no valid sample.
inline ValueRange rangeInTime(ValueRange a, ValueRange b, float fraction) {
    if (!(a.min <= a.max && b.min <= b.max))
        return {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    const float magnitude = std::max({std::abs(a.min), std::abs(a.max), std::abs(b.min), std::abs(b.max)});
    const float slack =
        8 * std::numeric_limits<float>::epsilon() * magnitude + std::numeric_limits<float>::denorm_min();
    return {a.min + fraction * (b.min - a.min) - slack, a.max + fraction * (b.max - a.max) + slack};
}

}  // namespace isoglass
