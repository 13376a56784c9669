#include "surface/motion.h"

#include "support/mesh_distance.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"
#include "volume/frame_source.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>

namespace isoglass {
namespace {

SurfaceMesh meshAt(const Lattice& lattice, TimedField field, float fraction, const ExtractOptions& options) {
    field.fraction = fraction;
    SurfaceMesh mesh = extractSurface(lattice, field, options).mesh;
    mesh.velocities = normalVelocities(mesh, lattice, field, options);
    return mesh;
}

SurfaceMesh moved(SurfaceMesh mesh, float motion, double limit) {
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i)
        mesh.positions[i] += displacement(mesh.velocities[i], motion, static_cast<float>(limit));
    return mesh;
}

// A field that is linear in place and time: its plane moves by (0.5, 0.25) * 1.6 along its normal from one
// key frame to the next, exactly but for the rounding of positions up to 8.
TEST(Motion, OfAPlaneIsExact) {
    const Lattice lattice = makeUniformLattice(glm::ivec3(17), glm::dvec3(0), glm::dvec3(0.5));
    const auto plane = [](glm::dvec3 p, double t) { return static_cast<float>(2 * p.x + p.y - 8 - 2 * t); };
    const TimedField field{makeAnalyticFrame(lattice, plane, 0), makeAnalyticFrame(lattice, plane, 1), 0};
    for (const bool below : {false, true}) {
        const SurfaceMesh mesh = meshAt(lattice, field, 0.25f, {.insideIsBelow = below});
        ASSERT_FALSE(mesh.empty());
        for (const glm::vec3& velocity : mesh.velocities)
            EXPECT_NEAR(glm::length(velocity - glm::vec3(0.8f, 0.4f, 0)), 0, 0x1p-18);
        for (const glm::vec3& p : moved(mesh, 0.5f, 10).positions)
            EXPECT_NEAR(2 * (mesh.origin.x + p.x) + mesh.origin.y + p.y - 8, 1.5, 0x1p-18);
    }
}

TEST(Motion, StopsAtTheLimit) {
    EXPECT_EQ(displacement({3, 0, 4}, 0.5f, 10), glm::vec3(1.5f, 0, 2));
    EXPECT_EQ(displacement({3, 0, 4}, -0.5f, 1.25f), glm::vec3(-0.75f, 0, -1));
    EXPECT_EQ(displacement({0, 0, 0}, 1, 0), glm::vec3(0));
    Lattice lattice = makeUniformLattice({5, 6, 7}, glm::dvec3(0), {2, -1, 3});
    EXPECT_EQ(motionLimit(lattice), 1);
}

TEST(Motion, IsZeroBesideMissingSamplesAndFiniteWhereTheGradientVanishes) {
    const Lattice lattice = makeUniformLattice(glm::ivec3(9), glm::dvec3(0), glm::dvec3(1));
    std::vector<float> a(729), b(729);
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = static_cast<float>(i % 9) - 4.25f;
        b[i] = i % 9 < 6 ? a[i] + 1e30f * static_cast<float>(i % 2) : a[i];
    }
    b[9 * 9 * 4 + 9 * 4 + 4] = std::numeric_limits<float>::quiet_NaN();
    const TimedField field{makeKeyFrame(lattice, a), makeKeyFrame(lattice, b), 0};
    const SurfaceMesh mesh = meshAt(lattice, field, 1e-6f, {});
    ASSERT_EQ(mesh.velocities.size(), mesh.vertexCount());
    for (const glm::vec3& velocity : mesh.velocities) EXPECT_TRUE(std::isfinite(glm::length(velocity)));
    EXPECT_TRUE(meshAt(lattice, {field.a, nullptr, 0}, 0, {}).velocities.empty());
}

/// Farther apart than that, in cells, does not count more.
constexpr double kReach = 10;

/// Mean distance between a mesh of another moment and the exact one, in cells.
struct Distances {
    double still, moved;
};
Distances distances(const Lattice& lattice, const TimedField& field, float from, float motion,
                    const ExtractOptions& options) {
    const SurfaceMesh mesh = meshAt(lattice, field, from, options);
    const SurfaceMesh exact = meshAt(lattice, field, from + motion, options);
    const double cell = motionLimit(lattice);
    const test::MeshDistance distance(exact, 2 * cell);
    const auto mean = [&](const SurfaceMesh& other) {
        double sum = 0;
        for (const glm::vec3& p : other.positions)
            sum += std::min(distance.at(p, kReach * cell) / cell, kReach);
        return sum / static_cast<double>(other.vertexCount());
    };
    return {mean(mesh), mean(moved(mesh, motion, cell))};
}

// A surface that stands still is off by the way it would have gone, one that moves by the square of it: the
// shorter the way, the more there is to gain, until what the normals lack takes over.
TEST(Motion, IsSeveralTimesNearerThanStandingStill) {
    const Lattice lattice = makeUnitLattice(65);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), makeAnalyticFrame(lattice, blobs, 0.1), 0};
    for (const float motion : {0.4f, 0.2f, 0.1f, 0.05f}) {
        const Distances found = distances(lattice, field, 0.3f, motion, {.iso = 0.5f});
        std::printf("blobs 64^3, %.2f of the interval: off by %.4f cells still, %.4f moved\n", motion,
                    found.still, found.moved);
        EXPECT_LT(found.moved, found.still / 4) << motion;
    }
}

// Bytes that change by up to half their range from key frame to key frame.
TEST(Motion, OfTheStormIsNearerThanStandingStill) {
    const char* folder = std::getenv("ISOGLASS_DATA");
    if (!folder) GTEST_SKIP() << "ISOGLASS_DATA is not set";
    std::vector<std::filesystem::path> files;
    for (const char* name : {"Storm.pvm-t10", "Storm.pvm-t11"})
        files.push_back(std::filesystem::path(folder) / "storm" / name);
    const auto source = openPvm(files, {});
    const Lattice& lattice = source->description().lattice;
    std::array<std::shared_ptr<const KeyFrame>, 2> frames;
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::ivec3 dims = lattice.dims();
        std::vector<float> samples(static_cast<std::size_t>(dims.x) * dims.y * dims.z);
        source->read(i, samples);
        frames[i] = makeKeyFrame(lattice, samples);
    }
    for (const float motion : {0.2f, 0.1f, 0.05f}) {
        const Distances found = distances(lattice, {frames[0], frames[1], 0}, 0.3f, motion, {.iso = 76});
        std::printf("storm, %.2f of the interval: off by %.4f cells still, %.4f moved\n", motion, found.still,
                    found.moved);
        EXPECT_LT(found.moved, found.still) << motion;
    }
}

}  // namespace
}  // namespace isoglass
