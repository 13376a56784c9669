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

void Playhead::play(double now, bool forwards) {
    if (!canPlay() || (playing_ && forwards_ == forwards)) return;
    pause(now);
    playing_ = true;
    forwards_ = forwards;
    since_ = now;
    // The end is the beginning of the next round, which has no frame of its own.
    if (!forwards && position_ == 1) position_ = timeline_.position(timeline_.frameCount() - 1);
}

void Playhead::pause(double now) {
    position_ = position(now);
    playing_ = false;
}

void Playhead::moveTo(double position, bool forwards) {
    position_ = position;
    forwards_ = forwards;
    playing_ = false;
}

double Playhead::framesRun(double now) const {
    const double run = (now - since_) * timeline_.fps;
    return position_ * static_cast<double>(timeline_.frameCount()) + (forwards_ ? run : -run);
}

double Playhead::frameShown(double now) const {
    const double run = framesRun(now);
    return forwards_ ? std::floor(run + kRounding) : std::ceil(run - kRounding);
}

double Playhead::position(double now) const {
    if (!playing_) return position_;
    const std::int64_t frames = timeline_.frameCount();
    const auto frame = static_cast<std::int64_t>(frameShown(now));
    return timeline_.position((frame % frames + frames) % frames);
}

double Playhead::secondsToNextFrame(double now) const {
    if (!playing_) return std::numeric_limits<double>::infinity();
    const double shown = frameShown(now);
    return std::abs(shown + (forwards_ ? 1 : -1) - framesRun(now)) / timeline_.fps;
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
