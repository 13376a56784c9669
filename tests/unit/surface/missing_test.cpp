#include "mesh/mesh_check.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"

#include <gtest/gtest.h>

namespace isoglass {
namespace {

using test::extractDense;
using test::sameBytes;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

std::vector<float> allMissing(glm::ivec3 dims) {
    return std::vector<float>(sampleCount(dims), kMissing);
}

TEST(ExtractMissing, OneMissingSampleLosesTheCrossedCellsAroundIt) {
    // A plane between z = 4 and z = 5; a missing sample under it touches four cells that it crosses.
    const Lattice lattice = makeUniformLattice({10, 10, 10}, glm::dvec3(0), glm::dvec3(1));
    auto samples = sampleField(
        lattice, [](glm::dvec3 p, double) { return static_cast<float>(4.5 - p.z); }, 0);
    const Extraction whole = extractDense(lattice, samples, {.iso = 0});
    EXPECT_EQ(whole.stats.lostCells, 0u);
    EXPECT_EQ(whole.mesh.triangleCount(), 2u * 9 * 9);
    samples[sampleAt(lattice.dims(), {5, 5, 4})] = kMissing;
    const Extraction holed = extractDense(lattice, samples, {.iso = 0});
    EXPECT_EQ(holed.stats.lostCells, 4u);
    EXPECT_EQ(holed.mesh.triangleCount(), 2u * (81 - 4));
    // The rim of the plane and that of the hole.
    EXPECT_EQ(checkTopology(holed.mesh).boundaryEdges, 4u * 9 + 8);
    samples[sampleAt(lattice.dims(), {5, 5, 4})] = 0.5f;
    samples[sampleAt(lattice.dims(), {5, 5, 1})] = kMissing;
    EXPECT_EQ(extractDense(lattice, samples, {.iso = 0}).stats.lostCells, 0u) << "far from the surface";
}

TEST(ExtractMissing, WholeKeyFrameMissingGivesNoSurfaceAndNoRange) {
    const Lattice lattice = makeUniformLattice({9, 17, 8}, glm::dvec3(0), glm::dvec3(1));
    const auto none = makeKeyFrame(lattice, allMissing(lattice.dims()));
    const auto some = makeKeyFrame(lattice, randomFloats(lattice.dims(), 3));
    const std::vector<TimedField> fields = {
        {none, nullptr, 0}, {none, none, 0.5f}, {none, some, 0.5f}, {some, none, 0.5f}, {some, none, 1}};
    for (const TimedField& field : fields) {
        const Extraction result = extractSurface(lattice, field, {.iso = 0});
        EXPECT_TRUE(result.mesh.empty());
        EXPECT_EQ(result.mesh.vertexCount(), 0u);
        EXPECT_GT(result.stats.range.min, result.stats.range.max) << "empty range";
        EXPECT_EQ(result.stats.lostCells, 0u);
        EXPECT_EQ(result.stats.touchedBricks, 0u);
    }
    EXPECT_FALSE(extractSurface(lattice, {none, some, 1}, {.iso = 0}).mesh.empty());
}

TEST(ExtractMissing, BrickMissingInOneOfTwoKeyFramesIsMissingBetweenThem) {
    const glm::ivec3 dims(24, 16, 16);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const auto a = randomFloats(dims, 4);
    auto b = randomFloats(dims, 5);
    for (int z = 0; z < 8; ++z) {
        for (int y = 8; y < 16; ++y) {
            for (int x = 8; x < 16; ++x) b[sampleAt(dims, {x, y, z})] = kMissing;
        }
    }
    const auto frameA = makeKeyFrame(lattice, a);
    const auto frameB = makeKeyFrame(lattice, b);
    for (const float fraction : {0.3f, 0.8f}) {
        const auto middle = test::interpolated(a, b, fraction);
        const Extraction found = extractSurface(lattice, {frameA, frameB, fraction}, {.iso = 0.2f});
        const Extraction turned = extractSurface(lattice, {frameB, frameA, fraction}, {.iso = 0.2f});
        const ReferenceSurface wanted = extractReference(lattice, middle, 0.2f);
        EXPECT_EQ(differenceFromReference(found.mesh, wanted, test::positionTolerance(lattice, glm::dvec3(0)),
                                          test::normalTolerance(lattice, middle)),
                  "");
        EXPECT_EQ(found.stats.lostCells, wanted.lostCells);
        EXPECT_GT(found.stats.lostCells, 0u);
        EXPECT_EQ(turned.stats.lostCells,
                  extractReference(lattice, test::interpolated(b, a, fraction), 0.2f).lostCells);
    }
    EXPECT_EQ(extractSurface(lattice, {frameA, frameB, 0}, {.iso = 0.2f}).stats.lostCells, 0u);
}

TEST(ExtractRange, IsoValueOutsideGivesAnEmptyMeshAndTheRangeSaysSo) {
    const Lattice lattice = makeUniformLattice({17, 9, 9}, glm::dvec3(0), glm::dvec3(1));
    const auto a = randomIntegers(lattice.dims(), 5, 6);
    auto b = a;
    for (float& sample : b) sample += 10;
    const auto frameA = makeKeyFrame(lattice, a);
    const auto frameB = makeKeyFrame(lattice, b);
    for (const float iso : {-0.001f, 4.001f, 1e30f}) {
        const Extraction result = test::extractFrame(lattice, frameA, {.iso = iso});
        EXPECT_TRUE(result.mesh.empty());
        EXPECT_EQ(result.stats.range, (ValueRange{0, 4})) << iso;
        EXPECT_EQ(result.stats.touchedBricks, 0u);
        EXPECT_EQ(result.stats.bricks, 3u * 2 * 2);
    }
    const Extraction between = extractSurface(lattice, {frameA, frameB, 0.5f}, {.iso = 4});
    EXPECT_TRUE(between.mesh.empty());
    // 5 .. 9, widened by 4 ulp of the largest magnitude, 14.
    const float slack = 4 * std::numeric_limits<float>::epsilon() * 14;
    EXPECT_NEAR(between.stats.range.min, 5, 1.01f * slack);
    EXPECT_NEAR(between.stats.range.max, 9, 1.01f * slack);
    EXPECT_LE(between.stats.range.min, 5);
    EXPECT_GE(between.stats.range.max, 9);
}

TEST(ExtractRange, IsoValueAtTheEndsOfTheRange) {
    const Lattice lattice = makeUniformLattice({9, 9, 9}, glm::dvec3(0), glm::dvec3(1));
    const auto samples = randomIntegers(lattice.dims(), 3, 7);
    // Inside is f >= iso: the smallest value has all samples inside, the largest those that attain it.
    EXPECT_TRUE(extractDense(lattice, samples, {.iso = 0}).mesh.empty());
    EXPECT_FALSE(extractDense(lattice, samples, {.iso = 2}).mesh.empty());
    EXPECT_FALSE(extractDense(lattice, samples, {.iso = 0, .insideIsBelow = true}).mesh.empty());
    EXPECT_TRUE(extractDense(lattice, samples, {.iso = 2, .insideIsBelow = true}).mesh.empty());
}

TEST(ExtractRange, ConstantFieldHasNoSurface) {
    const Lattice lattice = makeUniformLattice({17, 17, 17}, glm::dvec3(0), glm::dvec3(1));
    const std::vector<float> samples(sampleCount(lattice.dims()), 2);
    for (const bool below : {false, true}) {
        for (const float iso : {1.0f, 2.0f, 3.0f}) {
            EXPECT_TRUE(extractDense(lattice, samples, {.iso = iso, .insideIsBelow = below}).mesh.empty())
                << iso;
        }
    }
}

// Rounding may carry an interpolated value past the interpolated range: skipping must not cut the surface
// there. Values that differ by ulps, at all fractions, against the volume that was interpolated first.
TEST(ExtractRange, SkippingNeverLosesAnInterpolatedValue) {
    const glm::ivec3 dims(9, 9, 9);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    std::size_t surfaces = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const auto noise = randomFloats(dims, seed);
        std::vector<float> a(noise.size());
        std::vector<float> b(noise.size());
        for (std::size_t i = 0; i < noise.size(); ++i) {
            a[i] = 1 + noise[i] * 0x1p-22f;
            b[i] = -3 - noise[i] * 0x1p-20f;
        }
        const float fraction = static_cast<float>(seed) / 200;
        const auto middle = test::interpolated(a, b, fraction);
        const float iso = *std::ranges::max_element(middle);
        const Extraction wanted = extractDense(lattice, middle, {.iso = iso});
        const Extraction found = extractSurface(
            lattice, {makeKeyFrame(lattice, a), makeKeyFrame(lattice, b), fraction}, {.iso = iso});
        EXPECT_TRUE(sameBytes(found.mesh, wanted.mesh)) << seed;
        surfaces += !wanted.mesh.empty();
    }
    EXPECT_GT(surfaces, 100u);
}

}  // namespace
}  // namespace isoglass
