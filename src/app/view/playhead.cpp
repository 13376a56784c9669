#include "app/view/playhead.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass {

namespace {

/// A frame's own time divided and multiplied by fps may end this far below its number.
constexpr double kRounding = 1e-6;
constexpr double kSamePosition = 1e-9;

}  // namespace

void Playhead::play(double now) {
    if (playing_ || !canPlay()) return;
    playing_ = true;
    since_ = now;
}

void Playhead::pause(double now) {
    position_ = position(now);
    playing_ = false;
}

void Playhead::moveTo(double position) {
    position_ = position;
    playing_ = false;
}

double Playhead::framesRun(double now) const {
    return position_ * static_cast<double>(timeline_.frameCount()) + (now - since_) * timeline_.fps;
}

double Playhead::position(double now) const {
    if (!playing_) return position_;
    const auto frame = static_cast<std::int64_t>(std::floor(framesRun(now) + kRounding));
    return timeline_.position(frame % timeline_.frameCount());
}

double Playhead::secondsToNextFrame(double now) const {
    if (!playing_) return std::numeric_limits<double>::infinity();
    const double run = framesRun(now);
    return (std::floor(run + kRounding) + 1 - run) / timeline_.fps;
}

double Playhead::framesOn(double now, std::int64_t count) const {
    const std::int64_t frames = timeline_.frameCount();
    const std::int64_t frame = std::llround(position(now) * static_cast<double>(frames)) + count;
    return timeline_.position((frame % frames + frames) % frames);
}

double nextKeyPosition(const std::vector<double>& keys, double position, bool forwards) {
    if (keys.empty()) return position;
    if (forwards) {
        const auto next = std::upper_bound(keys.begin(), keys.end(), position + kSamePosition);
        return next != keys.end() ? *next : keys.front();
    }
    const auto from = std::lower_bound(keys.begin(), keys.end(), position - kSamePosition);
    return from != keys.begin() ? *std::prev(from) : keys.back();
}

}  // namespace isoglass
