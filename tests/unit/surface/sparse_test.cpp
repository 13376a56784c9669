#include "mesh/mesh_check.h"
#include "unit/surface/surface_check.h"
#include "unit/volume/series_fixture.h"
#include "volume/analytic.h"
#include "volume/narrow_band.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>

namespace isoglass {
namespace {

using test::MemorySource;
using test::sameBytes;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

std::size_t denseBytes(glm::ivec3 dims, std::size_t frames = 1) {
    return sampleCount(dims) * frames * sizeof(float);
}

/// States what a series takes; the numbers are for people, so they are printed and recorded.
void report(const std::string& what, const std::string& kind, std::size_t bytes, std::size_t dense) {
    std::cout << what << ": " << bytes << " bytes of " << kind << ", dense " << dense << "\n";
    testing::Test::RecordProperty(what + "_" + kind + "_bytes", std::to_string(bytes));
    testing::Test::RecordProperty(what + "_dense_bytes", std::to_string(dense));
}

/// Stores every brick sample by sample, so that nothing is a tile: the same field, dense.
std::shared_ptr<const KeyFrame> makeUnprunedFrame(const Lattice& lattice, const std::vector<float>& samples) {
    const glm::ivec3 dims = lattice.dims();
    const glm::ivec3 bricks = (dims + 7) / 8;
    const std::size_t count = sampleCount(bricks);
    KeyFrame::Pool pool;
    pool.samples.assign(count * kBrickSamples, 0);
    pool.valid.assign(count * kBrickSize, 0);
    std::vector<BrickView> views(count);
    std::vector<std::uint32_t> index(count);
    for (std::size_t b = 0; b < count; ++b) {
        index[b] = static_cast<std::uint32_t>(b);
        views[b].samples = &pool.samples[b * kBrickSamples];
        views[b].valid = &pool.valid[b * kBrickSize];
    }
    for (int z = 0; z < dims.z; ++z) {
        for (int y = 0; y < dims.y; ++y) {
            for (int x = 0; x < dims.x; ++x) {
                const float value = samples[sampleAt(dims, {x, y, z})];
                if (std::isnan(value)) continue;
                const std::size_t b = sampleAt(bricks, glm::ivec3(x, y, z) / 8);
                pool.samples[b * kBrickSamples + static_cast<std::size_t>((x % 8 * 8 + y % 8) * 8 + z % 8)] =
                    value;
                pool.valid[b * kBrickSize + static_cast<std::size_t>(x % 8)] |= std::uint64_t{1}
                                                                                << (y % 8 * 8 + z % 8);
            }
        }
    }
    const glm::bvec3 periodic(lattice.axes[0].period, lattice.axes[1].period, lattice.axes[2].period);
    return std::make_shared<KeyFrame>(dims, periodic, std::move(pool), std::move(views), std::move(index));
}

/// Flat away from a ball, with a block of missing samples: every kind of brick.
std::vector<float> plateauField(const Lattice& lattice, double time) {
    const glm::ivec3 dims = lattice.dims();
    auto samples = sampleField(
        lattice,
        [](glm::dvec3 p, double t) {
            return static_cast<float>(std::clamp(0.4 + 0.1 * t - glm::length(p), -0.125, 0.125));
        },
        time);
    for (int z = 0; z < 11; ++z) {
        for (int y = 0; y < dims.y / 2; ++y) {
            for (int x = 0; x < dims.x / 2; ++x) samples[sampleAt(dims, {x, y, z})] = kMissing;
        }
    }
    return samples;
}

TEST(ExtractSparse, SparseKeyFramesGiveTheMeshOfDenseOnes) {
    const Lattice lattice = makeUnitLattice(67);
    const auto samplesA = plateauField(lattice, 0);
    const auto samplesB = plateauField(lattice, 1);
    const auto sparseA = makeKeyFrame(lattice, samplesA);
    const auto sparseB = makeKeyFrame(lattice, samplesB);
    const auto denseA = makeUnprunedFrame(lattice, samplesA);
    const auto denseB = makeUnprunedFrame(lattice, samplesB);
    EXPECT_LT(2 * sparseA->bytes(), denseA->bytes());
    for (const float fraction : {0.0f, 0.4f, 1.0f}) {
        // 0.125 is the plateau itself: the surface runs along constant bricks.
        for (const float iso : {0.0f, 0.1f, 0.125f, -0.125f}) {
            const Extraction sparse = extractSurface(lattice, {sparseA, sparseB, fraction}, {.iso = iso});
            const Extraction dense = extractSurface(lattice, {denseA, denseB, fraction}, {.iso = iso});
            EXPECT_TRUE(sameBytes(sparse.mesh, dense.mesh)) << fraction << " " << iso;
            EXPECT_EQ(sparse.stats.lostCells, dense.stats.lostCells);
            EXPECT_EQ(sparse.mesh.empty(), iso == -0.125f);
        }
    }
}

/// Imports `source` and checks that the surfaces through the file are those of the dense samples, at key
/// times and between.
void expectSurfacesThroughFile(FrameSource& source, const std::filesystem::path& path, float iso,
                               const std::string& what) {
    const SeriesDescription series = writeSeries(source, path);
    const SeriesFile file(path);
    const glm::ivec3 dims = series.lattice.dims();
    const std::size_t count = series.time.times.size();
    std::vector<std::vector<float>> dense(count, std::vector<float>(sampleCount(dims)));
    std::vector<std::shared_ptr<const KeyFrame>> frames;
    std::size_t memory = 0;
    for (std::size_t i = 0; i < count; ++i) {
        source.read(i, dense[i]);
        frames.push_back(file.read(i));
        memory += frames.back()->bytes();
        EXPECT_EQ(frames.back()->bytes(), series.frames[i].bytes);
    }
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t next = i + 1 < count ? i + 1 : 0;
        for (const float fraction : {0.0f, 0.37f}) {
            const Extraction found =
                extractSurface(series.lattice, {frames[i], frames[next], fraction}, {.iso = iso});
            const auto middle =
                fraction == 0 ? dense[i] : test::interpolated(dense[i], dense[next], fraction);
            const Extraction wanted =
                test::extractFrame(series.lattice, makeUnprunedFrame(series.lattice, middle), {.iso = iso});
            triangles += wanted.mesh.triangleCount();
            EXPECT_TRUE(sameBytes(found.mesh, wanted.mesh))
                << what << ", key frame " << i << " + " << fraction;
            EXPECT_EQ(found.stats.lostCells, wanted.stats.lostCells);
        }
    }
    EXPECT_GT(triangles, 0u);
    report(what, "memory", memory, denseBytes(dims, count));
    report(what, "file", std::filesystem::file_size(path), denseBytes(dims, count));
}

TEST(ExtractSparse, OceanThroughTheFileGivesTheDenseSurfaces) {
    const ScratchFolder folder;
    const auto source = openNetcdf(std::filesystem::path(ISOGLASS_DATA_FOLDER) / "ocean_excerpt.nc", {});
    expectSurfacesThroughFile(*source, folder / "ocean.vdb", 15, "ocean");
}

// The package is on the list that scripts/install reads, so only a build without it skips this.
TEST(ExtractSparse, WholeOceanThroughTheFileGivesTheDenseSurfaces) {
    const std::filesystem::path ocean = "/usr/share/ferret-vis/data/ocean_atlas_subset.nc";
    if (!std::filesystem::exists(ocean)) GTEST_SKIP() << "the package ferret-datasets is not installed";
    const ScratchFolder folder;
    const auto source = openNetcdf(ocean, {});
    expectSurfacesThroughFile(*source, folder / "ocean.vdb", 20, "whole_ocean");
}

TEST(ExtractSparse, StormThroughTheFileGivesTheDenseSurfaces) {
    const char* data = std::getenv("ISOGLASS_DATA");
    if (!data) GTEST_SKIP() << "ISOGLASS_DATA names no folder of real data";
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(data) / "storm")) {
        if (entry.path().filename().string().find(".pvm") != std::string::npos) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    ASSERT_FALSE(files.empty());
    const auto source = openPvm(files, {});
    const ScratchFolder folder;
    expectSurfacesThroughFile(*source, folder / "storm.vdb", 20, "storm");
}

// 1024^3 floats are 4.3 GB; the band is a thousandth of them. In voxels h = 1, so vertices are within
// 1/(8(R-1)) of the sphere. Distances up to 3 are differences of two floats below 1024, and vertices are
// floats below 1024: an ulp of 512 each for the sample's rounding and for each of three coordinates.
TEST(ExtractSparse, NarrowBandThatDenseSamplesCouldNotHold) {
    constexpr int kSamples = 1024;
    constexpr double kRadius = 150.3;
    const ScratchFolder folder;
    writeNarrowBandSphere(folder / "band.vdb", kSamples, kRadius, 3);
    const auto frame = SeriesFile(folder / "band.vdb").read(0);
    const std::size_t dense = denseBytes(frame->dims());
    const std::size_t fileBytes = std::filesystem::file_size(folder / "band.vdb");
    report("narrow_band", "memory", frame->bytes(), dense);
    report("narrow_band", "file", fileBytes, dense);
    EXPECT_LT(10 * frame->bytes(), dense);
    EXPECT_LT(10 * fileBytes, dense);
    EXPECT_EQ(frame->sample({0, 0, 0}), 3);
    EXPECT_EQ(frame->sample(glm::ivec3(kSamples / 2)), -3);
    // Read as axes of voxels: distance is negative inside, so inside is below.
    const Lattice lattice = makeUniformLattice(glm::ivec3(kSamples), glm::dvec3(0), glm::dvec3(1));
    const SurfaceMesh mesh = test::extractFrame(lattice, frame, {.iso = 0, .insideIsBelow = true}).mesh;
    const MeshTopology topology = checkTopology(mesh);
    const auto direct = makeNarrowBandSphere(kSamples, kRadius, 3);
    EXPECT_TRUE(sameBytes(mesh, test::extractFrame(lattice, direct, {.iso = 0, .insideIsBelow = true}).mesh));
    EXPECT_TRUE(topology.isOrientedManifold() && topology.isClosed());
    EXPECT_EQ(topology.eulerNumber, 2);
    EXPECT_EQ(topology.components, 1u);
    EXPECT_GT(measure(mesh).volume, 0);
    const double bound =
        1 / (8 * (kRadius - 1)) + 4 * 512 * static_cast<double>(std::numeric_limits<float>::epsilon());
    const glm::dvec3 centre(0.5 * (kSamples - 1));
    double largest = 0;
    for (const glm::vec3& position : mesh.positions) {
        largest = std::max(largest, std::abs(glm::length(glm::dvec3(position) - centre) - kRadius));
    }
    EXPECT_LE(largest, bound);
    EXPECT_GT(largest, 0.5 / (8 * (kRadius - 1))) << "the bound is nearly attained";
}

}  // namespace
}  // namespace isoglass
