#include "app/view/playhead.h"

#include <gtest/gtest.h>

#include <cmath>

namespace isoglass {
namespace {

/// 100 displayed frames, 25 a second.
constexpr double kFps = 25;
const Timeline kFourSeconds{.from = 0.0, .to = 10.0, .duration = 4, .fps = kFps};

TEST(Playhead, BeginsPausedAtTheBeginning) {
    const Playhead head(kFourSeconds);
    EXPECT_FALSE(head.playing());
    EXPECT_EQ(head.position(123), 0);
    EXPECT_TRUE(std::isinf(head.secondsToNextFrame(123)));
}

TEST(Playhead, FollowsTheClockFromFrameToFrame) {
    Playhead head(kFourSeconds);
    head.play(100);
    for (int frame = 0; frame < 100; ++frame) {
        const double begin = 100 + frame / kFps;
        EXPECT_EQ(head.position(begin), frame / 100.0) << frame;
        EXPECT_EQ(head.position(begin + 0.9 / kFps), frame / 100.0) << frame;
    }
}

TEST(Playhead, RunsFromTheEndToTheBeginning) {
    Playhead head(kFourSeconds);
    head.play(0);
    EXPECT_EQ(head.position(3.99), 0.99);
    EXPECT_EQ(head.position(4.01), 0);
    EXPECT_EQ(head.position(9.01), 0.25);
}

TEST(Playhead, RunsBackwardsFromTheBeginningToTheEnd) {
    Playhead head(kFourSeconds);
    head.moveTo(0.5);
    head.play(100, false);
    EXPECT_TRUE(head.playing());
    EXPECT_FALSE(head.forwards());
    for (int frame = 0; frame < 100; ++frame) {
        const double begin = 100 + frame / kFps;
        const double wanted = ((150 - frame) % 100) / 100.0;
        EXPECT_EQ(head.position(begin), wanted) << frame;
        EXPECT_EQ(head.position(begin + 0.9 / kFps), wanted) << frame;
        // Sums of times near 100 s are off by less than 1e-13 s.
        EXPECT_NEAR(head.secondsToNextFrame(begin + 0.3 / kFps), 0.7 / kFps, 1e-12) << frame;
    }
}

TEST(Playhead, BackwardsFromTheEndBeginsWithTheLastFrame) {
    Playhead head(kFourSeconds);
    head.moveTo(1);
    head.play(10, false);
    EXPECT_EQ(head.position(10), 0.99);
    EXPECT_EQ(head.position(10.041), 0.98);
}

TEST(Playhead, TurnsRoundWhereItIs) {
    Playhead head(kFourSeconds);
    head.play(0);
    head.play(1.01, false);
    EXPECT_EQ(head.position(1.01), 0.25);
    EXPECT_EQ(head.position(2.021), 0);
    head.play(1.61, true);
    EXPECT_EQ(head.position(1.61), 0.1);
    EXPECT_EQ(head.position(1.651), 0.11);
}

TEST(Playhead, ALateClockSkipsFrames) {
    Playhead head(kFourSeconds);
    head.play(0);
    EXPECT_EQ(head.position(0.001), 0);
    EXPECT_EQ(head.position(2.001), 0.5);
}

TEST(Playhead, PauseStaysAndPlayGoesOnFromThere) {
    Playhead head(kFourSeconds);
    head.play(0);
    head.pause(1.01);
    EXPECT_EQ(head.position(1.01), 0.25);
    EXPECT_EQ(head.position(50), 0.25);
    head.play(60);
    EXPECT_EQ(head.position(60), 0.25);
    EXPECT_EQ(head.position(61.001), 0.5);
}

TEST(Playhead, PlayTwiceIsPlayOnce) {
    Playhead head(kFourSeconds);
    head.play(0);
    head.play(1);
    EXPECT_EQ(head.position(1.001), 0.25);
}

TEST(Playhead, MoveToIsExactAndPauses) {
    Playhead head(kFourSeconds);
    head.play(0);
    head.moveTo(1.0 / 3);
    EXPECT_FALSE(head.playing());
    EXPECT_EQ(head.position(9), 1.0 / 3);
    head.moveTo(1);
    EXPECT_EQ(head.position(9), 1);
    head.play(10);
    EXPECT_EQ(head.position(10), 0) << "the end runs on at the beginning";
}

TEST(Playhead, AStepTellsWhichWayItGoes) {
    Playhead head(kFourSeconds);
    head.moveTo(0.5, false);
    EXPECT_FALSE(head.forwards());
    head.moveTo(0.25);
    EXPECT_FALSE(head.forwards());
    head.moveTo(0.5, true);
    EXPECT_TRUE(head.forwards());
}

TEST(Playhead, SaysWhenTheNextFrameIsDue) {
    Playhead head(kFourSeconds);
    head.play(0);
    // Sums of times below 10 s are off by less than 1e-14 s.
    EXPECT_NEAR(head.secondsToNextFrame(1.01), 0.03, 1e-13);
    for (double now = 0; now < 9; now += 0.013) {
        const double next = now + head.secondsToNextFrame(now);
        EXPECT_GT(next, now);
        EXPECT_NE(head.position(next), head.position(now)) << now;
        EXPECT_EQ(head.position(next - 0.001 / kFps), head.position(now)) << now;
    }
}

TEST(Playhead, AStillDoesNotPlay) {
    Playhead head(Timeline{});
    EXPECT_FALSE(head.canPlay());
    head.play(0);
    EXPECT_FALSE(head.playing());
}

TEST(Playhead, FramesOnGoesAroundBothEnds) {
    Playhead head(kFourSeconds);
    EXPECT_EQ(head.framesOn(0, 1), 0.01);
    EXPECT_EQ(head.framesOn(0, -1), 0.99);
    head.moveTo(0.99);
    EXPECT_EQ(head.framesOn(0, 1), 0);
}

TEST(NextKeyPosition, GoesFromKeyToKeyAndAround) {
    const std::vector<double> keys{0, 0.25, 0.7, 1};
    EXPECT_EQ(nextKeyPosition(keys, 0, true), 0.25);
    EXPECT_EQ(nextKeyPosition(keys, 0.3, true), 0.7);
    EXPECT_EQ(nextKeyPosition(keys, 0.3, false), 0.25);
    EXPECT_EQ(nextKeyPosition(keys, 1, true), 0);
    EXPECT_EQ(nextKeyPosition(keys, 0, false), 1);
}

TEST(NextKeyPosition, RoundingDoesNotStopAtTheSameKey) {
    const std::vector<double> keys{0, 0.25, 0.7};
    EXPECT_EQ(nextKeyPosition(keys, 0.25 - 1e-12, true), 0.7);
    EXPECT_EQ(nextKeyPosition(keys, 0.25 + 1e-12, false), 0);
}

TEST(NextKeyPosition, WithoutKeysNothingMoves) {
    EXPECT_EQ(nextKeyPosition({}, 0.4, true), 0.4);
}

}  // namespace
}  // namespace isoglass
