#include "render_fixture.h"

#include <algorithm>
#include <stdexcept>

namespace isoglass::test {
namespace {

using enum TransparencyMethod;

/// Plans against pictures: what a plan has is needed, what it leaves out is not.
class PlanImage : public RenderTest {
  protected:
    /// Three shells, two of which cut through each other, seen so that every pass shows somewhere.
    FrameDescription frameOf(TransparencyMethod method, bool reproducible, bool withOpaque, bool withShells,
                             bool keepLinear) {
        FrameDescription frame{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {48, 36}},
                               .background = {0.2f, 0.25f, 0.3f},
                               .method = method,
                               .layers = 3,
                               .reproducible = reproducible,
                               .keepLinear = keepLinear};
        if (withShells) {
            show(frame, {{sphere({0, 0, 0}, 0.9f, 12), {.color = {0.1f, 0.3f, 0.9f}, .opacity = 0.3f}},
                         {sphere({0.4f, 0, 0}, 0.7f, 12), {.color = {0.1f, 0.8f, 0.2f}, .opacity = 0.4f}}});
        }
        if (withOpaque) show(frame, {{sphere({0, 0.5f, 0}, 0.4f, 12), {.color = {0.8f, 0.1f, 0.1f}}}});
        return frame;
    }

    std::vector<FrameDescription> everyFrame() {
        std::vector<FrameDescription> frames{frameOf(automatic, false, true, false, false),
                                             frameOf(automatic, false, true, true, true)};
        for (const TransparencyMethod method : {twoPass, threePass, fourPass, peel, exact}) {
            for (const bool withOpaque : {false, true}) {
                frames.push_back(frameOf(method, withOpaque, withOpaque, true, false));
            }
        }
        frames.push_back(frameOf(threePass, false, true, true, false));
        return frames;
    }

    /// Another picture in every target first, so that nothing is right because it was there before.
    void spoil(const FrameDescription& frame) {
        FrameDescription other = frame;
        other.camera.eye = {-2, 3, 1};
        other.background = {0.9f, 0.8f, 0.1f};
        renderer_.render(other);
    }

    std::vector<Rgba8> pixelsWith(const FrameDescription& frame, const FramePlan& plan) {
        spoil(frame);
        renderer_.render(frame, plan);
        return renderer_.readSrgb().pixels;
    }
};

TEST_F(PlanImage, WithoutAnyPlannedPassThePictureIsAnotherOrRefused) {
    int changed = 0;
    int refused = 0;
    std::vector<FrameDescription> frames = everyFrame();
    frames.push_back(frameOf(automatic, false, true, true, false));
    frames.back().illustration.emplace();
    frames.back().draws.back().secondary = true;
    frames.push_back(frames.back());
    frames.back().keepLinear = true;
    for (const FrameDescription& frame : frames) {
        const FramePlan plan = renderer_.planOf(frame);
        const auto right = pixelsWith(frame, plan);
        for (std::size_t i = 0; i < plan.passes.size(); ++i) {
            FramePlan fewer = plan;
            fewer.passes.erase(fewer.passes.begin() + static_cast<std::ptrdiff_t>(i));
            try {
                EXPECT_NE(pixelsWith(frame, fewer), right)
                    << passLabel(plan.passes[i]) << " of " << static_cast<int>(plan.method);
                ++changed;
            } catch (const std::logic_error&) {
                ++refused;  // a later pass reads what nobody wrote: needed as well
            }
        }
    }
    EXPECT_GT(changed, 20);
    EXPECT_GT(refused, 0);
}

/// A left-out pass in front of those that compose, or of those that resolve, with what it reads from.
FramePlan withForced(FramePlan plan, PassKind kind) {
    std::vector<PlannedPass> forced{{kind, "forced"}};
    if (kind == PassKind::layerBlend) forced.insert(forced.begin(), {PassKind::peeledLayer, "forced"});
    if (kind == PassKind::presentation) forced.insert(forced.begin(), {PassKind::accumulation, "forced"});
    PassKind before = kind < PassKind::resolve ? PassKind::backFaceDepth : PassKind::fragmentLists;
    if (kind == PassKind::opaque) before = kind;
    const auto place =
        std::ranges::find_if(plan.passes, [before](const PlannedPass& pass) { return pass.kind > before; });
    plan.passes.insert(place, forced.begin(), forced.end());
    return plan;
}

/// Those need what a frame without the style has not.
bool isOfAStyle(PassKind kind) {
    using enum PassKind;
    return kind == layers || kind == shadedVolume || kind == firstSurface || kind == secondSurface ||
           kind == secondaryGeometry || kind == illustration;
}

TEST_F(PlanImage, WithALeftOutPassThePictureIsTheSame) {
    int forced = 0;
    for (const FrameDescription& frame : everyFrame()) {
        const FramePlan plan = renderer_.planOf(frame);
        const auto right = pixelsWith(frame, plan);
        for (const PlannedPass& left : plan.leftOut) {
            if (isOfAStyle(left.kind)) continue;
            EXPECT_EQ(pixelsWith(frame, withForced(plan, left.kind)), right)
                << passLabel(left) << " in " << static_cast<int>(plan.method);
            ++forced;
        }
    }
    EXPECT_GT(forced, 80);
}

/// A flat sheet is drawn in 2 passes because the 4-pass picture is the very same.
TEST_F(PlanImage, WhereNothingCanOverlapTwoPassesGiveTheBitsOfFour) {
    FrameDescription frame{.camera = {.eye = {1, 2, 2.5}, .size = {48, 36}},
                           .background = {0.2f, 0.3f, 0.4f}};
    show(frame, {{quad(0, 1), {.color = {0.9f, 0.3f, 0.1f}, .opacity = 0.4f}}});
    const LinearImage automaticImage = renderLinear(frame);
    EXPECT_EQ(renderer_.plan().method, twoPass);
    frame.method = fourPass;
    EXPECT_EQ(renderLinear(frame).pixels, automaticImage.pixels);
}

}  // namespace
}  // namespace isoglass::test
