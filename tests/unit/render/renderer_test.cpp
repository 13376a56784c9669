#include "render/renderer.h"

#include "base/error.h"
#include "render_fixture.h"

#include <epoxy/gl.h>

#include <stdexcept>

namespace isoglass::test {
namespace {

class RendererTest : public RenderTest {
  protected:
    FrameDescription frame_{.camera = fromAbove(10)};

    void SetUp() override {
        show(frame_,
             {{quad(0, 1), {.color = {1, 0, 0}}}, {quad(1, 1), {.color = {0, 1, 0}, .opacity = 0.5f}}});
    }
};

TEST_F(RendererTest, SaysWhichPassesRan) {
    renderer_.render(frame_);
    EXPECT_EQ(renderer_.plan().method, TransparencyMethod::twoPass)
        << "the only semi-transparent one is flat";
    EXPECT_EQ(renderer_.plan().passes.size(), 4u);
}

TEST_F(RendererTest, TimesEachPassOnRequestAndSaysHow) {
    renderer_.render(frame_);
    EXPECT_TRUE(renderer_.timings().empty());
    renderer_.setTiming(true);
    renderer_.render(frame_);
    ASSERT_EQ(renderer_.timings().size(), 4u);
    const auto how = context_.isSoftware() ? PassTiming::How::serialWallClock : PassTiming::How::gpuTimer;
    for (std::size_t i = 0; i < 4; ++i) {
        const PassTiming& timing = renderer_.timings()[i];
        EXPECT_EQ(timing.label, passLabel(renderer_.plan().passes[i]));
        EXPECT_EQ(timing.how, how);
        EXPECT_TRUE(std::isfinite(timing.milliseconds) && timing.milliseconds >= 0);
    }
    renderer_.setTiming(false);
    renderer_.render(frame_);
    EXPECT_TRUE(renderer_.timings().empty());
}

TEST_F(RendererTest, TheSameFrameGivesTheSamePixels) {
    const LinearImage first = renderLinear(frame_);
    FrameDescription other = frame_;
    other.camera = {.eye = {5, 4, 3}, .size = {50, 20}};
    other.method = TransparencyMethod::threePass;
    renderer_.render(other);
    EXPECT_EQ(renderLinear(frame_).pixels, first.pixels);
}

TEST_F(RendererTest, AFrameThatIsShownAlreadyIsNotDrawnAgain) {
    EXPECT_TRUE(renderer_.renderIfChanged(frame_));
    EXPECT_FALSE(renderer_.renderIfChanged(frame_));
    EXPECT_TRUE(renderer_.plan().passes.empty());
    FrameDescription other = frame_;
    other.camera.eye.z += 1e-9;
    EXPECT_TRUE(renderer_.renderIfChanged(other));
    EXPECT_FALSE(renderer_.plan().passes.empty());
    other.camera.size = {0, 0};
    EXPECT_THROW(renderer_.renderIfChanged(other), Error);
    EXPECT_TRUE(renderer_.renderIfChanged(frame_)) << "after a failure nothing is shown";
}

TEST_F(RendererTest, TheLinearImageIsReadWhereItWasKept) {
    frame_.keepLinear = false;
    renderer_.render(frame_);
    const Image image = renderer_.readSrgb();
    EXPECT_THROW(renderer_.readLinear(), std::logic_error);
    frame_.keepLinear = true;
    renderer_.render(frame_);
    EXPECT_NO_THROW(renderer_.readLinear());
    EXPECT_EQ(renderer_.readSrgb().pixels, image.pixels);
}

TEST_F(RendererTest, ReadingBeforeTheFirstFrameIsRefused) {
    EXPECT_THROW(renderer_.readLinear(), std::logic_error);
    EXPECT_THROW(renderer_.readSrgb(), std::logic_error);
    EXPECT_THROW(renderer_.readDepth(), std::logic_error);
}

TEST_F(RendererTest, SizesThatCannotBeDrawnAreErrors) {
    for (const glm::ivec2 size : {glm::ivec2(0, 10), glm::ivec2(10, -1), glm::ivec2(1 << 20, 10)}) {
        FrameDescription frame = frame_;
        frame.camera.size = size;
        EXPECT_THROW(renderer_.render(frame), Error) << size.x << "x" << size.y;
    }
    for (const int samples : {0, 65}) {
        FrameDescription frame = frame_;
        frame.samples = samples;
        EXPECT_THROW(renderer_.render(frame), Error) << samples;
    }
    for (const int layers : {0, 257}) {
        FrameDescription frame = frame_;
        frame.layers = layers;
        EXPECT_THROW(renderer_.render(frame), Error) << layers;
    }
    EXPECT_NO_THROW(renderer_.render(frame_));
}

TEST_F(RendererTest, AGlErrorBeforeTheFramesEndIsThrown) {
    glEnable(GL_COLOR_BUFFER_BIT);
    EXPECT_THROW(renderer_.render(frame_), Error);
    EXPECT_NO_THROW(renderer_.render(frame_));
}

}  // namespace
}  // namespace isoglass::test
