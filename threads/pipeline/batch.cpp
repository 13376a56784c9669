#include "pipeline/batch.h"

#include "basis/bounded_queue.h"
#include "pipeline/extraction_worker.h"
#include "pipeline/render_loop.h"

namespace isoglass {

namespace {

/// Finished images that may wait for the sink.
constexpr std::size_t kImagesAhead = 2;

FrameRequest requestFor(const Scene& scene, std::int64_t frame) {
    FrameRequest request;
    request.number = static_cast<std::uint64_t>(frame);
    request.position = scene.time.position(frame);
    request.camera = scene.camera.poseAt(static_cast<double>(frame) / scene.time.fps);
    request.imageSize = scene.image.size;
    return request;
}

}  // namespace

void renderFrames(const Scene& scene, SceneExtractor& extractor, FrameRange range,
                  const std::function<bool(RenderedFrame)>& sink) {
    RenderInbox inbox;
    BoundedQueue<RenderedFrame> images(kImagesAhead);
    ExtractionWorker worker(
        [&](const FrameRequest& request) {
            return extractor.extract(request.position, request.camera, request.imageSize);
        },
        inbox.meshes);
    const auto isLast = [&](const FrameMeshes& shown) {
        return static_cast<std::int64_t>(shown.request.number) >= range.last;
    };

    RenderLoop::Hooks hooks;
    hooks.taken = [&](const FrameMeshes& taken) {
        if (!isLast(taken))
            worker.request(requestFor(scene, static_cast<std::int64_t>(taken.request.number) + 1));
    };
    hooks.present = [&](const ShownFrame& shown, Renderer& renderer) {
        RenderedFrame frame{static_cast<std::int64_t>(shown.meshes->request.number), renderer.readSrgb(),
                            shown.meshes->meshes};
        return images.push(std::move(frame)) && !isLast(*shown.meshes);
    };
    hooks.ended = [&] { images.close(); };
    RenderLoop loop(scene, Pace::everyMesh, inbox, std::move(hooks));
    worker.request(requestFor(scene, range.first));
    try {
        while (std::optional<RenderedFrame> frame = images.pop()) {
            if (sink(std::move(*frame))) continue;
            images.close();
            return;
        }
    } catch (...) {
        // The render thread may wait for room in the queue.
        images.close();
        throw;
    }
    loop.join();
}

}  // namespace isoglass
