#pragma once

#include "pipeline/scene_extractor.h"
#include "render/image.h"
#include "scene/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace isoglass {

/// Displayed frames of a timeline, both ends included.
struct FrameRange {
    std::int64_t first = 0;
    std::int64_t last = 0;
};

/// One finished frame of a batch.
struct RenderedFrame {
    std::int64_t frame = 0;
    Image image;
    SceneMeshes meshes;  ///< what the image shows
};

/// Renders frames of the scene's timeline in order, each with exactly its own meshes, so that the same
/// scene gives the same images every time. Extraction, drawing and `sink` overlap on threads of their
/// own; `sink` runs on the calling thread and returns false to end early. Rethrows what failed, after all
/// frames before it went to `sink`; after an early end what fails further ahead is nobody's concern.
void renderFrames(const Scene& scene, SceneExtractor& extractor, FrameRange range,
                  const std::function<bool(RenderedFrame)>& sink);

}  // namespace isoglass
