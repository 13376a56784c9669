#include "plan/frame_plan.h"

#include <gtest/gtest.h>

#include <set>

namespace isoglass {
namespace {

using enum PassKind;

constexpr TransparencyMethod kAutomatic = TransparencyMethod::automatic;
constexpr TransparencyMethod kThreePass = TransparencyMethod::threePass;
constexpr TransparencyMethod kFourPass = TransparencyMethod::fourPass;

struct Row {
    PlanInput input;
    std::vector<PassKind> passes;
    TransparencyMethod method;
};

const Row kTable[] = {
    {{0, 0, kAutomatic}, {opaque, resolve}, kFourPass},
    {{3, 0, kAutomatic}, {opaque, resolve}, kFourPass},
    {{3, 0, kThreePass}, {opaque, resolve}, kThreePass},
    {{3, 0, kFourPass}, {opaque, resolve}, kFourPass},
    {{3, 0, kThreePass, true}, {opaque, resolve}, kThreePass},
    {{0, 1, kAutomatic}, {opaque, attenuation, backFaceDepth, emission, resolve}, kFourPass},
    {{2, 1, kAutomatic}, {opaque, attenuation, backFaceDepth, emission, resolve}, kFourPass},
    {{2, 5, kFourPass}, {opaque, attenuation, backFaceDepth, emission, resolve}, kFourPass},
    {{2, 5, kFourPass, true}, {opaque, attenuation, backFaceDepth, emission, resolve}, kFourPass},
    {{0, 1, kThreePass}, {opaque, attenuationAndEmission, resolve}, kThreePass},
    {{2, 5, kThreePass}, {opaque, attenuationAndEmission, resolve}, kThreePass},
    {{2, 5, kThreePass, true}, {opaque, attenuation, emission, resolve}, kThreePass},
};

std::vector<PassKind> kinds(const std::vector<PlannedPass>& passes) {
    std::vector<PassKind> result;
    for (const PlannedPass& pass : passes) result.push_back(pass.kind);
    return result;
}

std::string print(const PlanInput& input) {
    return std::to_string(input.opaqueSurfaces) + " opaque, " +
           std::to_string(input.semiTransparentSurfaces) + " semi-transparent, method " +
           std::to_string(static_cast<int>(input.method)) + (input.separatePasses ? ", separate" : "");
}

TEST(FramePlan, PassesAreThoseOfTheTable) {
    for (const Row& row : kTable) {
        SCOPED_TRACE(print(row.input));
        const FramePlan plan = planFrame(row.input);
        EXPECT_EQ(kinds(plan.passes), row.passes);
        EXPECT_EQ(plan.method, row.method);
    }
}

TEST(FramePlan, EveryKindIsEitherPlannedOrLeftOutOnceWithAReason) {
    for (const Row& row : kTable) {
        SCOPED_TRACE(print(row.input));
        const FramePlan plan = planFrame(row.input);
        std::multiset<PassKind> seen;
        for (const auto* list : {&plan.passes, &plan.leftOut}) {
            for (const PlannedPass& pass : *list) {
                seen.insert(pass.kind);
                EXPECT_FALSE(pass.reason.empty()) << passName(pass.kind);
            }
        }
        const std::multiset<PassKind> everyKind{opaque,        attenuation, emission, attenuationAndEmission,
                                                backFaceDepth, resolve};
        EXPECT_EQ(seen, everyKind);
    }
}

TEST(FramePlan, RunsAgreesWithTheList) {
    const FramePlan plan = planFrame({1, 1, kThreePass});
    EXPECT_TRUE(plan.runs(attenuationAndEmission));
    EXPECT_FALSE(plan.runs(backFaceDepth));
}

TEST(FramePlan, TheOpaquePassSaysWhenItOnlyGivesTheBackground) {
    EXPECT_NE(planFrame({0, 1}).passes.front().reason, planFrame({1, 1}).passes.front().reason);
}

TEST(FramePlan, PassNamesAreDistinct) {
    std::set<std::string_view> names;
    for (const PassKind kind :
         {opaque, attenuation, emission, attenuationAndEmission, backFaceDepth, resolve}) {
        names.insert(passName(kind));
    }
    EXPECT_EQ(names.size(), 6u);
    EXPECT_FALSE(names.contains(""));
}

}  // namespace
}  // namespace isoglass
