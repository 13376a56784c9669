#include "numeric/digital_topology.h"

#include "mesh/mesh_check.h"
#include "numeric/case_fields.h"
#include "numeric/table_row.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace isoglass::numeric {
namespace {

/// Random samples with a rim that is outside, so that the surface is closed.
std::vector<float> walled(glm::ivec3 dims, std::vector<float> samples, float outside) {
    const auto rim = fill(dims, [&](glm::ivec3 i) {
        for (int k = 0; k < 3; ++k) {
            if (i[k] == 0 || i[k] == dims[k] - 1) return 1.0f;
        }
        return 0.0f;
    });
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (rim[i] == 1) samples[i] = outside;
    }
    return samples;
}

void expectDigitalTopology(glm::ivec3 dims, const std::vector<float>& samples, float iso, bool below) {
    const DigitalTopology digital = digitalTopology(dims, samples, iso, below);
    ASSERT_TRUE(digital.closed);
    const SurfaceMesh mesh =
        test::extractDense(unitLattice(dims), samples, {.iso = iso, .insideIsBelow = below}).mesh;
    const MeshTopology topology = checkTopology(mesh);
    EXPECT_TRUE(topology.isOrientedManifold() && topology.isClosed()) << describe(mesh);
    EXPECT_EQ(topology.components, digital.surfaceComponents);
    EXPECT_EQ(topology.eulerNumber, digital.surfaceEulerNumber);
}

TEST(DigitalTopology, CountsKnownSolids) {
    const glm::ivec3 dims(7, 7, 7);
    const auto solid = [&](const std::function<bool(glm::ivec3)>& inside) {
        return digitalTopology(dims, fill(dims, [&](glm::ivec3 i) { return inside(i) ? 1.0f : -1.0f; }), 0,
                               false);
    };
    const auto within = [](glm::ivec3 i, int low, int high) {
        return std::min({i.x, i.y, i.z}) >= low && std::max({i.x, i.y, i.z}) <= high;
    };
    // A block is a ball.
    const DigitalTopology block = solid([&](glm::ivec3 i) { return within(i, 2, 4); });
    EXPECT_EQ(block.surfaceComponents, 1u);
    EXPECT_EQ(block.surfaceEulerNumber, 2);
    // With a hollow inside: two spheres.
    const DigitalTopology hollow = solid([&](glm::ivec3 i) { return within(i, 1, 5) && !within(i, 3, 3); });
    EXPECT_EQ(hollow.surfaceComponents, 2u);
    EXPECT_EQ(hollow.surfaceEulerNumber, 4);
    // Drilled through: a torus.
    const DigitalTopology drilled =
        solid([&](glm::ivec3 i) { return within(i, 2, 4) && !(i.x == 3 && i.y == 3); });
    EXPECT_EQ(drilled.surfaceComponents, 1u);
    EXPECT_EQ(drilled.surfaceEulerNumber, 0);
    // Two samples that share no Kuhn edge, and two that do.
    EXPECT_EQ(solid([&](glm::ivec3 i) {
                  return i == glm::ivec3(3, 2, 3) || i == glm::ivec3(2, 3, 3);
              }).surfaceComponents,
              2u);
    EXPECT_EQ(solid([&](glm::ivec3 i) {
                  return i == glm::ivec3(2, 2, 3) || i == glm::ivec3(3, 3, 3);
              }).surfaceComponents,
              1u);
}

// Every sign case of a cell, its complement included, is met once with everything else outside: the patch and
// its neighbours close to a manifold with the topology that the corners' Kuhn edges give.
TEST(DigitalTopology, All256SignCasesGiveTheClosedSurfaceOfTheirCorners) {
    const glm::ivec3 dims(4, 4, 4);
    for (int pattern = 0; pattern < 256; ++pattern) {
        const auto samples = fill(dims, [&](glm::ivec3 i) {
            const glm::ivec3 corner = i - 1;
            for (int k = 0; k < 3; ++k) {
                if (corner[k] < 0 || corner[k] > 1) return -1.0f;
            }
            return pattern >> (corner.x | corner.y << 1 | corner.z << 2) & 1 ? 0.5f : -1.0f;
        });
        SCOPED_TRACE(pattern);
        expectDigitalTopology(dims, samples, 0, false);
        // The same with the inside corners at the iso-value itself.
        expectDigitalTopology(dims, samples, 0.5f, false);
    }
    addTableRow("All256SignCases", "an ambiguous cell is triangulated against its neighbour",
                "256 closed manifolds, Euler number and components as digital topology says");
}

TEST(DigitalTopology, RandomFieldsHaveTheComponentsAndEulerNumberOfTheirSigns) {
    std::ptrdiff_t smallest = 0;
    std::size_t most = 0;
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const glm::ivec3 dims(8 + seed % 11, 7 + seed % 13, 9 + seed % 10);
        SCOPED_TRACE(seed);
        // From sparse to dense.
        const float iso = -0.6f + 0.2f * static_cast<float>(seed % 7);
        const auto floats = walled(dims, randomFloats(dims, seed), -2);
        expectDigitalTopology(dims, floats, iso, false);
        expectDigitalTopology(dims, walled(dims, randomFloats(dims, seed), 2), iso, true);
        expectDigitalTopology(dims, walled(dims, randomIntegers(dims, 3, seed), -1), 1, false);
        const DigitalTopology digital = digitalTopology(dims, floats, iso, false);
        smallest = std::min(smallest, digital.surfaceEulerNumber);
        most = std::max(most, digital.surfaceComponents);
    }
    // The fields are as complicated as they are meant to be.
    EXPECT_LT(smallest, -100);
    EXPECT_GT(most, 20u);
    addTableRow("RandomTopology", "pieces and handles appear or vanish",
                "180 random fields: components (up to " + std::to_string(most) +
                    ") and Euler number (down to " + std::to_string(smallest) +
                    ") exactly those of the signs");
}

}  // namespace
}  // namespace isoglass::numeric
