#include "numeric/case_fields.h"
#include "numeric/table_row.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/lattice_check.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace isoglass::numeric {
namespace {

constexpr double kUlp = std::numeric_limits<float>::epsilon();

SurfaceMesh meshOf(const HardCase& hard) {
    return extractSurface(hard.lattice, hard.field(), hard.options()).mesh;
}

const HardCase& caseNamed(const std::string& name) {
    for (const HardCase& hard : hardCases()) {
        if (hard.name == name) return hard;
    }
    throw std::invalid_argument("no case " + name);
}

using Position = std::tuple<float, float, float>;

std::set<Position> positionsOf(const SurfaceMesh& mesh) {
    std::set<Position> positions;
    for (const glm::vec3& p : mesh.positions) positions.insert({p.x, p.y, p.z});
    return positions;
}

// A power of two changes no quotient (iso - a)/(b - a), whatever the range.
TEST(NumericValues, RangesGiveTheSamePositionsBitByBit) {
    const SurfaceMesh normal = meshOf(caseNamed("RangeOf1e30"));
    for (const char* name : {"RangeOf1eMinus30", "DenormalRange"}) {
        const SurfaceMesh other = meshOf(caseNamed(name));
        EXPECT_EQ(other.positions, normal.positions) << name;
        EXPECT_EQ(other.triangles, normal.triangles) << name;
    }
}

TEST(NumericValues, WhatIsNoUsableNumberIsMissingAsNanIs) {
    const SurfaceMesh nan = meshOf(caseNamed("NanRegion"));
    ASSERT_FALSE(nan.empty());
    for (const char* name : {"InfiniteRegion", "MinusInfiniteRegion", "FillValue"})
        EXPECT_TRUE(test::sameBytes(meshOf(caseNamed(name)), nan)) << name;
}

TEST(NumericValues, CrossingsOfNeighbouringFloatsLieOnTheirSamples) {
    const SurfaceMesh mesh = meshOf(caseNamed("NearlyEqualEnds"));
    ASSERT_FALSE(mesh.empty());
    // The iso-value is the value of the inside end, so t is exactly 0 or 1.
    for (const glm::vec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k) ASSERT_EQ(p[k], std::round(p[k]));
}

TEST(NumericValues, CrossingsOfSmallestDenormalsLieInTheMiddle) {
    const SurfaceMesh mesh = meshOf(caseNamed("SmallestDenormals"));
    ASSERT_FALSE(mesh.empty());
    // 2^-149 / 2^-148 = 1/2 exactly along every direction.
    for (const glm::vec3& p : mesh.positions)
        for (int k = 0; k < 3; ++k) ASSERT_EQ(2 * p[k], std::round(2 * p[k]));
}

// Only edges that end at the outlier see it: every other vertex is where it is without it.
TEST(NumericValues, AnOutlierMovesNothingButItsOwnSphere) {
    const glm::ivec3 dims(17, 17, 17);
    const glm::ivec3 place(2, 2, 2);
    const SurfaceMesh without = test::extractDense(unitLattice(dims), ball(dims, 6), {.iso = 0}).mesh;
    const std::set<Position> known = positionsOf(without);
    const SurfaceMesh mesh = meshOf(caseNamed("OneOutlierOf1e30"));
    std::size_t around = 0;
    for (const glm::vec3& p : mesh.positions) {
        if (known.contains({p.x, p.y, p.z})) continue;
        ++around;
        // An edge from the outlier at 1e30 to a sample of at least -9 crosses 0 a part 9e-30 before its end.
        const glm::vec3 offset = p - glm::vec3(place);
        for (int k = 0; k < 3; ++k) EXPECT_LE(std::abs(offset[k]), 1);
    }
    EXPECT_EQ(mesh.vertexCount(), without.vertexCount() + around);
    EXPECT_GE(around, 6u);
}

// Central differences of an alternating field vanish away from the domain's end; the normal is then along the
// edge that carries the vertex, from inside to outside.
TEST(NumericValues, WhereTheGradientVanishesNormalsFollowTheirEdges) {
    const HardCase& hard = caseNamed("GradientZeroAtEveryCrossing");
    const SurfaceMesh mesh = meshOf(hard);
    std::size_t inner = 0;
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::vec3 p = mesh.positions[i];
        if (std::min({p.x, p.y, p.z}) < 1 || std::max({p.x, p.y, p.z}) > 8) continue;
        int along = -1;
        int axes = 0;
        for (int k = 0; k < 3; ++k) {
            if (p[k] != std::round(p[k])) {
                along = k;
                ++axes;
            }
        }
        if (axes != 1) continue;  // the body diagonal
        ++inner;
        glm::ivec3 low(p);
        const float atLow = hard.samples[sampleAt(hard.lattice.dims(), low)];
        glm::vec3 outward(0);
        outward[along] = atLow > 0 ? 2.0f : -2.0f;  // samples 2 apart over a step of 1
        EXPECT_EQ(mesh.normals[i], outward) << "vertex " << i;
    }
    EXPECT_GT(inner, 500u);
}

TEST(NumericValues, NormalsAreTheGradientOfALinearFieldOnStepsOf1To1000) {
    const HardCase& hard = caseNamed("RectilinearStepsOf1To1000");
    const SurfaceMesh mesh = meshOf(hard);
    ASSERT_FALSE(mesh.empty());
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        // Samples around x = 100 are below 256 and rounded by 2^-17 at most; differences are taken over steps
        // of at least 25: 2 * 2^-17 / 25, and the roundings of factors, products and sums, 8 ulp of 1.
        const double bound = 2 * 0x1p-17 / 25 + 8 * kUlp;
        EXPECT_LE(glm::length(glm::dvec3(mesh.normals[i]) - glm::dvec3(-1, 0, 0)), bound);
        // Two samples' roundings move the crossing by 2 * 2^-17, and x is rounded to half an ulp of 128.
        EXPECT_NEAR(mesh.positions[i].x + mesh.origin.x, 100, 2 * 0x1p-17 + 64 * kUlp);
    }
}

// Squeezing z to a ten-thousandth squeezes the surface and stretches the z component of normals.
TEST(NumericValues, AnisotropyOf10000IsTheIsotropicSurfaceSqueezed) {
    const HardCase& flat = caseNamed("AnisotropyOf10000");
    const SurfaceMesh squeezed = meshOf(flat);
    const SurfaceMesh plain =
        test::extractDense(unitLattice(flat.lattice.dims()), flat.samples, {.iso = flat.iso}).mesh;
    ASSERT_EQ(squeezed.triangles, plain.triangles);
    for (std::size_t i = 0; i < plain.vertexCount(); ++i) {
        const glm::vec3 p = plain.positions[i];
        const glm::vec3 q = squeezed.positions[i];
        EXPECT_EQ(q.x, p.x);
        EXPECT_EQ(q.y, p.y);
        // 16 at most, each rounded by half an ulp of 16, one of them by another 1e-4.
        EXPECT_NEAR(q.z * 1e4, p.z, 16 * 2 * kUlp);
        const glm::vec3 n = plain.normals[i];
        const glm::vec3 m = squeezed.normals[i];
        // Normals are below 2; the factor 1e4 of the axis' table and the product are rounded.
        EXPECT_NEAR(m.x, n.x, 4 * kUlp);
        EXPECT_NEAR(m.z * 1e-4, n.z, 2 * 8 * kUlp);
    }
}

// An origin in double takes the offset; what is left is the surface at 0.
TEST(NumericValues, CoordinatesOf6400kmGiveTheSurfaceOfTheOrigin) {
    const HardCase& far = caseNamed("CoordinatesOf6400km");
    const SurfaceMesh mesh = meshOf(far);
    const SurfaceMesh near =
        test::extractDense(unitLattice(far.lattice.dims()), far.samples, {.iso = far.iso}).mesh;
    ASSERT_EQ(mesh.triangles, near.triangles);
    EXPECT_EQ(mesh.normals, near.normals);
    const glm::dvec3 shift(5e6, 6.4e6, -6.4e6);
    for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
        const glm::dvec3 world = glm::dvec3(mesh.positions[i]) + mesh.origin - shift;
        for (int k = 0; k < 3; ++k)
            // Doubles of 6.4e6 step by 2^-30; both positions, of at most 16, are rounded to float.
            EXPECT_NEAR(world[k], near.positions[i][k], 0x1p-29 + 16 * kUlp);
    }
}

// Steps whose square is no double must still give a direction.
TEST(NumericValues, NormalsAreFiniteOnTheSmallestAndLargestSteps) {
    const glm::ivec3 dims(9, 10, 11);
    for (const double step : {kSmallestStep, 1e-20, 1e20, kLargestCoordinate / 16}) {
        for (const float magnitude : {0x1p-149f, 1.0f, 1.7e38f}) {
            std::vector<float> samples = randomFloats(dims, 3);
            for (float& sample : samples) sample = std::copysign(magnitude, sample);
            const SurfaceMesh mesh =
                test::extractDense(makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(step)), samples, {})
                    .mesh;
            ASSERT_FALSE(mesh.empty());
            for (std::size_t i = 0; i < mesh.vertexCount(); ++i) {
                for (int k = 0; k < 3; ++k) {
                    ASSERT_TRUE(std::isfinite(mesh.positions[i][k])) << step;
                    ASSERT_TRUE(std::isfinite(mesh.normals[i][k])) << step << " " << magnitude;
                }
                ASSERT_NE(mesh.normals[i], glm::vec3(0)) << step << " " << magnitude;
            }
        }
    }
    addTableRow("StepsOf1e-30To1e30", "squares of lengths overflow or vanish in normals",
                "finite normals; coordinates beyond 1e30 are refused with a message");
}

}  // namespace
}  // namespace isoglass::numeric
