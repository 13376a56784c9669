#include "app/bench/benches.h"
#include "gl/headless_context.h"
#include "render/renderer.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace isoglass {

namespace {

struct Method {
    const char* name;
    TransparencyMethod method;
    bool reproducible = false;
};

constexpr Method kMethods[] = {{"2-pass", TransparencyMethod::twoPass},
                               {"3-pass", TransparencyMethod::threePass},
                               {"4-pass", TransparencyMethod::fourPass},
                               {"3-pass-reproducible", TransparencyMethod::threePass, true},
                               {"4-pass-reproducible", TransparencyMethod::fourPass, true},
                               {"peel", TransparencyMethod::peel},
                               {"exact", TransparencyMethod::exact}};

/// Three semi-transparent surfaces of the blobs, about 75,000 triangles together.
FrameDescription makeFrame(Renderer& renderer, int side, const Method& method, std::size_t& triangles) {
    constexpr int kSamples = 129;
    const Lattice lattice = makeUnitLattice(kSamples);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), nullptr, 0};
    FrameDescription frame;
    frame.camera = {.eye = {3, 2, 2.5}, .target = {0, 0, 0}, .fovDegrees = 30, .size = {side, side}};
    frame.method = method.method;
    frame.reproducible = method.reproducible;
    frame.keepLinear = false;
    for (const float iso : {0.2f, 0.5f, 0.8f}) {
        const SurfaceMesh mesh = extractSurface(lattice, field, {.iso = iso}).mesh;
        triangles += mesh.triangleCount();
        frame.draws.push_back(
            {.mesh = renderer.meshes().upload(mesh), .color = {0.2f, 0.5f, 0.9f}, .opacity = 0.3f});
    }
    return frame;
}

/// One pass, or the whole frame where `label` is empty.
void frameOrPass(benchmark::State& state, const std::string& label, int side, const Method& method) {
    gl::HeadlessContext context;
    Renderer renderer(context.context());
    std::size_t triangles = 0;
    const FrameDescription frame = makeFrame(renderer, side, method, triangles);
    renderer.setTiming(true);
    renderer.render(frame);
    for (auto _ : state) {
        renderer.render(frame);
        double milliseconds = 0;
        for (const PassTiming& timing : renderer.timings()) {
            if (label.empty() || timing.label == label) milliseconds += timing.milliseconds;
        }
        state.SetIterationTime(milliseconds / 1000);
    }
    const bool gpu = renderer.timings().front().how == PassTiming::How::gpuTimer;
    state.SetLabel(gpu ? "GPU timer" : "serial wall clock");
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["size"] = side;
}

}  // namespace

void registerPasses(int repetitions) {
    for (const Method& method : kMethods) {
        const FramePlan plan = planFrame(
            {.semiTransparentSurfaces = 3, .method = method.method, .reproducible = method.reproducible});
        std::vector<std::string> labels{""};
        for (const PlannedPass& planned : plan.passes) labels.push_back(passLabel(planned));
        for (const int side : {512, 1024}) {
            for (const std::string& label : labels) {
                std::string name = (label.empty() ? "frame-" : "pass-") + std::string(method.name);
                if (!label.empty()) name += "-" + label;
                for (char& c : name) c = c == ' ' ? '-' : c;
                name += "/" + std::to_string(side);
                benchmark::RegisterBenchmark(
                    name.c_str(), [=](benchmark::State& state) { frameOrPass(state, label, side, method); })
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
