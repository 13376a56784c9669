#include "pipeline/render_loop.h"

#include "gl/headless_context.h"

namespace isoglass {

RenderLoop::RenderLoop(const Scene& scene, Pace pace, Mailbox<FrameMeshes>& meshes,
                       Mailbox<CameraPose>& cameras, Hooks hooks)
    : scene_(scene),
      pace_(pace),
      incomingMeshes_(meshes),
      incomingCameras_(cameras),
      hooks_(std::move(hooks)),
      thread_([this](std::stop_token stop) { run(stop); }) {}

void RenderLoop::join() {
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
}

void RenderLoop::run(std::stop_token stop) {
    try {
        gl::HeadlessContext context;
        Renderer renderer(context.context());
        draw(stop, renderer);
    } catch (...) {
        failure_ = std::current_exception();
    }
    if (hooks_.ended) hooks_.ended();
}

void RenderLoop::draw(std::stop_token stop, Renderer& renderer) {
    CameraPose camera = scene_.camera.poseAt(0);
    for (std::uint64_t count = 0; !stop.stop_requested(); ++count) {
        std::optional<FrameMeshes> meshes =
            pace_ == Pace::everyMesh ? incomingMeshes_.take(stop) : incomingMeshes_.tryTake();
        if (pace_ == Pace::everyMesh && !meshes) return;
        if (meshes) {
            if (meshes->failure) std::rethrow_exception(meshes->failure);
            if (hooks_.taken) hooks_.taken(*meshes);
            if (pace_ == Pace::everyMesh) camera = meshes->request.camera;
            replaceMeshes(renderer, std::move(*meshes));
        }
        if (const auto newest = incomingCameras_.tryTake()) camera = *newest;
        renderer.render(describe(camera));
        if (!hooks_.present({count, shown_ ? &*shown_ : nullptr}, renderer)) return;
    }
}

void RenderLoop::replaceMeshes(Renderer& renderer, FrameMeshes meshes) {
    std::vector<SurfaceDraw> draws = surfaceDraws(scene_, meshes.meshes);
    for (std::size_t i = 0; i < draws.size(); ++i) {
        draws[i].mesh = renderer.meshes().upload(*meshes.meshes.surfaces[i].mesh);
    }
    for (const SurfaceDraw& old : draws_) renderer.meshes().release(old.mesh);
    draws_ = std::move(draws);
    shown_ = std::move(meshes);
}

FrameDescription RenderLoop::describe(const CameraPose& camera) const {
    FrameDescription frame = describeFrame(scene_, camera);
    frame.draws = draws_;
    return frame;
}

std::vector<SurfaceDraw> surfaceDraws(const Scene& scene, const SceneMeshes& meshes) {
    std::vector<SurfaceDraw> draws;
    for (const ExtractedSurface& extracted : meshes.surfaces) {
        const Volume& volume = scene.volumes[extracted.volume];
        const Surface& surface = volume.surfaces[extracted.surface];
        SurfaceDraw draw;
        draw.worldFromSeries = worldFromSeries(volume.place);
        draw.color = surface.color;
        draw.opacity = surface.opacity;
        draws.push_back(draw);
    }
    return draws;
}

FrameDescription describeFrame(const Scene& scene, const CameraPose& camera) {
    FrameDescription frame;
    frame.camera = {camera.eye, camera.target, scene.camera.up, scene.camera.fovDegrees, scene.image.size};
    frame.background = scene.image.background;
    frame.exposure = scene.image.exposure;
    frame.lighting = scene.lighting;
    frame.method = scene.transparency;
    frame.supersample = scene.image.supersample;
    return frame;
}

}  // namespace isoglass
