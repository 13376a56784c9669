#include "render_fixture.h"

#include <set>

namespace isoglass::test {
namespace {

using TransparentBackground = RenderTest;

constexpr std::array kMethods{TransparencyMethod::twoPass, TransparencyMethod::threePass,
                              TransparencyMethod::fourPass, TransparencyMethod::peel,
                              TransparencyMethod::exact};

/// An opaque sphere inside a semi-transparent one, before nothing.
std::vector<TruthSurface> nestedSpheres() {
    return {{sphere({0, 0, 0}, 0.8f, 12), {.color = {0.9f, 0.2f, 0.1f}, .opacity = 0.4f}},
            {sphere({0.3f, 0, 0}, 0.4f, 12), {.color = {0.1f, 0.9f, 0.1f}}}};
}

FrameDescription frameOfSpheres(int samples) {
    return {.camera = {.eye = {3, 2, 2.5}, .fovDegrees = 34, .size = {24, 18}}, .samples = samples};
}

TEST_F(TransparentBackground, AnEmptyFrameIsTheBackgroundWithItsAlpha) {
    FrameDescription frame{.camera = fromAbove(1, {1, 1}), .background = LinearColor(1)};
    for (const auto& [opacity, expected] :
         {std::pair(0.0f, Rgba8{0, 0, 0, 0}), std::pair(0.2f, Rgba8{255, 255, 255, 51})}) {
        frame.backgroundOpacity = opacity;
        renderer_.render(frame);
        EXPECT_EQ(renderer_.readSrgb().at(0, 0), expected);
    }
}

TEST_F(TransparentBackground, AnOpaqueSurfaceIsOpaqueAndOfTheSameColor) {
    FrameDescription frame{.camera = fromAbove(10), .lighting = kUnlit};
    show(frame, {{quad(0, 8), {.color = {0.5f, 0.25f, 0.125f}}}});
    renderer_.render(frame);
    const Rgba8 overBlack = renderer_.readSrgb().at(16, 16);
    frame.backgroundOpacity = 0;
    renderer_.render(frame);
    EXPECT_EQ(renderer_.readSrgb().at(16, 16), overBlack);
}

/// A surface of opacity 0.4 before nothing hides 0.4 of what the picture is laid upon, and shows its own
/// color: not one darkened by the black that transparent pixels hold.
TEST_F(TransparentBackground, ASemiTransparentSurfaceHasItsOpacityAndItsOwnColor) {
    FrameDescription frame{.camera = fromAbove(10), .lighting = kUnlit};
    show(frame, {{quad(0, 8), {.color = {1, 0.5f, 0}, .opacity = 0.4f}}});
    frame.backgroundOpacity = 0;
    for (const TransparencyMethod method : kMethods) {
        frame.method = method;
        renderer_.render(frame);
        const Rgba8 pixel = renderer_.readSrgb().at(16, 16);
        EXPECT_EQ(pixel.a, 102);
        EXPECT_EQ(pixel.r, 255);
        EXPECT_EQ(pixel.g, 188) << "0.5 by the sRGB curve";
        EXPECT_EQ(pixel.b, 0);
    }
}

/// Laying the picture upon a color gives what rendering before that color gives, edges included.
TEST_F(TransparentBackground, LaidUponAColorItIsThePictureBeforeThatColor) {
    const glm::vec3 behind(0.2f, 0.6f, 0.9f);
    for (const int samples : {1, 4}) {
        for (const TransparencyMethod method : kMethods) {
            FrameDescription frame = frameOfSpheres(samples);
            show(frame, nestedSpheres());
            frame.method = method;
            frame.background = behind;
            const LinearImage expected = renderLinear(frame);
            frame.background = LinearColor(0);
            frame.backgroundOpacity = 0;
            const LinearImage color = renderLinear(frame);
            const Image image = renderer_.readSrgb();
            std::set<int> alphas;
            for (std::size_t i = 0; i < color.pixels.size(); ++i) {
                alphas.insert(image.pixels[i].a);
                const float hidden = static_cast<float>(image.pixels[i].a) / 255;
                const glm::vec3 laid = color.pixels[i] + (1 - hidden) * behind;
                // Alpha is rounded to half a step of 255 and multiplies colors up to 0.9; the rest is
                // a few float roundings of values below 2.
                ASSERT_LE(largestDifference(laid, expected.pixels[i]), 0.9 * 0.5 / 255 + 8 * 0x1p-23);
            }
            // Beside the spheres, through the front and back of one of opacity 0.4, on the opaque one.
            EXPECT_TRUE(alphas.contains(0) && alphas.contains(163) && alphas.contains(255));
            EXPECT_EQ(alphas.size() > 4, samples == 4) << "edges cover parts of pixels";
        }
    }
}

/// The straight color of an edge pixel lies between those of the surfaces there: no dark fringe.
TEST_F(TransparentBackground, EdgesHaveNoDarkFringe) {
    FrameDescription frame = frameOfSpheres(4);
    frame.lighting = kUnlit;
    show(frame, {{sphere({0, 0, 0}, 0.8f, 24), {.color = {1, 1, 1}}}});
    frame.backgroundOpacity = 0;
    renderer_.render(frame);
    int partly = 0;
    for (const Rgba8 pixel : renderer_.readSrgb().pixels) {
        if (pixel.a == 0) continue;
        partly += pixel.a < 255;
        ASSERT_EQ(pixel.r, 255);
        ASSERT_EQ(pixel.g, 255);
        ASSERT_EQ(pixel.b, 255);
    }
    EXPECT_GT(partly, 10);
}

}  // namespace
}  // namespace isoglass::test
