#include "unit/surface/surface_check.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <random>

namespace isoglass {
namespace {

using test::MemorySource;
using test::sameBytes;

/// A ball that wanders through a domain of 9 bricks a side and changes its size, so that most bricks are
/// far from its surface and those near it change from key frame to key frame.
float wanderingBall(glm::dvec3 p, double time) {
    const glm::dvec3 centre(0.35 * std::cos(time), 0.35 * std::sin(time), 0.1 * std::sin(2 * time));
    return static_cast<float>(1 - 2 * glm::length(p - centre) + 0.2 * std::sin(3 * time) +
                              0.02 * std::sin(40 * p.x) * std::sin(35 * p.y) * std::sin(30 * p.z));
}

struct Limits {
    bool cyclic = false;
    bool periodicAxis = false;
};

MemorySource makeSource(const Limits& limits) {
    Lattice lattice = makeUnitLattice(72);
    if (limits.periodicAxis) lattice.axes[0].period = 2 + 2.0 / 71;
    SeriesDescription series = test::describe(lattice, 6);
    if (limits.cyclic) series.time.period = 6;
    std::vector<std::vector<float>> frames;
    for (int i = 0; i < 6; ++i) frames.push_back(sampleField(lattice, wanderingBall, i * 1.0472));
    return {series, frames};
}

std::vector<std::shared_ptr<const KeyFrame>> readAll(const std::filesystem::path& path) {
    const SeriesFile file(path);
    std::vector<std::shared_ptr<const KeyFrame>> frames;
    for (std::size_t i = 0; i < file.description().frames.size(); ++i) frames.push_back(file.read(i));
    return frames;
}

std::uint64_t activeVoxels(const SeriesDescription& series) {
    std::uint64_t sum = 0;
    for (const FrameRecord& frame : series.frames) sum += frame.activeVoxels;
    return sum;
}

// At every time between key frames, also between the last and the first of a cyclic series.
void expectSameSurfaces(const Limits& limits) {
    const ScratchFolder folder;
    MemorySource source = makeSource(limits);
    constexpr ValueRange kKeep{0.25f, 0.5f};
    const SeriesDescription whole = writeSeries(source, folder / "whole.vdb");
    const SeriesDescription kept = writeSeries(source, folder / "kept.vdb", {.keep = kKeep});
    EXPECT_EQ(kept.keep, kKeep);
    EXPECT_LT(2 * activeVoxels(kept), activeVoxels(whole)) << "most bricks must be dropped";
    EXPECT_LT(std::filesystem::file_size(folder / "kept.vdb"),
              std::filesystem::file_size(folder / "whole.vdb"));
    const auto wholeFrames = readAll(folder / "whole.vdb");
    const auto keptFrames = readAll(folder / "kept.vdb");
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i) {
        const double time = random() * 0x1p-32 * (limits.cyclic ? 6 : 5);
        const TimeSample at = locate(whole.time, time);
        const auto fraction = static_cast<float>(at.fraction);
        for (const float iso :
             {kKeep.min, kKeep.max, kKeep.min + static_cast<float>(random() * 0x1p-32) * 0.25f}) {
            const ExtractOptions options{.iso = iso, .insideIsBelow = i % 2 == 1};
            const SurfaceMesh wanted =
                extractSurface(whole.lattice, {wholeFrames[at.frameA], wholeFrames[at.frameB], fraction},
                               options)
                    .mesh;
            const SurfaceMesh found =
                extractSurface(kept.lattice, {keptFrames[at.frameA], keptFrames[at.frameB], fraction},
                               options)
                    .mesh;
            ASSERT_GT(wanted.triangleCount(), 100u);
            ASSERT_TRUE(sameBytes(found, wanted)) << "time " << time << " iso " << iso;
        }
    }
    // Outside the interval surfaces are allowed to differ, and with this field they do.
    const SurfaceMesh outside = test::extractFrame(whole.lattice, wholeFrames[0], {.iso = -0.2f}).mesh;
    EXPECT_FALSE(sameBytes(outside, test::extractFrame(whole.lattice, keptFrames[0], {.iso = -0.2f}).mesh));
}

TEST(Keep, SurfacesInTheIntervalAreThoseOfTheWholeSeries) {
    expectSameSurfaces({});
}

TEST(Keep, CyclicSeriesKeepsWhatTheTurnOfTheYearNeeds) {
    expectSameSurfaces({.cyclic = true});
}

TEST(Keep, PeriodicAxisKeepsWhatItsEndsNeed) {
    expectSameSurfaces({.cyclic = true, .periodicAxis = true});
}

// Planes of every direction around the corner where eight bricks meet: the crossed cells, and the samples
// that their gradients need, reach into each of the 26 neighbours.
TEST(Keep, NeighboursOfEveryDirectionKeepWhatASurfaceNeeds) {
    const ScratchFolder folder;
    const glm::ivec3 dims(40);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    for (int direction = 0; direction < 27; ++direction) {
        const glm::dvec3 normal(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
        if (normal == glm::dvec3(0)) continue;
        for (const double shift : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
            const auto plane = [&](glm::dvec3 p, double) {
                return static_cast<float>(glm::dot(normal, p - 15.5) + shift);
            };
            const auto samples = sampleField(lattice, plane, 0);
            MemorySource source(test::describe(lattice, 1), {samples});
            const SeriesDescription kept =
                writeSeries(source, folder / "kept.vdb", {.keep = ValueRange{-0.01f, 0.01f}});
            EXPECT_LT(kept.frames[0].activeVoxels, samples.size());
            for (const float iso : {-0.01f, 0.0f, 0.01f}) {
                const SurfaceMesh wanted = test::extractDense(lattice, samples, {.iso = iso}).mesh;
                const SurfaceMesh found =
                    test::extractFrame(lattice, readAll(folder / "kept.vdb")[0], {.iso = iso}).mesh;
                ASSERT_FALSE(wanted.empty());
                ASSERT_TRUE(sameBytes(found, wanted)) << "direction " << direction << " shift " << shift;
            }
        }
    }
}

}  // namespace
}  // namespace isoglass
