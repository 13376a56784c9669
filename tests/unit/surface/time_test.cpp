#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"
#include "volume/time_axis.h"

#include <gtest/gtest.h>

namespace isoglass {
namespace {

using test::extractFrame;
using test::interpolated;
using test::sameBytes;

struct Series {
    Lattice lattice;
    TimeAxis time;
    std::vector<std::vector<float>> dense;
    std::vector<std::shared_ptr<const KeyFrame>> frames;
};

Series makeSeries(const Lattice& lattice, const AnalyticField& field, const std::vector<double>& times) {
    Series series;
    series.lattice = lattice;
    series.time.times = times;
    for (const double time : times) {
        series.dense.push_back(sampleField(lattice, field, time));
        series.frames.push_back(makeKeyFrame(lattice, series.dense.back()));
    }
    return series;
}

SurfaceMesh meshAt(const Series& series, double time, float iso) {
    const TimeSample place = locate(series.time, time);
    return extractSurface(
               series.lattice,
               {series.frames[place.frameA], series.frames[place.frameB], static_cast<float>(place.fraction)},
               {.iso = iso})
        .mesh;
}

/// The mesh of a volume that was interpolated as a whole first.
SurfaceMesh bruteForceAt(const Series& series, std::size_t a, std::size_t b, float fraction, float iso) {
    return test::extractDense(series.lattice, interpolated(series.dense[a], series.dense[b], fraction),
                              {.iso = iso})
        .mesh;
}

TEST(ExtractTime, FractionsZeroAndOneAreTheKeyFrames) {
    const glm::ivec3 dims(19, 9, 13);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    for (const std::uint32_t missing : {0u, 15u}) {
        auto samplesA = randomFloats(dims, 1);
        auto samplesB = randomFloats(dims, 2);
        removeSamples(samplesA, missing, 3);
        removeSamples(samplesB, missing, 4);
        const auto a = makeKeyFrame(lattice, samplesA);
        const auto b = makeKeyFrame(lattice, samplesB);
        const ExtractOptions options{.iso = 0.1f};
        const auto at = [&](float fraction) { return extractSurface(lattice, {a, b, fraction}, options); };
        EXPECT_TRUE(sameBytes(at(0).mesh, extractFrame(lattice, a, options).mesh));
        EXPECT_TRUE(sameBytes(at(1).mesh, extractFrame(lattice, b, options).mesh));
        EXPECT_FALSE(sameBytes(at(0).mesh, at(1).mesh));
        EXPECT_EQ(at(1).stats.lostCells, extractFrame(lattice, b, options).stats.lostCells);
    }
}

TEST(ExtractTime, OneKeyFrameNeedsNoSecond) {
    const Lattice lattice = makeUnitLattice(17);
    const auto frame = makeAnalyticFrame(lattice, growingSphere, 0);
    EXPECT_GT(extractSurface(lattice, {frame, nullptr, 0}, {.iso = 0.3f}).mesh.triangleCount(), 0u);
}

// Same arithmetic, a + s (b - a) in float, hence the same bytes.
TEST(ExtractTime, BetweenKeyFramesTheSurfaceIsThatOfTheInterpolatedVolume) {
    const Series smooth = makeSeries(makeUnitLattice(33), blobs, {0, 0.1});
    for (const float fraction : {0.0f, 1e-30f, 0.001f, 0.25f, 0.5f, 0.7321f, 0.999f, 0.99999994f, 1.0f}) {
        const SurfaceMesh mesh =
            extractSurface(smooth.lattice, {smooth.frames[0], smooth.frames[1], fraction}, {.iso = 0.5f})
                .mesh;
        EXPECT_GT(mesh.triangleCount(), 100u);
        EXPECT_TRUE(sameBytes(mesh, fraction == 1 ? bruteForceAt(smooth, 1, 1, 0, 0.5f)
                                                  : bruteForceAt(smooth, 0, 1, fraction, 0.5f)))
            << fraction;
    }
}

TEST(ExtractTime, RandomFramesGiveTheInterpolatedVolumeOnBothSides) {
    for (const std::uint32_t missing : {0u, 3u, 30u}) {
        for (const glm::ivec3 dims : {glm::ivec3(9), glm::ivec3(17, 8, 11)}) {
            Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
            lattice.axes[0].period = dims.x;
            auto a = randomIntegers(dims, 5, 5);
            auto b = randomIntegers(dims, 5, 6);
            removeSamples(a, missing, 7);
            removeSamples(b, missing, 8);
            const TimedField field{makeKeyFrame(lattice, a), makeKeyFrame(lattice, b), 0.5f};
            for (const bool below : {false, true}) {
                // 2 and 1.5 are values that interpolated integers take.
                for (const float iso : {2.0f, 1.5f, 2.3f}) {
                    const ExtractOptions options{.iso = iso, .insideIsBelow = below};
                    const Extraction found = extractSurface(lattice, field, options);
                    const auto middle = interpolated(a, b, 0.5f);
                    const Extraction wanted = test::extractDense(lattice, middle, options);
                    EXPECT_TRUE(sameBytes(found.mesh, wanted.mesh)) << missing << " " << iso;
                    EXPECT_EQ(found.stats.lostCells, wanted.stats.lostCells);
                }
            }
        }
    }
}

// Samples that are equal in both key frames stay so at every time: the surface does not tremble.
TEST(ExtractTime, ConstantSamplesGiveOneSurfaceAtAllTimes) {
    const glm::ivec3 dims(9, 9, 9);
    const Lattice lattice = makeUniformLattice(dims, glm::dvec3(0), glm::dvec3(1));
    const auto frame = makeKeyFrame(lattice, randomFloats(dims, 9));
    const SurfaceMesh still = extractFrame(lattice, frame, {.iso = 0}).mesh;
    for (const float fraction : {0.1f, 1.0f / 3, 0.9f}) {
        EXPECT_TRUE(sameBytes(extractSurface(lattice, {frame, frame, fraction}, {.iso = 0}).mesh, still));
    }
}

TEST(ExtractTime, UnevenKeyTimesAreFollowed) {
    const Series series = makeSeries(makeUnitLattice(17), growingSphere, {0, 0.1, 1, 1.05});
    EXPECT_TRUE(sameBytes(meshAt(series, 0.1, 0.3f), bruteForceAt(series, 1, 1, 0, 0.3f)));
    const auto fraction = static_cast<float>((0.55 - 0.1) / 0.9);
    EXPECT_TRUE(sameBytes(meshAt(series, 0.55, 0.3f), bruteForceAt(series, 1, 2, fraction, 0.3f)));
    // The field is linear in time, so the radius at any time is that of the formula: 0.7 + 0.3 t. Same
    // bound as for one sphere, with two key frames' roundings instead of one.
    const double h = 2.0 / 16;
    for (const double time : {0.05, 0.55, 1.02}) {
        const double radius = 0.7 + 0.3 * time;
        const SurfaceMesh mesh = meshAt(series, time, 0.3f);
        ASSERT_FALSE(mesh.empty());
        for (const glm::vec3& position : mesh.positions) {
            EXPECT_NEAR(std::sqrt(static_cast<double>(position.x) * position.x +
                                  static_cast<double>(position.y) * position.y +
                                  static_cast<double>(position.z) * position.z),
                        radius, h * h / (8 * (radius - h)) + 6 * std::numeric_limits<float>::epsilon());
        }
    }
}

TEST(ExtractTime, OutsideTheSeriesTheNearestKeyFrameIsShown) {
    const Series series = makeSeries(makeUnitLattice(17), growingSphere, {0, 0.5, 0.6});
    EXPECT_TRUE(sameBytes(meshAt(series, -3, 0.3f), bruteForceAt(series, 0, 0, 0, 0.3f)));
    EXPECT_TRUE(sameBytes(meshAt(series, 7, 0.3f), bruteForceAt(series, 2, 2, 0, 0.3f)));
    EXPECT_EQ(locate(series.time, -3).where, TimeSample::Where::beforeFirst);
    EXPECT_EQ(locate(series.time, 7).where, TimeSample::Where::afterLast);
}

TEST(ExtractTime, SingleKeyFrameIsShownAtEveryTime) {
    const Series series = makeSeries(makeUnitLattice(17), growingSphere, {5});
    const SurfaceMesh wanted = bruteForceAt(series, 0, 0, 0, 0.3f);
    for (const double time : {-1.0, 5.0, 6.0}) EXPECT_TRUE(sameBytes(meshAt(series, time, 0.3f), wanted));
}

TEST(ExtractTime, DecemberRunsIntoJanuary) {
    Series series = makeSeries(makeUnitLattice(17), growingSphere, {0.5, 1.5, 2.5});
    series.time.period = 3;
    // 3.25 lies three quarters of the way from 2.5 to 0.5 + 3; so does 0.25 before the first key frame.
    const SurfaceMesh wanted = bruteForceAt(series, 2, 0, 0.75f, 0.3f);
    EXPECT_TRUE(sameBytes(meshAt(series, 3.25, 0.3f), wanted));
    EXPECT_TRUE(sameBytes(meshAt(series, 0.25, 0.3f), wanted));
    EXPECT_TRUE(sameBytes(meshAt(series, 3.5, 0.3f), bruteForceAt(series, 0, 0, 0, 0.3f)));
}

}  // namespace
}  // namespace isoglass
