#include "plan/work_plan.h"

#include <gtest/gtest.h>

namespace isoglass {
namespace {

/// What is done for a volume: first key frame, second key frame, the surfaces, dense samples.
std::vector<bool> neededFor(bool onKeyFrame, bool clippedAway, std::vector<float> opacities) {
    VolumeState volume;
    volume.onKeyFrame = onKeyFrame;
    volume.clippedAway = clippedAway;
    volume.surfaceOpacities = std::move(opacities);
    const std::vector<PlannedWork> plan = planVolume(volume);
    std::vector<bool> needed;
    for (const PlannedWork& work : plan) {
        needed.push_back(work.needed);
        EXPECT_FALSE(work.reason.empty());
        EXPECT_EQ(isNeeded(plan, work.kind, work.surface), work.needed);
    }
    return needed;
}

TEST(WorkPlan, DoesWhatIsNeededAndNoMore) {
    using Bits = std::vector<bool>;
    EXPECT_EQ(neededFor(false, false, {1}), (Bits{true, true, true, false}));
    EXPECT_EQ(neededFor(false, false, {0.5f, 1, 0}), (Bits{true, true, true, true, false, false}));
    EXPECT_EQ(neededFor(true, false, {1, 0.5f}), (Bits{true, false, true, true, false}));
    EXPECT_EQ(neededFor(false, false, {0, -1}), (Bits{false, false, false, false, false}));
    EXPECT_EQ(neededFor(true, false, {0}), (Bits{false, false, false, false}));
    EXPECT_EQ(neededFor(false, true, {1, 1}), (Bits{false, false, false, false, false}));
    EXPECT_EQ(neededFor(false, false, {}), (Bits{false, false, false}));
}

std::string reasonOf(std::size_t item, bool onKeyFrame, bool clippedAway, float opacity) {
    VolumeState volume;
    volume.onKeyFrame = onKeyFrame;
    volume.clippedAway = clippedAway;
    volume.surfaceOpacities.push_back(opacity);
    return planVolume(volume).at(item).reason;
}

TEST(WorkPlan, LayersNeedSamplesInPlaceOfTheFirstSurface) {
    VolumeState volume;
    volume.surfaceOpacities = {0, 0.5f};
    volume.layered = true;
    std::vector<PlannedWork> plan = planVolume(volume);
    EXPECT_TRUE(isNeeded(plan, WorkKind::secondKeyFrame));
    EXPECT_TRUE(isNeeded(plan, WorkKind::samples));
    EXPECT_FALSE(isNeeded(plan, WorkKind::extraction, 0));
    EXPECT_TRUE(isNeeded(plan, WorkKind::extraction, 1));
    EXPECT_EQ(plan.at(2).reason, "its layers are found in the samples");
    volume.clippedAway = true;
    plan = planVolume(volume);
    EXPECT_FALSE(isNeeded(plan, WorkKind::samples));
    EXPECT_FALSE(isNeeded(plan, WorkKind::firstKeyFrame));
}

TEST(WorkPlan, ReasonsTellTheCauses) {
    EXPECT_EQ(reasonOf(1, true, false, 1), "the time is that of a key frame");
    EXPECT_EQ(reasonOf(2, false, true, 1), "a clip plane takes the whole volume away");
    EXPECT_EQ(reasonOf(2, false, false, 0), "its opacity is 0");
}

}  // namespace
}  // namespace isoglass
