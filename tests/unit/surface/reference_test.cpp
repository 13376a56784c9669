#include "mesh/mesh_check.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace isoglass {
namespace {

using test::expectAsReference;
using test::extractDense;

/// Sizes around a brick: below one, one, one and a sample more, several of different lengths.
const std::vector<glm::ivec3> kSizes = {{2, 2, 2},  {3, 2, 5},  {8, 8, 8},  {9, 9, 9},    {10, 7, 9},
                                        {17, 5, 2}, {2, 17, 5}, {5, 2, 17}, {16, 16, 16}, {25, 9, 17}};

Lattice unitLattice(glm::ivec3 dims) {
    return makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
}

std::string nameOf(glm::ivec3 dims) {
    return std::to_string(dims.x) + "x" + std::to_string(dims.y) + "x" + std::to_string(dims.z);
}

/// Random increasing coordinates with steps between 0.5 and 1.5.
Lattice unevenLattice(glm::ivec3 dims, std::uint32_t seed) {
    Lattice lattice = unitLattice(dims);
    for (int k = 0; k < 3; ++k) {
        const std::vector<float> steps = randomFloats({dims[k], 1, 1}, seed + static_cast<std::uint32_t>(k));
        double position = 0;
        for (int i = 0; i < dims[k]; ++i) {
            lattice.axes[k].coordinates[i] = position;
            position += 1 + 0.5 * static_cast<double>(steps[i]);
        }
    }
    return lattice;
}

/// The axes whose bit is set repeat, a step of 1.25 after their last sample.
void makePeriodic(Lattice& lattice, int axes) {
    for (int k = 0; k < 3; ++k) {
        Axis& axis = lattice.axes[k];
        if (axes >> k & 1) axis.period = std::abs(axis.coordinates.back() - axis.coordinates.front()) + 1.25;
    }
}

void makeDescending(Lattice& lattice, int axes) {
    for (int k = 0; k < 3; ++k) {
        if (!(axes >> k & 1)) continue;
        for (double& coordinate : lattice.axes[k].coordinates) coordinate = -coordinate;
    }
}

TEST(ExtractAgainstReference, RandomFloats) {
    for (const glm::ivec3 dims : kSizes) {
        for (const float iso : {0.0f, 0.7f, -0.9f}) {
            const auto samples = randomFloats(dims, 1);
            for (const bool below : {false, true}) {
                expectAsReference(unitLattice(dims), samples, iso, below, nameOf(dims));
            }
        }
    }
}

TEST(ExtractAgainstReference, IsoEqualToSamples) {
    for (const glm::ivec3 dims : kSizes) {
        for (const float iso : {1.0f, 2.0f}) {
            const auto samples = randomIntegers(dims, 4, 2);
            for (const bool below : {false, true}) {
                expectAsReference(unitLattice(dims), samples, iso, below, nameOf(dims));
            }
        }
    }
}

TEST(ExtractAgainstReference, MissingSamples) {
    for (const glm::ivec3 dims : kSizes) {
        for (const std::uint32_t percent : {1u, 10u, 40u, 90u, 100u}) {
            auto samples = percent % 20 == 0 ? randomIntegers(dims, 4, 3) : randomFloats(dims, 3);
            removeSamples(samples, percent, 4);
            for (const bool below : {false, true}) {
                expectAsReference(unitLattice(dims), samples, percent % 20 == 0 ? 2.0f : 0.1f, below,
                                  nameOf(dims) + ", missing percent " + std::to_string(percent));
            }
        }
    }
}

// 16 and 8 samples: the closing sample needs a brick of its own. 9 and 13: it lies in the last brick.
TEST(ExtractAgainstReference, PeriodicAxes) {
    for (const glm::ivec3 dims :
         {glm::ivec3(8), glm::ivec3(16, 9, 8), glm::ivec3(13, 8, 16), glm::ivec3(3, 2, 2)}) {
        for (int axes = 1; axes < 8; ++axes) {
            for (const std::uint32_t missing : {0u, 5u}) {
                Lattice lattice = unevenLattice(dims, 5);
                makePeriodic(lattice, axes);
                auto samples = randomFloats(dims, 6);
                removeSamples(samples, missing, 7);
                expectAsReference(lattice, samples, 0.2f, false,
                                  nameOf(dims) + ", periodic axes " + std::to_string(axes));
            }
        }
    }
}

TEST(ExtractAgainstReference, DescendingPeriodicUnevenAxes) {
    for (int descending = 0; descending < 8; ++descending) {
        for (int periodic = 0; periodic < 8; ++periodic) {
            Lattice lattice = unevenLattice({9, 8, 11}, 8);
            makeDescending(lattice, descending);
            makePeriodic(lattice, periodic);
            expectAsReference(lattice, randomFloats({9, 8, 11}, 9), 0.1f, descending % 2 == 1,
                              "descending axes " + std::to_string(descending) + ", periodic axes " +
                                  std::to_string(periodic));
        }
    }
}

// Magnitudes at which a difference of floats overflows or underflows.
TEST(ExtractAgainstReference, ValuesAtTheEndsOfTheFloatRange) {
    for (const float scale : {1.6e38f, 1e-30f, 1e-38f}) {
        auto samples = randomFloats({9, 9, 9}, 10);
        for (float& sample : samples) sample *= scale;
        const Lattice lattice = unitLattice({9, 9, 9});
        const Extraction found = extractDense(lattice, samples, {.iso = 0});
        const ReferenceSurface wanted = extractReference(lattice, samples, 0);
        // Normals of this size lie outside the float range; that they are finite is tested elsewhere.
        EXPECT_EQ(differenceFromReference(found.mesh, wanted, test::positionTolerance(lattice, glm::dvec3(0)),
                                          std::numeric_limits<double>::infinity()),
                  "")
            << scale;
    }
}

TEST(ExtractAgainstReference, AxisOfOneSampleHasNoCells) {
    for (const glm::ivec3 dims :
         {glm::ivec3(1, 9, 9), glm::ivec3(9, 1, 9), glm::ivec3(9, 9, 1), glm::ivec3(1)}) {
        const Extraction found = extractDense(unitLattice(dims), randomFloats(dims, 11), {.iso = 0});
        EXPECT_TRUE(found.mesh.empty()) << nameOf(dims);
        EXPECT_EQ(found.mesh.vertexCount(), 0u) << nameOf(dims);
        EXPECT_EQ(found.stats.lostCells, 0u) << nameOf(dims);
    }
}

TEST(ExtractAgainstReference, AxisOfOneSampleThatRepeatsHasOneCell) {
    Lattice lattice = unitLattice({1, 9, 9});
    makePeriodic(lattice, 1);
    expectAsReference(lattice, randomFloats({1, 9, 9}, 12), 0, false, "1x9x9");
}

// Every sign pattern of a cell, in the middle of samples that are outside: one closed surface.
TEST(ExtractSigns, EveryPatternInACellGivesAClosedManifold) {
    const Lattice lattice = unitLattice({4, 4, 4});
    for (int pattern = 0; pattern < 256; ++pattern) {
        std::vector<float> samples(64, -1);
        for (int corner = 0; corner < 8; ++corner) {
            if (!(pattern >> corner & 1)) continue;
            samples[sampleAt(lattice.dims(), {1 + (corner & 1), 1 + (corner >> 1 & 1), 1 + (corner >> 2)})] =
                1;
        }
        const SurfaceMesh mesh = extractDense(lattice, samples, {.iso = 0}).mesh;
        const MeshTopology topology = checkTopology(mesh);
        EXPECT_TRUE(topology.isOrientedManifold() && topology.isClosed()) << pattern;
        EXPECT_EQ(topology.unreferencedVertices, 0u) << pattern;
        EXPECT_EQ(mesh.empty(), pattern == 0);
        EXPECT_EQ(measure(mesh).volume > 0, pattern != 0) << pattern;
        expectAsReference(lattice, samples, 0, false, "pattern " + std::to_string(pattern));
    }
}

TEST(ExtractOrientation, WindingAndNormalsOfABallPointOutwardOnAllAxes) {
    for (int descending = 0; descending < 8; ++descending) {
        for (const bool below : {false, true}) {
            Lattice lattice = makeUnitLattice(17);
            makeDescending(lattice, descending);
            auto samples = sampleField(lattice, growingSphere, 0);
            if (below) {
                for (float& sample : samples) sample = -sample;
            }
            const SurfaceMesh mesh =
                extractDense(lattice, samples, {.iso = below ? -0.3f : 0.3f, .insideIsBelow = below}).mesh;
            ASSERT_FALSE(mesh.empty());
            EXPECT_GT(measure(mesh).volume, 0) << descending << " " << below;
            EXPECT_TRUE(checkTopology(mesh).isOrientedManifold());
            for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
                EXPECT_GT(glm::dot(mesh.positions[i], mesh.normals[i]), 0) << descending << " " << below;
            }
        }
    }
}

TEST(ReferenceComparison, SeesAMovedVertexATurnedNormalAndASwappedTriangle) {
    const Lattice lattice = unitLattice({9, 9, 9});
    const auto samples = randomFloats({9, 9, 9}, 13);
    const ReferenceSurface wanted = extractReference(lattice, samples, 0);
    const SurfaceMesh mesh = extractDense(lattice, samples, {.iso = 0}).mesh;
    const auto difference = [&](const SurfaceMesh& changed) {
        return differenceFromReference(changed, wanted, test::positionTolerance(lattice, glm::dvec3(0)),
                                       test::normalTolerance(lattice, samples));
    };
    ASSERT_EQ(difference(mesh), "");
    SurfaceMesh moved = mesh;
    moved.positions[100].x += 1e-4f;
    EXPECT_NE(difference(moved), "");
    SurfaceMesh turned = mesh;
    turned.normals[100] = -turned.normals[100];
    EXPECT_NE(difference(turned), "");
    SurfaceMesh swapped = mesh;
    std::swap(swapped.triangles[0], swapped.triangles[1]);
    EXPECT_NE(difference(swapped), "");
}

}  // namespace
}  // namespace isoglass
