#include "volume/import_times.h"

#include "base/error.h"

#include <cmath>

namespace isoglass {

void requireTimes(std::span<const double> times, std::size_t frames, const std::string& place) {
    if (times.size() != frames)
        throw Error(std::to_string(times.size()) + " times for " + std::to_string(frames) + " key frames",
                    place, "give one time a key frame");
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i]))
            throw Error("the time at index " + std::to_string(i) + " is not finite", place);
        if (i > 0 && !(times[i] > times[i - 1]))
            throw Error("times must strictly increase, but not so at index " + std::to_string(i), place,
                        "--times gives other times");
    }
}

}  // namespace isoglass
