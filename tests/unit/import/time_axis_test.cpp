#include "volume/time_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

namespace isoglass {

void PrintTo(const TimeSample& sample, std::ostream* out) {
    *out << "{" << sample.frameA << ", " << sample.frameB << ", " << sample.fraction << ", where "
         << static_cast<int>(sample.where) << "}";
}

namespace {

using Where = TimeSample::Where;

TimeAxis axis(std::vector<double> times, std::optional<double> period = std::nullopt) {
    return {std::move(times), "", "", period};
}

TimeSample alone(std::size_t frame) {
    return {frame, frame, 0};
}

TEST(TimeAxis, UnevenTimesAreInterpolatedBetweenTheirNeighbours) {
    const TimeAxis forecast = axis({0, 6, 12, 24, 30, 36, 48});
    EXPECT_EQ(locate(forecast, 3), (TimeSample{0, 1, 0.5}));
    EXPECT_EQ(locate(forecast, 15), (TimeSample{2, 3, 0.25}));
    EXPECT_EQ(locate(forecast, 45), (TimeSample{5, 6, 0.75}));
}

TEST(TimeAxis, KeyTimeNeedsItsOwnKeyFrameOnly) {
    const TimeAxis forecast = axis({0, 6, 12, 24});
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(locate(forecast, forecast.times[i]), alone(i));
}

TEST(TimeAxis, OutsideTheNearestKeyFrameIsTakenAndSaid) {
    const TimeAxis short_ = axis({-1, 2});
    EXPECT_EQ(locate(short_, -1.5), (TimeSample{0, 0, 0, Where::beforeFirst}));
    EXPECT_EQ(locate(short_, 1e300), (TimeSample{1, 1, 0, Where::afterLast}));
}

TEST(TimeAxis, SingleKeyFrameIsShownAlways) {
    EXPECT_EQ(locate(axis({5}), 5), alone(0));
    EXPECT_EQ(locate(axis({5}), 4), (TimeSample{0, 0, 0, Where::beforeFirst}));
    EXPECT_EQ(locate(axis({5}), 6), (TimeSample{0, 0, 0, Where::afterLast}));
    for (const double time : {-100.0, 5.0, 5.5, 1e9}) EXPECT_EQ(locate(axis({5}, 1), time), alone(0)) << time;
}

TEST(TimeAxis, YearRunsFromDecemberIntoJanuary) {
    const TimeAxis year = axis({1, 4, 8}, 12);
    EXPECT_EQ(locate(year, 8), alone(2));
    EXPECT_EQ(locate(year, 9.25), (TimeSample{2, 0, 0.25}));
    EXPECT_EQ(locate(year, 0.5), (TimeSample{2, 0, 0.9}));
    EXPECT_EQ(locate(year, 13), alone(0));
    EXPECT_EQ(locate(year, 14.5), (TimeSample{0, 1, 0.5}));
}

TEST(TimeAxis, TimesManyPeriodsAwayAreTheSameMoment) {
    const TimeAxis year = axis({366, 1096.485, 8401.335}, 8765.82);
    for (const double turns : {-1000.0, -3.0, -1.0, 1.0, 7.0, 1000.0}) {
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(locate(year, year.times[i] + turns * 8765.82), alone(i))
                << turns << " turns, key " << i;
        const TimeSample sample = locate(year, 731.2425 + turns * 8765.82);
        EXPECT_EQ(sample.frameA, 0u);
        EXPECT_EQ(sample.frameB, 1u);
        // The time itself is rounded to 2^-53 of 9e6 hours, which is 1e-12 of the 730 hours between.
        EXPECT_NEAR(sample.fraction, 0.5, 4e-12) << turns;
    }
}

TEST(TimeAxis, JustBeforeAPeriodEndsTheLastInterval) {
    const TimeAxis year = axis({0, 6}, 12);
    const TimeSample sample = locate(year, std::nextafter(12.0, 0.0));
    EXPECT_EQ(sample, (TimeSample{1, 0, (std::nextafter(12.0, 0.0) - 6) / 6}));
    EXPECT_EQ(locate(year, -1e-300), alone(0));
}

TEST(TimeAxis, FractionIsNeverOne) {
    // 1 - 2^-53 of an interval that starts at -1 rounds to the whole of it.
    const double justBelow = std::nextafter(1.0, 0.0);
    EXPECT_EQ(locate(axis({-1, 1, 3}), justBelow), alone(1));
    for (double a = 0.1; a < 20; a *= 1.7)
        for (double b = a * 1.3; b < 1e4; b *= 3.1) {
            const TimeSample sample = locate(axis({-a, b}), std::nextafter(b, 0.0));
            EXPECT_LT(sample.fraction, 1) << a << " " << b;
            EXPECT_EQ(sample.frameA == sample.frameB, sample.fraction == 0) << a << " " << b;
        }
}

TEST(TimeAxis, FractionGrowsWithTime) {
    const TimeAxis series = axis({-0.3, 0.1, 0.7}, 1.3);
    double previous = -1;
    for (int step = 0; step < 13000; ++step) {
        const TimeSample sample = locate(series, -0.3 + step * 1e-4);
        const double position = static_cast<double>(sample.frameA) + sample.fraction;
        ASSERT_GE(position, previous) << "step " << step;
        previous = position;
    }
}

TEST(TimeAxis, ExtremeTimesGiveNoNan) {
    constexpr double kMost = std::numeric_limits<double>::max();
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(locate(axis({-kMost, kMost}), 0), (TimeSample{0, 1, 0.5}));
    EXPECT_EQ(locate(axis({0, 2 * kLeast}), kLeast), (TimeSample{0, 1, 0.5}));
    EXPECT_EQ(locate(axis({0, 1e300}), kLeast), alone(0));
    for (const double time : {-kMost, -1e200, 1e200, kMost}) {
        const TimeSample sample = locate(axis({0, 1}, 3), time);
        EXPECT_GE(sample.fraction, 0);
        EXPECT_LT(sample.fraction, 1);
        EXPECT_LT(sample.frameA, 2u);
    }
}

}  // namespace

}  // namespace isoglass
