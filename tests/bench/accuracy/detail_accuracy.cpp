// How far surfaces with levels of detail lie from that of full resolution, in pixels, for both metrics.
//
//     detail_accuracy [SERIES.vdb ISO]
//
// Without a series on blobs of 256^3. The volume fills 720 pixels; both directions are measured, from the
// vertices of either mesh to the triangles of the other. Prints a line of JSON for each setting.
#include "support/mesh_distance.h"
#include "surface/extract.h"
#include "volume/analytic.h"
#include "volume/series_file.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace isoglass {
namespace {

constexpr double kFovDegrees = 30;
constexpr double kHeight = 720;

struct Subject {
    std::string name;
    Lattice lattice;
    TimedField field;
    float iso;
};

Subject makeBlobs() {
    const Lattice lattice = makeUnitLattice(256);
    return {"blobs 256",
            lattice,
            {makeAnalyticFrame(lattice, blobs, 0), makeAnalyticFrame(lattice, blobs, 0.1), 0.3f},
            0.5f};
}

Subject readSubject(const std::string& path, float iso) {
    const SeriesFile file(path);
    const std::size_t last = file.description().time.times.size() - 1;
    TimedField field{file.read(last / 2), nullptr, 0};
    if (last > 0) field = {file.read((last - 1) / 2), file.read((last - 1) / 2 + 1), 0.3f};
    return {path, file.description().lattice, field, iso};
}

/// The volume's longest side takes kHeight pixels at its middle.
View viewOf(const Lattice& lattice) {
    View view;
    view.pixelsPerUnit = kHeight / (2 * std::tan(glm::radians(kFovDegrees) / 2));
    const auto [low, high] = lattice.bounds();
    // Axes of different units are stretched to a cube.
    const glm::dvec3 extent = high - low;
    view.worldPerUnit = 2.0 / extent;
    view.eye = 0.5 * (low + high) +
               extent / 2.0 * (glm::dvec3(1, 2, 0.5) * (2 * view.pixelsPerUnit / kHeight / std::sqrt(5.25)));
    return view;
}

/// World, as the view has it.
SurfaceMesh inWorld(SurfaceMesh mesh, const View& view) {
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3((mesh.origin + glm::dvec3(position) - view.eye) * view.worldPerUnit);
    mesh.origin = {};
    return mesh;
}

/// In pixels, each at its distance from the eye.
void addDistances(const SurfaceMesh& from, const SurfaceMesh& to, double pixelsPerUnit,
                  std::vector<double>& pixels) {
    constexpr std::size_t kMost = 60000;
    constexpr double kCell = 1.0 / 64;  // of a volume that is 2 long
    const test::MeshDistance distance(to, kCell);
    const auto nearest = [&](glm::dvec3 point) {
        double found = distance.at(point, kCell);
        for (double reach = 2 * kCell; std::isinf(found) && reach < 8; reach *= 2)
            found = distance.at(point, reach);
        return found;
    };
    const std::size_t step = from.vertexCount() / kMost + 1;
    for (std::size_t i = 0; i < from.vertexCount(); i += step) {
        const glm::dvec3 point(from.positions[i]);
        pixels.push_back(nearest(point) * pixelsPerUnit / glm::length(point));
    }
}

void report(const Subject& subject, const SurfaceMesh& full, const char* metric, double value,
            const View& view, bool still = false) {
    const auto extract = [&] {
        return extractSurface(subject.lattice, subject.field,
                              {.iso = subject.iso, .view = view, .still = still})
            .mesh;
    };
    SurfaceMesh mesh = extract();
    std::vector<double> times;
    for (int i = 0; i < 7; ++i) {
        const auto begin = std::chrono::steady_clock::now();
        extract();
        times.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(times.begin(), times.end());
    mesh = inWorld(std::move(mesh), view);
    std::vector<double> pixels;
    if (!mesh.empty() && !full.empty()) {
        addDistances(mesh, full, view.pixelsPerUnit, pixels);
        addDistances(full, mesh, view.pixelsPerUnit, pixels);
    }
    std::sort(pixels.begin(), pixels.end());
    double sum = 0;
    for (const double distance : pixels) sum += distance;
    const auto quantile = [&](double share) {
        return pixels.empty()
                   ? 0
                   : pixels[static_cast<std::size_t>(share * static_cast<double>(pixels.size() - 1))];
    };
    std::printf(R"({"subject":"%s","metric":"%s","value":%g,"triangles":%zu,"median_ms":%.2f,"mean":%.3f,)"
                R"("p999":%.3f,"largest":%.3f})"
                "\n",
                subject.name.c_str(), metric, value, mesh.triangleCount(), times[3],
                pixels.empty() ? 0 : sum / static_cast<double>(pixels.size()), quantile(0.999), quantile(1));
    std::fflush(stdout);
}

void study(const Subject& subject) {
    View view = viewOf(subject.lattice);
    const SurfaceMesh full =
        inWorld(extractSurface(subject.lattice, subject.field, {.iso = subject.iso}).mesh, view);
    report(subject, full, "full", 0, view);
    for (const double value : {0.25, 0.5, 1.0, 2.0}) {
        view.errorPixels = value;
        report(subject, full, "error_pixels", value, view);
        report(subject, full, "error_pixels, still", value, view, true);
    }
    view.errorPixels = 0;
    for (const double value : {3, 6, 9, 12, 18, 24}) {
        view.cellPixels = value;
        report(subject, full, "pixels", value, view);
    }
}

}  // namespace
}  // namespace isoglass

int main(int argc, char** argv) {
    if (argc != 1 && argc != 3) {
        std::fprintf(stderr, "usage: detail_accuracy [SERIES.vdb ISO]\n");
        return 2;
    }
    try {
        isoglass::study(argc == 1 ? isoglass::makeBlobs()
                                  : isoglass::readSubject(argv[1], std::strtof(argv[2], nullptr)));
        return 0;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "detail_accuracy: %s\n", failure.what());
        return 1;
    }
}
