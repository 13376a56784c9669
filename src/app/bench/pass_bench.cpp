#include "app/bench/benches.h"
#include "gl/headless_context.h"
#include "render/renderer.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <benchmark/benchmark.h>

#include <string>

namespace isoglass {

namespace {

/// Three semi-transparent surfaces of the blobs, about 75,000 triangles together.
FrameDescription makeFrame(Renderer& renderer, int side, TransparencyMethod method, std::size_t& triangles) {
    constexpr int kSamples = 129;
    const Lattice lattice = makeUnitLattice(kSamples);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), nullptr, 0};
    FrameDescription frame;
    frame.camera = {.eye = {3, 2, 2.5}, .target = {0, 0, 0}, .fovDegrees = 30, .size = {side, side}};
    frame.method = method;
    for (const float iso : {0.2f, 0.5f, 0.8f}) {
        const SurfaceMesh mesh = extractSurface(lattice, field, {.iso = iso}).mesh;
        triangles += mesh.triangleCount();
        frame.draws.push_back(
            {.mesh = renderer.meshes().upload(mesh), .color = {0.2f, 0.5f, 0.9f}, .opacity = 0.3f});
    }
    return frame;
}

void pass(benchmark::State& state, PassKind kind, int side, TransparencyMethod method) {
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    std::size_t triangles = 0;
    const FrameDescription frame = makeFrame(renderer, side, method, triangles);
    renderer.setTiming(true);
    renderer.render(frame);
    for (auto _ : state) {
        renderer.render(frame);
        for (const PassTiming& timing : renderer.timings()) {
            if (timing.label == passName(kind)) state.SetIterationTime(timing.milliseconds / 1000);
        }
    }
    const bool gpu = renderer.timings().front().how == PassTiming::How::gpuTimer;
    state.SetLabel(gpu ? "GPU timer" : "serial wall clock");
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["size"] = side;
}

}  // namespace

void registerPasses(int repetitions) {
    const struct {
        const char* name;
        TransparencyMethod method;
    } methods[] = {{"3-pass", TransparencyMethod::threePass}, {"4-pass", TransparencyMethod::fourPass}};
    for (const auto& method : methods) {
        const FramePlan plan = planFrame({.semiTransparentSurfaces = 3, .method = method.method});
        for (const int side : {512, 1024}) {
            for (const PlannedPass& planned : plan.passes) {
                std::string name =
                    std::string("pass-") + method.name + "-" + std::string(passName(planned.kind));
                for (char& c : name) c = c == ' ' ? '-' : c;
                name += "/" + std::to_string(side);
                benchmark::RegisterBenchmark(name.c_str(),
                                             [=, kind = planned.kind](benchmark::State& state) {
                                                 pass(state, kind, side, method.method);
                                             })
                    ->Repetitions(repetitions)
                    ->ReportAggregatesOnly()
                    ->Iterations(5)
                    ->UseManualTime()
                    ->Unit(benchmark::kMillisecond);
            }
        }
    }
}

}  // namespace isoglass
