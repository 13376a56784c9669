#include "surface/vertex_values.h"

#include "support/random_fields.h"
#include "surface_check.h"
#include "volume/analytic.h"

namespace isoglass {
namespace {

SurfaceMesh pointsAt(std::vector<glm::vec3> positions) {
    SurfaceMesh mesh;
    mesh.positions = std::move(positions);
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    return mesh;
}

float linear(glm::dvec3 p, double time) {
    return static_cast<float>(1 + 2 * p.x - 3 * p.y + 0.5 * p.z + time);
}

TEST(SampleAtVertices, IsExactForLinearFieldsOnUnevenAndDescendingAxes) {
    Lattice lattice = makeUniformLattice({5, 6, 7}, {0, 0, 0}, {1, 1, 1});
    lattice.axes[0].coordinates = {0, 0.5, 2, 2.25, 4};
    lattice.axes[1].coordinates = {5, 4, 2, 1.5, 0.5, 0};
    const TimedField field{makeAnalyticFrame(lattice, linear, 0), makeAnalyticFrame(lattice, linear, 10),
                           0.25f};
    std::vector<glm::vec3> positions;
    for (float x = 0; x <= 4; x += 0.25f) {
        for (float y = 0; y <= 5; y += 0.3f) positions.push_back({x, y, 0.7f + x});
    }
    const SurfaceMesh mesh = pointsAt(positions);
    const std::vector<float> values = sampleAtVertices(mesh, lattice, field);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        // Samples of up to 30 rounded to float, and the result again.
        EXPECT_NEAR(values[i], linear(positions[i], 2.5), 30 * 0x1p-23);
    }
}

TEST(SampleAtVertices, OfTheExtractedFieldAreTheIsoValue) {
    const Lattice lattice = makeUniformLattice({12, 13, 14}, {3, -2, 0}, {1, 2, 0.5});
    const auto samples = randomFloats(lattice.dims(), 4);
    const auto frame = makeKeyFrame(lattice, samples);
    const SurfaceMesh mesh = test::extractFrame(lattice, frame, {.iso = 0.125f}).mesh;
    const std::vector<float> values = sampleAtVertices(mesh, lattice, {frame, nullptr, 0});
    std::size_t onAxisEdges = 0;
    for (const float value : values) {
        // Positions of up to 22 rounded to float on edges of 0.5, along which the field changes by at most 2.
        onAxisEdges += std::abs(value - 0.125f) < 2 / 0.5 * 22 * 0x1p-24 * 2;
    }
    // The others lie on body diagonals, where the field is linear in the tetrahedra and not along the axes.
    EXPECT_GT(onAxisEdges, values.size() * 9 / 10);
}

TEST(SampleAtVertices, OutsideAndMissingAreNotNumbers) {
    const Lattice lattice = makeUniformLattice({4, 4, 4}, {0, 0, 0}, {1, 1, 1});
    std::vector<float> samples(64, 5);
    samples[sampleAt(lattice.dims(), {2, 2, 2})] = std::numeric_limits<float>::quiet_NaN();
    const SurfaceMesh mesh =
        pointsAt({{-0.5f, 1, 1}, {1, 1, 3.5f}, {1.5f, 1.5f, 1.5f}, {2, 2, 1}, {0.5f, 0.5f, 0.5f}, {3, 3, 3}});
    const std::vector<float> values =
        sampleAtVertices(mesh, lattice, {makeKeyFrame(lattice, samples), nullptr, 0});
    for (const std::size_t i : {0u, 1u, 2u}) EXPECT_TRUE(std::isnan(values[i])) << i;
    for (const std::size_t i : {3u, 4u, 5u}) EXPECT_EQ(values[i], 5) << i;
}

TEST(SampleAtVertices, WrapsAroundPeriodicAxes) {
    Lattice lattice = makeUniformLattice({4, 2, 2}, {0, 0, 0}, {1, 1, 1});
    lattice.axes[0].period = 4;
    std::vector<float> samples(16);
    for (std::size_t i = 0; i < 16; ++i) samples[i] = static_cast<float>(i % 4);
    const SurfaceMesh mesh = pointsAt({{3.5f, 0, 0}, {-0.5f, 0, 0}, {5, 0, 0}});
    const std::vector<float> values =
        sampleAtVertices(mesh, lattice, {makeKeyFrame(lattice, samples), nullptr, 0});
    EXPECT_EQ(values, (std::vector<float>{1.5f, 1.5f, 1}));
}

TEST(MeanCurvature, OfASphereIsOneOverItsRadius) {
    const Lattice lattice = makeUnitLattice(40);
    const auto frame = makeAnalyticFrame(lattice, growingSphere, 0);
    for (const float iso : {0.3f, 0.6f}) {
        const SurfaceMesh mesh = test::extractFrame(lattice, frame, {.iso = iso}).mesh;
        const double expected = 1 / (1.0 - iso);
        double sum = 0;
        for (const float value : meanCurvature(mesh)) {
            // Central differences over h = 2 / 39 bend the normals by h^2 / r^2 at most, 2 %; the patches are
            // flat over one cell, another h / (2 r) at single vertices.
            EXPECT_NEAR(value, expected, 0.1 * expected);
            sum += value;
        }
        EXPECT_NEAR(sum / static_cast<double>(mesh.vertexCount()), expected, 0.02 * expected);
    }
}

TEST(MeanCurvature, OfAPlaneAndOfNothingIsZero) {
    SurfaceMesh plane;
    plane.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}};
    plane.normals.assign(4, {0, 0, 3});
    plane.triangles = {0, 1, 2, 3, 3, 3};
    EXPECT_EQ(meanCurvature(plane), std::vector<float>(4));
}

}  // namespace
}  // namespace isoglass
