#pragma once

#include "basis/mailbox.h"
#include "pipeline/scene_extractor.h"
#include "scene/scene.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <thread>

namespace isoglass {

/// What to extract: a moment of the timeline, seen from a camera.
struct FrameRequest {
    std::uint64_t number = 0;  ///< chosen by the one who asks
    double position = 0;       ///< 0 is the timeline's `from`, 1 its `to`
    CameraPose camera;
    glm::ivec2 imageSize{0};  ///< pixels of the picture that it is for
    Course course = {};       ///< which moments will be asked for next
};

/// A finished request: all meshes of the moment, or why there are none.
struct FrameMeshes {
    FrameRequest request;
    SceneMeshes meshes;
    std::exception_ptr failure;
};

/// The extraction thread: takes the newest request, works on it to the end, publishes the result.
///
/// A request that arrives while another is being worked on waits; only the newest one waits. Requests
/// may come from any thread and never block.
class ExtractionWorker {
  public:
    /// `extract` runs on the extraction thread; what it throws is published as the result's failure.
    using Extract = std::function<SceneMeshes(const FrameRequest&)>;

    /// `results` must outlive the worker.
    ExtractionWorker(Extract extract, Mailbox<FrameMeshes>& results);

    void request(FrameRequest request) { requests_.post(std::move(request)); }

  private:
    void run(std::stop_token stop);

    Extract extract_;
    Mailbox<FrameMeshes>& results_;
    Mailbox<FrameRequest> requests_;
    std::jthread thread_;  ///< last member: it uses all the others
};

}  // namespace isoglass
