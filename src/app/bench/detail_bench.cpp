#include "app/bench/benches.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/pyramid.h"

#include <benchmark/benchmark.h>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>

namespace isoglass {

namespace {

/// The blobs, 720 pixels high in a picture of 1280x720, with cells of `pixels`: the same picture for every
/// size of the volume.
void detail(benchmark::State& state, int size, double pixels, int threads) {
    constexpr double kFovDegrees = 30;
    constexpr double kHeight = 720;
    const Lattice lattice = makeUnitLattice(size);
    const TimedField timed{makeAnalyticFrame(lattice, blobs, 0), makeAnalyticFrame(lattice, blobs, 0.1),
                           0.3f};
    timed.a->pyramid();
    timed.b->pyramid();
    View view;
    view.pixelsPerUnit = kHeight / (2 * std::tan(glm::radians(kFovDegrees) / 2));
    // A length of 2 takes 720 pixels there.
    view.eye = glm::dvec3(1, 2, 0.5) * (2 * view.pixelsPerUnit / kHeight / std::sqrt(5.25));
    view.cellPixels = pixels;
    std::size_t triangles = 0;
    for (auto _ : state) {
        triangles = extractSurface(lattice, timed, {.iso = 0.5f, .view = view, .threads = threads})
                        .mesh.triangleCount();
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["threads"] = threads;
    state.counters["size"] = size;
}

}  // namespace

void registerDetail(int threads, int repetitions) {
    for (const int pixels : {3, 6, 12}) {
        for (const int size : {128, 256, 512}) {
            const std::string name = "detail-" + std::to_string(pixels) + "px/" + std::to_string(size);
            benchmark::RegisterBenchmark(
                name.c_str(), [=](benchmark::State& state) { detail(state, size, pixels, threads); })
                ->Repetitions(repetitions)
                ->ReportAggregatesOnly()
                ->MinTime(0.05)
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
        }
    }
}

}  // namespace isoglass
