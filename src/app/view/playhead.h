#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace isoglass {

/// Where in the timeline the viewer is: still, or running with the clock, forwards and from the end back to
/// the beginning, or the other way round.
///
/// Positions go from 0, the timeline's `from`, to 1, its `to`. `now` is seconds of any steady clock. While
/// it runs the position is that of a displayed frame, so that what is shown are the frames of the video.
class Playhead {
  public:
    explicit Playhead(const Timeline& timeline) : timeline_(timeline) {}

    bool playing() const { return playing_; }
    /// False where the timeline is a still: then `play` does nothing.
    bool canPlay() const { return timeline_.frameCount() > 1; }
    void play(double now, bool forwards = true);
    /// How it runs, or ran.
    bool forwards() const { return forwards_; }
    /// Stays at the displayed frame.
    void pause(double now);
    /// Pauses there.
    void moveTo(double position) { moveTo(position, forwards_); }
    /// The same, on the way in that direction.
    void moveTo(double position, bool forwards);

    double position(double now) const;
    /// Seconds of playback from the beginning, for the camera's path.
    double playbackSeconds(double now) const { return position(now) * lengthSeconds(); }
    /// How long what is shown now stays; infinite while paused.
    double secondsToNextFrame(double now) const;

    /// The position `count` displayed frames on, or back where it is negative, around the end.
    double framesOn(double now, std::int64_t count) const;

  private:
    double lengthSeconds() const { return static_cast<double>(timeline_.frameCount()) / timeline_.fps; }
    /// Displayed frames from the timeline's beginning, with fraction; may be before it or beyond its end.
    double framesRun(double now) const;
    /// Number of the displayed frame, likewise.
    double frameShown(double now) const;

    Timeline timeline_;
    bool playing_ = false;
    bool forwards_ = true;
    double position_ = 0;  ///< where it stands, or stood when it began to play
    double since_ = 0;     ///< when it began to play
};

/// The key position after `position`, or before it where not `forwards`, around the end; `position` where
/// there is none. `keys` is sorted; positions closer than 1e-9 are one.
double nextKeyPosition(const std::vector<double>& keys, double position, bool forwards);

}  // namespace isoglass
