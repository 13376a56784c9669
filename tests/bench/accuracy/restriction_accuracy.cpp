// How coarser levels of a field should be made: by taking every second sample, or by a filter first (the
// weights 1/4, 1/2, 1/4 along every axis). Both levels' surfaces are compared with that of the full
// resolution, in cells of level 0, in both directions. Prints a line of JSON for each.
//
//     restriction_accuracy [SERIES.vdb ISO]...
//
// First for blobs of 129^3 and for a shell so thin that level 2 hardly sees it.
#include "support/mesh_distance.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/series_file.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace isoglass {
namespace {

/// Samples on a lattice whose step is 1.
struct Samples {
    glm::ivec3 dims;
    std::vector<float> values;

    std::size_t place(glm::ivec3 i) const {
        return (static_cast<std::size_t>(i.z) * dims.y + i.y) * dims.x + i.x;
    }
};

/// 1/4, 1/2, 1/4 along an axis; a sample beside the end or a missing one takes itself for what is not there.
Samples smoothed(const Samples& in, int axis) {
    Samples out = in;
    glm::ivec3 step(0);
    step[axis] = 1;
    glm::ivec3 i;
    for (i.z = 0; i.z < in.dims.z; ++i.z) {
        for (i.y = 0; i.y < in.dims.y; ++i.y) {
            for (i.x = 0; i.x < in.dims.x; ++i.x) {
                const float here = in.values[in.place(i)];
                float before = i[axis] > 0 ? in.values[in.place(i - step)] : here;
                float after = i[axis] + 1 < in.dims[axis] ? in.values[in.place(i + step)] : here;
                if (std::isnan(before)) before = here;
                if (std::isnan(after)) after = here;
                out.values[out.place(i)] = 0.25f * before + 0.5f * here + 0.25f * after;
            }
        }
    }
    return out;
}

/// Every second sample.
Samples halved(const Samples& in) {
    Samples out{(in.dims + 1) / 2, {}};
    glm::ivec3 i;
    for (i.z = 0; i.z < out.dims.z; ++i.z)
        for (i.y = 0; i.y < out.dims.y; ++i.y)
            for (i.x = 0; i.x < out.dims.x; ++i.x) out.values.push_back(in.values[in.place(2 * i)]);
    return out;
}

SurfaceMesh surfaceOf(const Samples& samples, double step, float iso) {
    const Lattice lattice = makeUniformLattice(samples.dims, glm::dvec3(0), glm::dvec3(step));
    SurfaceMesh mesh =
        extractSurface(lattice, {makeKeyFrame(lattice, samples.values), nullptr, 0}, {.iso = iso}).mesh;
    for (glm::vec3& position : mesh.positions) position += glm::vec3(mesh.origin);
    mesh.origin = {};
    return mesh;
}

void addDistances(const SurfaceMesh& from, const SurfaceMesh& to, std::vector<double>& cells) {
    constexpr double kReach = 16;
    const test::MeshDistance distance(to, 4);
    for (const glm::vec3& position : from.positions)
        cells.push_back(std::min(distance.at(glm::dvec3(position), kReach), kReach));
}

void report(const std::string& name, const Samples& level0, float iso) {
    const SurfaceMesh full = surfaceOf(level0, 1, iso);
    for (const bool filtered : {false, true}) {
        Samples samples = level0;
        for (int level = 1; level <= 2; ++level) {
            for (int axis = 0; filtered && axis < 3; ++axis) samples = smoothed(samples, axis);
            samples = halved(samples);
            const SurfaceMesh coarse = surfaceOf(samples, 1 << level, iso);
            std::vector<double> cells;
            if (!coarse.empty()) addDistances(coarse, full, cells);
            if (!coarse.empty()) addDistances(full, coarse, cells);
            std::ranges::sort(cells);
            double sum = 0;
            for (const double distance : cells) sum += distance;
            const auto quantile = [&](double share) {
                return cells.empty()
                           ? 0
                           : cells[static_cast<std::size_t>(share * static_cast<double>(cells.size() - 1))];
            };
            std::printf(
                R"({"subject":"%s","iso":%g,"level":%d,"restriction":"%s","triangles":%zu,"mean":%.3f,)"
                R"("p999":%.2f,"largest":%.2f})"
                "\n",
                name.c_str(), iso, level, filtered ? "filter" : "subsampling", coarse.triangleCount(),
                cells.empty() ? 0 : sum / static_cast<double>(cells.size()), quantile(0.999), quantile(1));
            std::fflush(stdout);
        }
    }
}

Samples sampled(const AnalyticField& field) {
    constexpr int kSize = 129;
    return {glm::ivec3(kSize), sampleField(makeUnitLattice(kSize), field, 0)};
}

/// Above 0.5 in a shell 3 cells thick.
float thinShell(glm::dvec3 p, double) {
    const double cells = (glm::length(p) - 0.7) * 64 / 1.5;
    return static_cast<float>(std::exp2(-cells * cells));
}

Samples readSamples(const char* path) {
    const SeriesFile file(path);
    const auto frame = file.read(file.description().time.times.size() / 2);
    Samples samples{frame->dims(), {}};
    glm::ivec3 i;
    for (i.z = 0; i.z < samples.dims.z; ++i.z)
        for (i.y = 0; i.y < samples.dims.y; ++i.y)
            for (i.x = 0; i.x < samples.dims.x; ++i.x) samples.values.push_back(frame->sample(i));
    return samples;
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    using namespace isoglass;
    if (argc % 2 == 0) {
        std::fprintf(stderr, "usage: restriction_accuracy [SERIES.vdb ISO]...\n");
        return 2;
    }
    try {
        report("blobs", sampled(blobs), 0.5f);
        report("thin shell", sampled(thinShell), 0.5f);
        for (int i = 1; i < argc; i += 2)
            report(argv[i], readSamples(argv[i]), std::strtof(argv[i + 1], nullptr));
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "restriction_accuracy: %s\n", failure.what());
        return 1;
    }
}
