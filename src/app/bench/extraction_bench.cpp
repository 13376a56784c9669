#include "app/bench/benches.h"
#include "app/bench/registration.h"
#include "surface/extract.h"
#include "volume/analytic.h"

#include <string>

namespace isoglass {

namespace {

struct Field {
    const char* name;
    float (*value)(glm::dvec3, double);
    float iso;
};

constexpr Field kFields[] = {
    {"blobs", blobs, 0.5f}, {"sphere", growingSphere, 0.3f}, {"gyroid", gyroid, 0.0f}};

void extraction(benchmark::State& state, const Field& field, int size, int threads) {
    const Lattice lattice = makeUnitLattice(size);
    const TimedField timed{makeAnalyticFrame(lattice, field.value, 0),
                           makeAnalyticFrame(lattice, field.value, 0.1), 0.3f};
    std::size_t triangles = 0;
    for (auto _ : state) {
        triangles =
            extractSurface(lattice, timed, {.iso = field.iso, .threads = threads}).mesh.triangleCount();
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["threads"] = threads;
    state.counters["size"] = size;
}

}  // namespace

void registerExtraction(int threads, int repetitions) {
    for (const Field& field : kFields) {
        for (const int size : {64, 128, 256}) {
            const std::string name = std::string("extract-") + field.name + "/" + std::to_string(size);
            registerByWallClock(name, repetitions,
                                [=](benchmark::State& state) { extraction(state, field, size, threads); });
        }
    }
}

}  // namespace isoglass
