#include "numeric/case_fields.h"
#include "numeric/table_row.h"
#include "support/random_fields.h"
#include "unit/surface/surface_check.h"
#include "volume/analytic.h"
#include "volume/time_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass::numeric {
namespace {

constexpr double kSecondsOfTenYears = 10 * 365.25 * 86400;

SurfaceMesh meshAt(const TimeAxis& time, const std::vector<std::shared_ptr<const KeyFrame>>& frames,
                   const Lattice& lattice, double moment) {
    const TimeSample place = locate(time, moment);
    return extractSurface(
               lattice, {frames[place.frameA], frames[place.frameB], static_cast<float>(place.fraction)}, {})
        .mesh;
}

TEST(NumericTime, EqualKeyFramesGiveTheSameBytesAtEveryFraction) {
    const glm::ivec3 dims(9, 10, 11);
    const auto frame = makeKeyFrame(unitLattice(dims), randomFloats(dims, 1));
    const SurfaceMesh still = extractSurface(unitLattice(dims), {frame, nullptr, 0}, {}).mesh;
    ASSERT_FALSE(still.empty());
    // a + s (a - a) = a + 0 for every s.
    for (int i = 0; i <= 1000; i += 7) {
        const float fraction = static_cast<float>(i) / 1000;
        EXPECT_TRUE(
            test::sameBytes(still, extractSurface(unitLattice(dims), {frame, frame, fraction}, {}).mesh));
    }
}

// Key times 1 ms and 10 years apart in one series: the fraction is that of the interval, to half an ulp.
TEST(NumericTime, KeyTimesOneMillisecondAndTenYearsApart) {
    TimeAxis time;
    time.times = {0, 0.001, 0.001 + kSecondsOfTenYears};
    const TimeSample inMillisecond = locate(time, 0.00025);
    EXPECT_EQ(inMillisecond.frameA, 0u);
    EXPECT_NEAR(inMillisecond.fraction, 0.25, 2 * std::numeric_limits<double>::epsilon());
    const TimeSample inYears = locate(time, 0.001 + 0.75 * kSecondsOfTenYears);
    EXPECT_EQ(inYears.frameA, 1u);
    // Times of 3.2e8 are rounded by 2^-25 s, three of them.
    EXPECT_NEAR(inYears.fraction, 0.75, 3 * 0x1p-25 / kSecondsOfTenYears);
    // Every key time is its key frame, alone and exactly.
    for (std::size_t i = 0; i < time.times.size(); ++i)
        EXPECT_EQ(locate(time, time.times[i]), (TimeSample{i, i, 0}));
    addTableRow("KeyTimesOneMillisecondAndTenYearsApart", "short intervals vanish beside long ones",
                "fractions to half an ulp in both; every key time is its key frame exactly");
}

// The same motion on a clock that starts at 0 and on one that counts seconds since 1970.
TEST(NumericTime, EpochsOf1e9SecondsDoNotShakeTheSurface) {
    const Lattice lattice = makeUnitLattice(33);
    std::vector<std::shared_ptr<const KeyFrame>> frames;
    for (const double t : {0.0, 1.0})
        frames.push_back(makeAnalyticFrame(
            lattice, [](glm::dvec3 p, double s) { return growingSphere(p, s) - 0.3f; }, t));
    constexpr double kEpoch = 1.7e9;
    constexpr double kInterval = 1e-3;
    TimeAxis near;
    near.times = {0, kInterval};
    TimeAxis far;
    far.times = {kEpoch, kEpoch + kInterval};
    // Doubles of 1.7e9 step by 2^-22: each of the two key times and the moment is off by half of that. Over
    // the interval of 1 ms that is a fraction of at most 3 * 2^-23 / (1e-3 - 2^-22).
    const double fractionError = 3 * 0x1p-23 / (kInterval - 0x1p-22);
    // The radius grows by 0.3 over the interval; float positions below 1.
    const double bound = 0.3 * fractionError + 2 * std::numeric_limits<float>::epsilon();
    double worst = 0;
    for (const double part : {0.1, 0.5, 0.9}) {
        const SurfaceMesh a = meshAt(near, frames, lattice, part * kInterval);
        const SurfaceMesh b = meshAt(far, frames, lattice, kEpoch + part * kInterval);
        const auto radius = [](const SurfaceMesh& mesh) {
            double sum = 0;
            for (const glm::vec3& p : mesh.positions)
                sum += std::sqrt(static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y +
                                 static_cast<double>(p.z) * p.z);
            return sum / static_cast<double>(mesh.vertexCount());
        };
        ASSERT_FALSE(a.empty());
        // Means over vertices; a vertex more or less changes a mean by less than the chord error h^2/8.
        worst = std::max(worst, std::abs(radius(a) - radius(b)));
    }
    EXPECT_LE(worst, bound);
    addTableRow("EpochsOf1e9Seconds", "times lose their digits before they are subtracted",
                "key frames 1 ms apart at 1.7e9 s: the surface is off by " + std::to_string(worst) +
                    " of the 0.3 it moves, the rounding of the times themselves");
}

TEST(NumericTime, SignFlipVanishesAtOneMomentOnly) {
    const glm::ivec3 dims(17, 17, 17);
    // No sample is 0, which would be inside before and after.
    const auto samples = ball(dims, 6.1);
    auto flipped = samples;
    for (float& sample : flipped) sample = -sample;
    const auto a = makeKeyFrame(unitLattice(dims), samples);
    const auto b = makeKeyFrame(unitLattice(dims), flipped);
    const auto at = [&](float fraction) {
        return extractSurface(unitLattice(dims), {a, b, fraction}, {.threads = 1}).mesh;
    };
    EXPECT_TRUE(at(0.5f).empty());
    // A quarter of the way f = a/2 exactly: the positions of a.
    const SurfaceMesh before = at(0.25f);
    EXPECT_EQ(before.positions, at(0).positions);
    EXPECT_EQ(before.triangles, at(0).triangles);
    // Three quarters of the way f = a - 1.5 a, where 1.5 a is rounded by 2^-24 of it, 3 * 2^-24 of f: a
    // crossing moves by at most half of twice that along its edge, and positions below 16 are rounded. What
    // was outside is inside.
    const SurfaceMesh after = at(0.75f);
    ASSERT_EQ(after.vertexCount(), before.vertexCount());
    for (std::size_t i = 0; i < after.vertexCount(); ++i) {
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(after.positions[i][k], before.positions[i][k], (3 + 16) * 0x1p-24);
    }
    EXPECT_GT(measure(before).volume, 0);
    EXPECT_LT(measure(after).volume, 0);
}

}  // namespace
}  // namespace isoglass::numeric
