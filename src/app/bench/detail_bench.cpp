#include "app/bench/benches.h"
#include "app/bench/registration.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/detail_error.h"
#include "volume/pyramid.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>

namespace isoglass {

namespace {

constexpr float kIso = 0.5f;
/// Far enough below the iso-value that the cells around the surface do not know of it.
constexpr float kFloor = 0.05f;

/// The blobs, 720 pixels high in a picture of 1280x720: the same picture for every size of the volume.
View blobsView() {
    constexpr double kFovDegrees = 30;
    constexpr double kHeight = 720;
    View view;
    view.pixelsPerUnit = kHeight / (2 * std::tan(glm::radians(kFovDegrees) / 2));
    // A length of 2 takes 720 pixels there.
    view.eye = glm::dvec3(1, 2, 0.5) * (2 * view.pixelsPerUnit / kHeight / std::sqrt(5.25));
    return view;
}

/// The same for all runs of one size, of which many follow each other.
const TimedField& blobsOf(const Lattice& lattice) {
    static TimedField last;
    if (!last.a || last.a->dims() != lattice.dims()) {
        last = {};
        last = {makeSparseBlobs(lattice, 0, kFloor), makeSparseBlobs(lattice, 0.1, kFloor), 0.3f};
    }
    return last;
}

void detail(benchmark::State& state, int size, const View& view, int threads) {
    const Lattice lattice = makeUnitLattice(size);
    const TimedField& timed = blobsOf(lattice);
    for (const auto& frame : {timed.a, timed.b}) {
        if (view.wantsDetail()) frame->pyramid();
        if (view.errorPixels > 0) frame->detailError();
    }
    std::size_t triangles = 0;
    for (auto _ : state) {
        triangles = extractSurface(lattice, timed, {.iso = kIso, .view = view, .threads = threads})
                        .mesh.triangleCount();
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["threads"] = threads;
    state.counters["size"] = size;
}

}  // namespace

void registerDetail(int threads, int repetitions) {
    const auto add = [&](const std::string& name, int size, const View& view) {
        registerByWallClock("detail-" + name + "/" + std::to_string(size), repetitions,
                            [=](benchmark::State& state) { detail(state, size, view, threads); });
    };
    for (const int size : {128, 256, 512, 1024}) {
        View view = blobsView();
        add("full", size, view);
        for (const int pixels : {9, 12, 18}) {
            view.cellPixels = pixels;
            add(std::to_string(pixels) + "px", size, view);
        }
        view.errorPixels = 0.5;
        add("error-0.5px", size, view);
    }
}

}  // namespace isoglass
