#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

/// What comes before the passes of a frame, for each volume.
enum class WorkKind {
    firstKeyFrame,   ///< the key frame at or before the frame's time is read
    secondKeyFrame,  ///< the one behind it as well, for interpolation in time
    extraction,      ///< a surface is extracted
    samples,         ///< dense samples are made, for rays through them
};

std::string_view workName(WorkKind kind);

/// What is known of a volume before any of its samples is read.
struct VolumeState {
    bool onKeyFrame = false;                ///< the frame's time is that of a key frame
    bool clippedAway = false;               ///< its whole box is on the far side of a clip plane
    std::vector<float> surfaceOpacities{};  ///< 0 and below is invisible
    bool layered = false;                   ///< the first surface is shown in layers, through the samples
    bool shaded = false;                    ///< it is shown as a medium, through the samples
};

struct PlannedWork {
    WorkKind kind;
    std::size_t surface = 0;  ///< of extraction: index within the volume
    bool needed = false;
    std::string reason;  ///< why it is done, or why not; a clause without a full stop
};

/// Both key frames, then every surface, then the samples. Pure. Nothing is read of which nothing is
/// extracted.
std::vector<PlannedWork> planVolume(const VolumeState& volume);

/// Whether `plan` has work of that kind to do, for that surface.
bool isNeeded(const std::vector<PlannedWork>& plan, WorkKind kind, std::size_t surface = 0);

}  // namespace isoglass
