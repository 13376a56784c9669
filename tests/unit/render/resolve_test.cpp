#include "render_fixture.h"

namespace isoglass::test {
namespace {

using Resolve = RenderTest;

TEST_F(Resolve, AnEmptyFrameIsTheBackgroundExactly) {
    const glm::vec3 background(0.1f, 0.7f, 3.3f);
    for (const int samples : {1, 4}) {
        const LinearImage image =
            renderLinear({.camera = fromAbove(1, {5, 3}), .background = background, .samples = samples});
        ASSERT_EQ(image.size, glm::ivec2(5, 3));
        EXPECT_EQ(image.pixels, std::vector<glm::vec3>(15, background));
    }
    EXPECT_EQ(renderer_.plan().passes.size(), 2u);
    EXPECT_FALSE(renderer_.plan().runs(PassKind::opaque));
}

double srgbCurve(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Half a step is rounding to 8 bits; 0.02 of a step is the 2^-14 that software renderers leave of a power.
constexpr double kHalfStep = 0.5 + 0.02;

TEST_F(Resolve, ExposureAndTheSrgbCurveAreWithinHalfAStep) {
    for (const float exposure : {1.0f, 0.5f, 4.0f}) {
        for (int i = 0; i <= 300; ++i) {
            // Dense near black, where the curve changes its form; beyond 1 it is clamped.
            const float value = 1.1f * std::pow(static_cast<float>(i) / 300, 3.0f);
            const glm::vec3 color(value, 0.5f * value, 0.001f * value);
            renderer_.render({.camera = fromAbove(1, {1, 1}), .background = color, .exposure = exposure});
            const Rgba8 pixel = renderer_.readSrgb().at(0, 0);
            ASSERT_NEAR(pixel.r, 255 * srgbCurve(double(exposure) * color.r), kHalfStep) << value;
            ASSERT_NEAR(pixel.g, 255 * srgbCurve(double(exposure) * color.g), kHalfStep) << value;
            ASSERT_NEAR(pixel.b, 255 * srgbCurve(double(exposure) * color.b), kHalfStep) << value;
            ASSERT_EQ(pixel.a, 255);
        }
    }
}

TEST_F(Resolve, ExposureLeavesTheLinearImage) {
    const LinearImage image =
        renderLinear({.camera = fromAbove(1, {1, 1}), .background = {0.25f, 0.5f, 1}, .exposure = 7});
    EXPECT_EQ(image.at(0, 0), glm::vec3(0.25f, 0.5f, 1));
}

TEST_F(Resolve, RowZeroIsOnTop) {
    FrameDescription frame{.camera = fromAbove(10, {8, 8}), .lighting = kUnlit};
    SurfaceMesh upperRight = quad(0, 8);
    for (glm::vec3& position : upperRight.positions) position += glm::vec3(8, 8, 0);
    show(frame, {{upperRight, {.color = {1, 1, 1}}}});
    const LinearImage image = renderLinear(frame);
    EXPECT_EQ(image.at(7, 0).r, 1);
    EXPECT_EQ(image.at(0, 0).r, 0);
    EXPECT_EQ(image.at(7, 7).r, 0);
    EXPECT_EQ(renderer_.readSrgb().at(7, 0), (Rgba8{255, 255, 255, 255}));
    EXPECT_GT(renderer_.readDepth().at(7, 0), 0);
    EXPECT_EQ(renderer_.readDepth().at(7, 7), 0);
}

/// The average of four samples at positions of a twice as large image: the same samples, one by one.
TEST_F(Resolve, SupersamplingAveragesInLinearLight) {
    FrameDescription frame{.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {24, 18}},
                           .background = {0.2f, 0.25f, 0.3f}};
    show(frame, {{sphere({0, 0, 0}, 0.8f, 12), {.color = {0.9f, 0.2f, 0.1f}, .opacity = 0.4f}},
                 {sphere({0.3f, 0, 0}, 0.5f, 12), {.color = {0.1f, 0.9f, 0.1f}}}});
    frame.samples = 4;
    const LinearImage averaged = renderLinear(frame);
    const DepthImage depth = renderer_.readDepth();
    EXPECT_EQ(depth.size, glm::ivec2(48, 36));
    frame.samples = 1;
    frame.camera.size *= 2;
    const LinearImage samples = renderLinear(frame);
    for (int y = 0; y < 18; ++y) {
        for (int x = 0; x < 24; ++x) {
            const glm::dvec3 sum =
                glm::dvec3(samples.at(2 * x, 2 * y)) + glm::dvec3(samples.at(2 * x + 1, 2 * y)) +
                glm::dvec3(samples.at(2 * x, 2 * y + 1)) + glm::dvec3(samples.at(2 * x + 1, 2 * y + 1));
            // Three float additions of values below 4.
            ASSERT_LT(largestDifference(averaged.at(x, y), sum * 0.25), 3 * 4 * 0x1p-24);
        }
    }
}

}  // namespace
}  // namespace isoglass::test
