#include "pipeline/render_loop.h"

#include "gl/headless_context.h"

#include <algorithm>

namespace isoglass {

RenderLoop::RenderLoop(const Scene& scene, Pace pace, RenderInbox& inbox, Hooks hooks)
    : scene_(scene),
      pace_(pace),
      inbox_(inbox),
      hooks_(std::move(hooks)),
      thread_([this](std::stop_token stop) { run(stop); }) {}

void RenderLoop::join() {
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
}

void RenderLoop::run(std::stop_token stop) {
    try {
        const std::unique_ptr<gl::CurrentContext> context =
            hooks_.makeContext ? hooks_.makeContext() : std::make_unique<gl::HeadlessContext>();
        Renderer renderer(context->context());
        draw(stop, renderer);
    } catch (...) {
        failure_ = std::current_exception();
    }
    if (hooks_.ended) hooks_.ended();
}

void RenderLoop::draw(std::stop_token stop, Renderer& renderer) {
    RenderView view = sceneView(scene_);
    bool due = pace_ == Pace::newest;
    for (std::uint64_t count = 0; due || inbox_.news.wait(stop); due = false) {
        if (stop.stop_requested()) return;
        if (hooks_.woken) hooks_.woken();
        const bool fresh = takeMeshes(renderer);
        if (pace_ == Pace::everyMesh) {
            if (!fresh) continue;
            view.camera = shown_->request.camera;
        } else if (const auto newest = inbox_.views.tryTake()) {
            view = *newest;
        }
        renderer.renderIfChanged(describe(view));
        if (!hooks_.present({count++, shown_ ? &*shown_ : nullptr}, renderer)) return;
    }
}

/// True when there is a new set.
bool RenderLoop::takeMeshes(Renderer& renderer) {
    std::optional<FrameMeshes> meshes = inbox_.meshes.tryTake();
    if (!meshes) return false;
    if (meshes->failure) {
        if (!hooks_.failed) std::rethrow_exception(meshes->failure);
        hooks_.failed(*meshes);
        return false;
    }
    if (hooks_.taken) hooks_.taken(*meshes);
    replaceMeshes(renderer, std::move(*meshes));
    return true;
}

void RenderLoop::replaceMeshes(Renderer& renderer, FrameMeshes meshes) {
    std::vector<SurfaceDraw> draws = surfaceDraws(scene_, meshes.meshes);
    const std::vector<MeshId> ids = meshes_.replace(meshes.meshes.meshes(), renderer.meshes());
    for (std::size_t i = 0; i < draws.size(); ++i) draws[i].mesh = ids[i];
    samples_.replace(meshes.meshes.samples, renderer.volumes());
    draws_ = std::move(draws);
    shown_ = std::move(meshes);
}

FrameDescription RenderLoop::describe(const RenderView& view) const {
    FrameDescription frame = describeFrame(scene_, view);
    frame.draws = draws_;
    if (shown_ && !frame.illustration) samples_.describe(scene_, samplesMotion(view), frame);
    if (view.position && shown_) move(*view.position, frame.draws);
    return frame;
}

/// By how much the fraction between the key frames of what rays go through has grown since its moment.
double RenderLoop::samplesMotion(const RenderView& view) const {
    const SceneMeshes& meshes = shown_->meshes;
    if (!view.position || !meshes.samples || meshes.fractionsPerPosition.empty()) return 0;
    const std::size_t volume = meshes.samples->volume;
    return motionWithin(meshes.times[volume].fraction,
                        (*view.position - shown_->request.position) * meshes.fractionsPerPosition[volume]);
}

/// To the displayed position, from that of the meshes.
void RenderLoop::move(double position, std::vector<SurfaceDraw>& draws) const {
    const SceneMeshes& meshes = shown_->meshes;
    if (meshes.fractionsPerPosition.empty()) return;
    const double passed = position - shown_->request.position;
    for (std::size_t i = 0; i < meshes.surfaces.size(); ++i) {
        const std::size_t volume = meshes.surfaces[i].volume;
        if (meshes.surfaces[i].mesh->velocities.empty()) continue;
        draws[i].motion = static_cast<float>(
            motionWithin(meshes.times[volume].fraction, passed * meshes.fractionsPerPosition[volume]));
        if (draws[i].motion == 0) continue;
        const double limit = meshes.motionLimits[volume];
        draws[i].motionLimit = static_cast<float>(limit);
        if (auto& bounds = draws[i].boundsSeries) *bounds = {bounds->low - limit, bounds->high + limit};
    }
}

double motionWithin(double fraction, double wanted) {
    const double there = fraction + wanted;
    // That far away it is not the same motion: the timeline began anew or somebody jumped.
    if (there < -1 || there > 2) return 0;
    return std::clamp(there, 0.0, 1.0) - fraction;
}

RenderView sceneView(const Scene& scene) {
    return {.camera = scene.camera.poseAt(0), .size = scene.image.size, .illustration = scene.illustrative};
}

namespace {

LegendBar barOf(const FieldColor& color) {
    return {color.map, color.low, color.high};
}

/// Every different bar once. Illustrations have the colours of secondary geometry alone.
std::vector<LegendBar> legendBars(const Scene& scene, bool illustration) {
    std::vector<LegendBar> bars;
    for (const Volume& volume : scene.volumes) {
        for (const Surface& surface : volume.surfaces) {
            if (!surface.fieldColor || (illustration && !surface.secondary)) continue;
            const LegendBar bar = barOf(*surface.fieldColor);
            if (std::ranges::find(bars, bar) == bars.end()) bars.push_back(bar);
        }
    }
    return bars;
}

/// A cap is as opaque as its surface seen from straight above. Where the caps of nested surfaces lie in one
/// plane the inner one is in front.
void makeCap(const Volume& volume, const Surface& surface, SurfaceDraw& draw) {
    if (draw.shell) {
        draw.opacity = static_cast<float>(shellOpacity(*draw.shell, 1, 0));
        draw.shell.reset();
    }
    for (const Surface& other : volume.surfaces) {
        if (other.inside != surface.inside) continue;
        const bool isInner =
            surface.inside == Inside::above ? surface.iso > other.iso : surface.iso < other.iso;
        if (isInner) ++draw.depthRank;
    }
}

}  // namespace

std::vector<SurfaceDraw> surfaceDraws(const Scene& scene, const SceneMeshes& meshes) {
    std::vector<SurfaceDraw> draws;
    for (const ExtractedSurface& extracted : meshes.surfaces) {
        const Volume& volume = scene.volumes[extracted.volume];
        const Surface& surface = volume.surfaces[extracted.surface];
        SurfaceDraw draw;
        draw.worldFromSeries = worldFromSeries(volume.place);
        if (!meshes.bounds.empty()) {
            const auto& [low, high] = meshes.bounds[extracted.volume];
            draw.boundsSeries = Bounds{low, high};
        }
        draw.color = surface.color;
        draw.opacity = surface.opacity;
        draw.secondary = surface.secondary;
        if (surface.shell) draw.shell = prepareShell(*surface.shell);
        if (surface.fieldColor) draw.colorBar = barOf(*surface.fieldColor);
        if (extracted.caps) makeCap(volume, surface, draw);
        draws.push_back(draw);
    }
    for (const MeshObject& object : scene.meshes) {
        draws.push_back({.worldFromSeries = worldFromSeries(object.place),
                         .color = object.color,
                         .opacity = object.opacity,
                         .secondary = object.secondary});
    }
    return draws;
}

FrameDescription describeFrame(const Scene& scene, const RenderView& view) {
    FrameDescription frame;
    frame.camera = {view.camera.eye, view.camera.target, scene.camera.up, scene.camera.fovDegrees, view.size};
    frame.background = scene.image.background;
    frame.backgroundOpacity = scene.image.backgroundOpacity;
    frame.exposure = scene.image.exposure;
    frame.lighting = scene.lighting;
    frame.method = scene.transparency.method;
    frame.layers = scene.transparency.layers;
    frame.reproducible = scene.transparency.reproducible;
    frame.exactWanted = scene.quality.exactOrder;
    frame.illustration = view.illustration;
    frame.samples = scene.image.samples;
    frame.wireframe = view.wireframe;
    frame.keepLinear = false;
    if (scene.image.legend) {
        const LinearColor paper = view.illustration ? view.illustration->paper : scene.image.background;
        frame.overlays = makeLegend(legendBars(scene, view.illustration.has_value()), view.size, paper);
    }
    return frame;
}

}  // namespace isoglass
