#include "render_fixture.h"
#include "scene/color_map.h"
#include "support/image_compare.h"

#include <limits>

namespace isoglass::test {
namespace {

const glm::vec3 kBackground(0.2f, 0.25f, 0.3f);

class ColorByValue : public RenderTest {
  protected:
    FrameDescription frame_{
        .camera = fromAbove(10), .background = kBackground, .lighting = kUnlit, .overlays = {}};

    /// Values along x: -2 at the left edge of the image, which is 10 tan(15) units from its middle, to 2.
    LinearImage renderValues(std::vector<float> values, const LegendBar& bar) {
        SurfaceMesh mesh = quad(0, kHalf);
        mesh.colorValues = std::move(values);
        frame_.draws.clear();
        show(frame_, {{mesh, {.color = {1, 0, 0}, .colorBar = bar}}});
        return renderLinear(frame_);
    }

    static constexpr float kHalf = 10 * 0.267949192f;
};

TEST_F(ColorByValue, FollowsTheMap) {
    for (std::size_t map = 0; map < kColorMapCount; ++map) {
        const auto colors = colorMap(map);
        for (const LegendBar& bar : {LegendBar{map, -1, 1}, LegendBar{map, 2, -2}}) {
            const LinearImage image = renderValues({-2, 2, 2, -2}, bar);
            for (int x = 0; x < image.size.x; ++x) {
                const double value = -2 + 4 * (x + 0.5) / image.size.x;
                const LinearColor expected = colorAt(colors, (value - bar.low) / (bar.high - bar.low));
                // The place in the map carries a few roundings of 255 * 2^-24; colours change by less than
                // 0.1 from one to the next.
                ASSERT_LT(largestDifference(image.at(x, 16), expected), 1e-4) << map << " at " << x;
            }
        }
    }
}

TEST_F(ColorByValue, WhatHasNoValueIsGrey) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    for (const glm::vec3& pixel : renderValues({none, none, none, none}, {0, 0, 1}).pixels)
        ASSERT_EQ(pixel, glm::vec3(0.2f));
}

TEST_F(ColorByValue, IsLeftAloneWhereNothingAsksForIt) {
    SurfaceMesh mesh = quad(0, kHalf);
    mesh.colorValues = {0, 1, 2, 3};
    show(frame_, {{mesh, {.color = {1, 0.5f, 0.25f}}}});
    for (const glm::vec3& pixel : renderLinear(frame_).pixels) ASSERT_EQ(pixel, glm::vec3(1, 0.5f, 0.25f));
}

TEST_F(ColorByValue, IsUploadedOnlyWhereThereAreValues) {
    SurfaceMesh mesh = quad(0, 1);
    renderer_.meshes().upload(mesh);
    const std::size_t plain = renderer_.meshes().bytes();
    EXPECT_EQ(plain, mesh.bytes());
    mesh.colorValues = {0, 1, 2, 3};
    renderer_.meshes().upload(mesh);
    EXPECT_EQ(renderer_.meshes().bytes(), 2 * plain + 4 * sizeof(float));
}

TEST(Legend, TicksAreRoundAndFewEnough) {
    EXPECT_EQ(roundTicks(0, 1, 6), (std::vector<double>{0, 0.2, 0.4, 0.2 * 3, 0.8, 1}));
    EXPECT_EQ(roundTicks(-3, 28, 6), (std::vector<double>{0, 5, 10, 15, 20, 25}));
    EXPECT_EQ(roundTicks(28, -3, 4), (std::vector<double>{0, 10, 20}));
    for (const double span : {1e-9, 0.37, 4.0, 99.0, 1e12}) {
        for (const double low : {0.0, -0.3 * span, 7 * span}) {
            for (const int most : {2, 4, 6}) {
                const std::vector<double> ticks = roundTicks(low, low + span, most);
                EXPECT_LE(ticks.size(), static_cast<std::size_t>(most));
                for (const double tick : ticks) {
                    EXPECT_GE(tick, low - 1e-9 * span);
                    EXPECT_LE(tick, low + span * (1 + 1e-9));
                }
            }
        }
    }
}

TEST(Legend, IsLeftOutWhereItCannotBeRead) {
    EXPECT_TRUE(makeLegend({}, {640, 480}, {}).empty());
    EXPECT_TRUE(makeLegend({{0, 0, 1}}, {640, 100}, {}).empty());
    EXPECT_TRUE(makeLegend({{0, 0, 1}}, {60, 480}, {}).empty());
}

TEST(Legend, ShowsTheMapFromBottomToTopBesideItsNumbers) {
    for (const glm::ivec2 size : {glm::ivec2(320, 240), glm::ivec2(1280, 720)}) {
        const auto legend = makeLegend({{0, 0, 1}, {3, -5, 5}}, size, {0, 0, 0});
        ASSERT_EQ(legend.size(), 1u);
        const Image& image = legend[0].image;
        EXPECT_EQ(legend[0].at.x + image.size.x, size.x);
        EXPECT_GE(legend[0].at.y, 0);
        EXPECT_LE(legend[0].at.y + image.size.y, size.y);
        for (const Rgba8& pixel : image.pixels) EXPECT_EQ(pixel.a, 255);
        const int scale = size.y / 360 > 1 ? size.y / 360 : 1;
        const int height = size.y * 6 / 10;
        const auto colors = colorMap(0);
        for (int y = 0; y < height; ++y) {
            const auto shown = image.at(6 * scale, 8 * scale + y);
            const auto linear = linearOf({{1, 1}, {shown}}).pixels[0];
            // Half a step of 8 bits is at most 0.5 % of linear light.
            ASSERT_LT(largestDifference(linear, colorAt(colors, 1 - (y + 0.5) / height)), 5e-3) << y;
        }
    }
}

TEST_F(ColorByValue, ALegendCoversItsPartOfTheImageAndNothingElse) {
    frame_.camera.size = {240, 160};
    renderer_.render(frame_);
    const Image without = renderer_.readSrgb();
    const LinearImage linear = renderer_.readLinear();
    frame_.overlays = makeLegend({{0, 0, 1}}, frame_.camera.size, kBackground);
    ASSERT_EQ(frame_.overlays.size(), 1u);
    renderer_.render(frame_);
    const Image with = renderer_.readSrgb();
    EXPECT_EQ(renderer_.readLinear().pixels, linear.pixels);
    const Overlay& legend = frame_.overlays[0];
    for (int y = 0; y < 160; ++y) {
        for (int x = 0; x < 240; ++x) {
            const glm::ivec2 in = glm::ivec2(x, y) - legend.at;
            const bool covered =
                in.x >= 0 && in.y >= 0 && in.x < legend.image.size.x && in.y < legend.image.size.y;
            ASSERT_EQ(with.at(x, y), covered ? legend.image.at(in.x, in.y) : without.at(x, y));
        }
    }
}

}  // namespace
}  // namespace isoglass::test
