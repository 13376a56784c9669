#pragma once

#include "render/renderer.h"

#include <algorithm>
#include <vector>

namespace isoglass {

/// Median of a pass in milliseconds, of `runs` after a first one. The renderer's timing must be on.
inline double passMilliseconds(Renderer& renderer, const FrameDescription& frame, PassKind kind, int runs) {
    renderer.render(frame);
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        renderer.render(frame);
        for (const PassTiming& timing : renderer.timings()) {
            if (timing.label == passName(kind)) times.push_back(timing.milliseconds);
        }
    }
    std::ranges::nth_element(times, times.begin() + runs / 2);
    return times[static_cast<std::size_t>(runs / 2)];
}

}  // namespace isoglass
