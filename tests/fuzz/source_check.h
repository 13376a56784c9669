#pragma once

#include "base/error.h"
#include "fuzz/fuzz.h"
#include "volume/frame_source.h"

#include <cmath>
#include <memory>
#include <vector>

namespace isoglass::fuzz {

/// Opens a source and reads all its key frames. It refuses with an Error, or keeps what FrameSource
/// promises.
template <typename Open>
void checkSource(Open open) {
    try {
        const std::unique_ptr<FrameSource> source = open();
        const SeriesDescription& series = source->description();
        std::size_t samples = 1;
        for (const Axis& axis : series.lattice.axes) {
            require(axis.size() >= 1, "an axis has samples");
            for (std::size_t i = 1; i < axis.size(); ++i)
                require(axis.descending() ? axis.coordinates[i] < axis.coordinates[i - 1]
                                          : axis.coordinates[i] > axis.coordinates[i - 1],
                        "an axis is strictly monotonic");
            samples *= axis.size();
        }
        for (std::size_t i = 1; i < series.time.times.size(); ++i)
            require(series.time.times[i] > series.time.times[i - 1], "times increase");
        // A small file may honestly announce a large constant variable; reading it would only take time.
        if (samples > (std::size_t{1} << 16)) return;
        std::vector<float> values(samples);
        for (std::size_t frame = 0; frame < series.time.times.size() && frame < 8; ++frame) {
            source->read(frame, values);
            for (const float value : values)
                require(std::isnan(value) || std::abs(value) <= kLargestValue, "a sample can be used");
        }
    } catch (const Error&) {
    }
}

}  // namespace isoglass::fuzz
