#include "plan/frame_plan.h"

#include <gtest/gtest.h>

#include <set>

namespace isoglass {
namespace {

using enum PassKind;
using enum TransparencyMethod;

struct Row {
    PlanInput input;
    std::vector<PassKind> passes;
    TransparencyMethod method;
    int supersample = 1;
    int subframes = 1;
};

// One scene a line: what it shows, and exactly the passes that draw it.
const Row kTable[] = {
    {{}, {resolve}, fourPass},
    {{.opaqueSurfaces = 3}, {opaque, resolve}, fourPass},
    {{.opaqueSurfaces = 3, .method = exact, .reproducible = true}, {opaque, resolve}, exact},
    {{.opaqueSurfaces = 3, .method = peel}, {opaque, resolve}, peel},
    {{.opaqueSurfaces = 1, .keepLinear = true}, {opaque, accumulation, presentation}, fourPass},
    {{.opaqueSurfaces = 1, .unchanged = true}, {}, fourPass},
    {{.semiTransparentSurfaces = 1}, {backFaceDepth, attenuationAndEmission, resolve}, fourPass},
    {{.opaqueSurfaces = 2, .semiTransparentSurfaces = 5},
     {opaque, backFaceDepth, attenuationAndEmission, resolve},
     fourPass},
    {{.opaqueSurfaces = 2, .semiTransparentSurfaces = 5, .reproducible = true},
     {opaque, backFaceDepth, integerSums, resolve},
     fourPass},
    {{.semiTransparentSurfaces = 1, .overlapImpossible = true}, {blending, resolve}, twoPass},
    {{.semiTransparentSurfaces = 1, .exactWanted = true, .overlapImpossible = true},
     {fragmentLists, resolve},
     exact},
    {{.semiTransparentSurfaces = 2, .method = twoPass}, {blending, resolve}, twoPass},
    {{.opaqueSurfaces = 1, .semiTransparentSurfaces = 2, .method = twoPass},
     {opaque, blending, resolve},
     twoPass},
    {{.semiTransparentSurfaces = 2, .method = threePass, .exactWanted = true},
     {attenuationAndEmission, resolve},
     threePass},
    {{.semiTransparentSurfaces = 2, .method = threePass, .reproducible = true},
     {integerSums, resolve},
     threePass},
    {{.semiTransparentSurfaces = 2, .method = fourPass},
     {backFaceDepth, attenuationAndEmission, resolve},
     fourPass},
    {{.semiTransparentSurfaces = 2, .method = peel, .layers = 2},
     {peeledLayer, layerBlend, peeledLayer, layerBlend, resolve},
     peel},
    {{.semiTransparentSurfaces = 2, .method = peel, .layers = 2, .reproducible = true},
     {fragmentLists, resolve},
     peel},
    {{.opaqueSurfaces = 1, .semiTransparentSurfaces = 2, .method = exact},
     {opaque, fragmentLists, resolve},
     exact},
    {{.shadedVolume = true}, {shadedVolume, resolve}, fourPass},
    {{.opaqueSurfaces = 1, .semiTransparentSurfaces = 1, .shadedVolume = true, .betweenKeyFrames = true},
     {opaque, shadedVolume, backFaceDepth, attenuationAndEmission, resolve},
     fourPass},
    {{.illustrative = true}, {illustration, resolve}, fourPass},
    {{.illustrative = true, .primarySurfaces = 2},
     {firstSurface, secondSurface, illustration, resolve},
     fourPass},
    {{.illustrative = true, .secondarySurfaces = 1}, {secondaryGeometry, illustration, resolve}, fourPass},
    {{.illustrative = true, .primarySurfaces = 1, .secondarySurfaces = 1, .keepLinear = true},
     {firstSurface, secondSurface, secondaryGeometry, illustration, accumulation, presentation},
     fourPass},
    {{.opaqueSurfaces = 1, .samples = 4}, {opaque, resolve}, fourPass, 2, 1},
    {{.opaqueSurfaces = 1, .samples = 3}, {opaque, accumulation, presentation}, fourPass, 1, 3},
    {{.semiTransparentSurfaces = 1, .method = exact, .samples = 64},
     {fragmentLists, accumulation, presentation},
     exact,
     2,
     16},
};

std::vector<PassKind> kinds(const std::vector<PlannedPass>& passes) {
    std::vector<PassKind> result;
    for (const PlannedPass& pass : passes) result.push_back(pass.kind);
    return result;
}

TEST(FramePlan, PassesAreThoseOfTheTable) {
    for (const Row& row : kTable) {
        SCOPED_TRACE("row " + std::to_string(&row - kTable));
        const FramePlan plan = planFrame(row.input);
        EXPECT_EQ(kinds(plan.passes), row.passes);
        EXPECT_EQ(plan.method, row.method);
        EXPECT_FALSE(plan.methodReason.empty());
        EXPECT_EQ(plan.supersample, row.supersample);
        EXPECT_EQ(plan.subframes, row.subframes);
    }
}

TEST(FramePlan, EveryKindIsPlannedOrLeftOutOnceWithAReason) {
    for (const Row& row : kTable) {
        SCOPED_TRACE("row " + std::to_string(&row - kTable));
        const FramePlan plan = planFrame(row.input);
        std::multiset<PassKind> leftOut;
        for (const PlannedPass& pass : plan.leftOut) leftOut.insert(pass.kind);
        for (int i = 0; i < kPassKindCount; ++i) {
            const auto kind = static_cast<PassKind>(i);
            EXPECT_EQ(leftOut.count(kind), plan.runs(kind) ? 0u : 1u) << passName(kind);
        }
        for (const auto* list : {&plan.passes, &plan.leftOut}) {
            for (const PlannedPass& pass : *list) EXPECT_FALSE(pass.reason.empty()) << passLabel(pass);
        }
    }
}

TEST(FramePlan, NothingChangedIsTheReasonForDrawingNothing) {
    const FramePlan plan = planFrame({.opaqueSurfaces = 1, .semiTransparentSurfaces = 1, .unchanged = true});
    for (const PlannedPass& pass : plan.leftOut) {
        EXPECT_EQ(pass.reason, "nothing has changed since the last frame");
    }
}

TEST(FramePlan, PassNamesAreDistinct) {
    std::set<std::string_view> names;
    for (int i = 0; i < kPassKindCount; ++i) names.insert(passName(static_cast<PassKind>(i)));
    EXPECT_EQ(names.size(), static_cast<std::size_t>(kPassKindCount));
    EXPECT_FALSE(names.contains(""));
}

TEST(FramePlan, LabelsNumberTheLayersFromOne) {
    const FramePlan plan = planFrame({.semiTransparentSurfaces = 1, .method = peel, .layers = 2});
    EXPECT_EQ(passLabel(plan.passes[0]), "peeled layer 1");
    EXPECT_EQ(passLabel(plan.passes[3]), "layer blend 2");
    EXPECT_EQ(passLabel(plan.passes[4]), "resolve");
}

}  // namespace
}  // namespace isoglass
