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
#include <memory>
#include <vector>

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

// f = c s - p.p: its gradient is linear, so differences and interpolation make no error. A vertex p goes by
// c ds / (2 |p|) along p, where f - iso has changed by -(c ds)^2 / (4 p.p), but would have changed by c ds
// had it stood still: second order against first. Rounding: that of products below 4, and of -2 p as their
// difference over two steps of 1/8, is below 2^-19.
TEST(Motion, IsOffByTheSquareOfTheStep) {
    constexpr double kChange = 0.25;
    const Lattice lattice = makeUniformLattice(glm::ivec3(17), glm::dvec3(-1), glm::dvec3(0.125));
    const auto ball = [](glm::dvec3 p, double t) { return static_cast<float>(kChange * t - glm::dot(p, p)); };
    const TimedField field{makeAnalyticFrame(lattice, ball, 0), makeAnalyticFrame(lattice, ball, 1), 0};
    const SurfaceMesh mesh = meshAt(lattice, field, 0.25f, {.iso = -0.49f});
    ASSERT_FALSE(mesh.empty());
    for (const float motion : {0.5f, 0.25f, 0.125f, -0.125f}) {
        const SurfaceMesh there = moved(mesh, motion, motionLimit(lattice));
        const double way = kChange * motion;
        for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
            const glm::dvec3 before = mesh.origin + glm::dvec3(mesh.positions[i]);
            const glm::dvec3 after = there.origin + glm::dvec3(there.positions[i]);
            const double square = glm::dot(before, before);
            EXPECT_NEAR(way + square - glm::dot(after, after), -way * way / (4 * square), 0x1p-19) << motion;
        }
    }
}

TEST(Motion, StopsAtTheLimit) {
    EXPECT_EQ(displacement({3, 0, 4}, 0.5f, 10), glm::vec3(1.5f, 0, 2));
    EXPECT_EQ(displacement({3, 0, 4}, -0.5f, 1.25f), glm::vec3(-0.75f, 0, -1));
    EXPECT_EQ(displacement({0, 0, 0}, 1, 0), glm::vec3(0));
    Lattice lattice = makeUniformLattice({5, 6, 7}, glm::dvec3(0), {2, -1, 3});
    EXPECT_EQ(motionLimit(lattice), 1);
}

TEST(Motion, IsZeroWhereASampleIsMissing) {
    const Lattice lattice = makeUniformLattice(glm::ivec3(3), glm::dvec3(0), glm::dvec3(1));
    std::vector<float> a(27, 0), b(27, 1);
    b[0] = std::numeric_limits<float>::quiet_NaN();
    const TimedField field{makeKeyFrame(lattice, a), makeKeyFrame(lattice, b), 0.5f};
    SurfaceMesh mesh;
    mesh.positions = {{0.5f, 0.5f, 0.5f}, {1.5f, 1.5f, 1.5f}};
    mesh.normals.assign(2, {2, 0, 0});
    const std::vector<glm::vec3> expected{{0, 0, 0}, {0.5f, 0, 0}};
    EXPECT_EQ(normalVelocities(mesh, lattice, field, {}), expected);
}

// A million steps of the lattice, which is 1 here.
TEST(Motion, IsFiniteWhereTheGradientVanishes) {
    const Lattice lattice = makeUniformLattice(glm::ivec3(3), glm::dvec3(0), glm::dvec3(1));
    const TimedField field{makeKeyFrame(lattice, std::vector<float>(27, 0)),
                           makeKeyFrame(lattice, std::vector<float>(27, 1)), 0.5f};
    SurfaceMesh mesh;
    mesh.positions.assign(2, glm::vec3(0.5f));
    mesh.normals = {{1e-38f, 0, 0}, {0, -std::numeric_limits<float>::denorm_min(), 0}};
    const std::vector<glm::vec3> expected{{1e6f, 0, 0}, {0, -1e6f, 0}};
    EXPECT_EQ(normalVelocities(mesh, lattice, field, {}), expected);
}

TEST(Motion, IsNotKnownAtAKeyFrame) {
    const Lattice lattice = makeUniformLattice(glm::ivec3(9), glm::dvec3(0), glm::dvec3(1));
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), nullptr, 0};
    EXPECT_TRUE(meshAt(lattice, field, 0, {}).velocities.empty());
}

/// Farther apart than that, in cells, does not count more.
constexpr double kReach = 10;

/// Between the vertices of a mesh and another mesh, in cells.
struct Distances {
    double mean, p999;
};
Distances distancesBetween(const SurfaceMesh& mesh, const SurfaceMesh& exact, double cell) {
    const test::MeshDistance distance(exact, 2 * cell);
    std::vector<double> cells;
    double sum = 0;
    for (const glm::vec3& p : mesh.positions) {
        cells.push_back(std::min(distance.at(p, kReach * cell) / cell, kReach));
        sum += cells.back();
    }
    std::ranges::sort(cells);
    const auto last = static_cast<double>(cells.size() - 1);
    return {sum / static_cast<double>(cells.size()), cells[static_cast<std::size_t>(0.999 * last)]};
}

/// Between a mesh of another moment and the exact one.
struct Error {
    Distances still, moved;
};
Error errorAfter(const char* name, const Lattice& lattice, const TimedField& field, float motion,
                 const ExtractOptions& options) {
    constexpr float kFrom = 0.3f;
    const SurfaceMesh mesh = meshAt(lattice, field, kFrom, options);
    const SurfaceMesh exact = meshAt(lattice, field, kFrom + motion, options);
    const double cell = motionLimit(lattice);
    const Error error{distancesBetween(mesh, exact, cell),
                      distancesBetween(moved(mesh, motion, cell), exact, cell)};
    std::printf("%s, %.3f of the interval: mean and 99.9 %% off by %.4f %.4f cells still, %.4f %.4f moved\n",
                name, motion, error.still.mean, error.still.p999, error.moved.mean, error.moved.p999);
    return error;
}

// How much nearer is printed; the law is tested above.
TEST(Motion, IsNearerThanStandingStill) {
    const Lattice lattice = makeUnitLattice(65);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), makeAnalyticFrame(lattice, blobs, 0.1), 0};
    for (const float motion : {0.4f, 0.2f, 0.1f, 0.05f}) {
        const Error error = errorAfter("blobs 65^3", lattice, field, motion, {.iso = 0.5f});
        EXPECT_LT(error.moved.mean, error.still.mean) << motion;
        EXPECT_LT(error.moved.p999, error.still.p999) << motion;
    }
}

// Coarser cells stand where their own field is the iso-value, but move as the finest does.
TEST(Motion, OfLevelsOfDetailIsNearerThanStandingStill) {
    const Lattice lattice = makeUnitLattice(129);
    const TimedField field{makeAnalyticFrame(lattice, blobs, 0), makeAnalyticFrame(lattice, blobs, 0.1), 0};
    const View view{.eye = {2, 4, 1}, .pixelsPerUnit = 1343.6, .errorPixels = 1};
    const auto trianglesOf = [&](const ExtractOptions& options) {
        return meshAt(lattice, field, 0.3f, options).triangleCount();
    };
    ASSERT_LT(trianglesOf({.iso = 0.5f, .view = view}), trianglesOf({.iso = 0.5f}) / 2);
    for (const float motion : {0.2f, 0.1f, 0.05f}) {
        const Error error =
            errorAfter("blobs 129^3 at 1 pixel", lattice, field, motion, {.iso = 0.5f, .view = view});
        EXPECT_LT(error.moved.mean, error.still.mean) << motion;
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
        const Error error = errorAfter("storm", lattice, {frames[0], frames[1], 0}, motion, {.iso = 76});
        EXPECT_LT(error.moved.mean, error.still.mean) << motion;
    }
}

}  // namespace
}  // namespace isoglass
