#include "unit/levels/watertight_check.h"
#include "volume/frame_source.h"
#if ISOGLASS_VTK
#include "vtkio/vtk_image.h"
#endif

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace isoglass {
namespace {

using test::Dice;
using test::LevelCase;

/// A moment of a source, between two key frames.
LevelCase readCase(FrameSource& source, std::size_t frame, const std::string& name) {
    LevelCase c;
    c.lattice = source.description().lattice;
    const glm::ivec3 dims = c.lattice.dims();
    for (int i = 0; i < 2; ++i) {
        c.samples[i].resize(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
        source.read(frame + i, c.samples[i]);
    }
    test::rebuild(c);
    c.name = name + " from key frame " + std::to_string(frame);
    return c;
}

/// Looks at the source from `views` random places around it. `worldPerUnit` brings its axes to one scale.
void expectWatertightViews(FrameSource& source, const std::vector<float>& isoValues, glm::dvec3 worldPerUnit,
                           const std::string& name, int views) {
    Dice dice(1);
    test::Totals totals;
    const auto bounds = source.description().lattice.bounds();
    const glm::dvec3 size = (bounds[1] - bounds[0]) * worldPerUnit;
    const double cell = std::max({size.x / source.description().lattice.cells().x,
                                  size.y / source.description().lattice.cells().y,
                                  size.z / source.description().lattice.cells().z});
    const auto frames = static_cast<std::uint32_t>(source.description().time.times.size());
    for (int i = 0; i < views && !testing::Test::HasFailure(); ++i) {
        LevelCase c = readCase(source, dice.below(frames - 1), name);
        c.field.fraction = static_cast<float>(dice.unit());
        const double cellsPerSize = dice.between(10, 40);
        View view;
        view.worldPerUnit = worldPerUnit;
        view.pixelsPerUnit = 1000;
        view.cellPixels = view.pixelsPerUnit / cellsPerSize;
        for (int k = 0; k < 3; ++k) {
            const double middle = 0.5 * (bounds[0][k] + bounds[1][k]);
            view.eye[k] = middle + dice.between(-4, 4) * cellsPerSize * cell / worldPerUnit[k];
        }
        c.options = {.iso = isoValues[dice.below(static_cast<std::uint32_t>(isoValues.size()))],
                     .view = view,
                     .threads = 1};
        c.gate = i % 2 == 0 ? 0 : 0.05f;
        if (i % 3 == 2) {
            c.options.view->cellPixels = 0;
            c.options.view->errorPixels = std::exp(dice.between(0, std::log(200.0)));
        }
        test::expectWatertight(c, totals);
    }
    std::printf("%s: %zu views, %zu triangles, bricks by%s\n", name.c_str(), totals.views, totals.triangles,
                test::levelCounts(totals).c_str());
}

int viewCount() {
    const char* count = std::getenv("ISOGLASS_VIEWS");
    return count ? std::atoi(count) : 8;
}

// Uneven, descending and periodic axes, and land so near to everything that all stays at level 0.
TEST(LevelsOfRealData, OceanExcerptIsWatertight) {
    const auto source = openNetcdf(std::filesystem::path(ISOGLASS_DATA_FOLDER) / "ocean_excerpt.nc", {});
    expectWatertightViews(*source, {5, 10, 15, 20}, {1, 1, 0.05}, "ocean excerpt", viewCount());
}

/// The files of a folder of ISOGLASS_DATA whose names contain `part`, sorted; none without the data.
std::vector<std::filesystem::path> dataFiles(const std::string& folder, const std::string& part) {
    const char* data = std::getenv("ISOGLASS_DATA");
    if (!data) return {};
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(data) / folder)) {
        if (entry.path().filename().string().find(part) != std::string::npos) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
}

// Bytes: the iso-values equal samples.
TEST(LevelsOfRealData, StormIsWatertight) {
    const auto files = dataFiles("storm", "Storm.pvm");
    if (files.empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const auto source = openPvm(files, {});
    expectWatertightViews(*source, {25, 76, 128}, glm::dvec3(1), "storm", viewCount());
}

#if ISOGLASS_VTK
// A descending axis, uneven times, and land of value 0 exactly.
TEST(LevelsOfRealData, IsabelIsWatertight) {
    const auto files = dataFiles("isabel", ".vti");
    if (files.empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const auto source = openVtkImages(files, {});
    expectWatertightViews(*source, {20, 30, 40, 50}, {1, 1, 0.2}, "Isabel", viewCount());
}

// Pieces that merge and split.
TEST(LevelsOfRealData, FingersAreWatertight) {
    const auto files = dataFiles("fingers", ".vti");
    if (files.empty()) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    const auto source = openVtkImages(files, {});
    expectWatertightViews(*source, {15, 25, 35, 50}, glm::dvec3(1), "fingers", viewCount());
}
#endif

}  // namespace
}  // namespace isoglass
