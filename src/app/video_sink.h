#pragma once

#include "app/render_output.h"

#include <memory>

namespace isoglass {

/// Writes a video in segments, so that a stopped run can go on: each is encoded alone into a folder beside
/// the video, with a journal of those that are finished. At the end they are put together without encoding
/// again, and the folder goes. A run that was stopped and went on gives the bytes of one that was not.
std::unique_ptr<FrameSink> makeVideoSink(const RenderOutput& output, const Scene& scene, FrameRange range,
                                         std::uint64_t identity);

}  // namespace isoglass
