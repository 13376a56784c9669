#include "scene/scene.h"

#include "scene/color.h"
#include "scene/iso_date.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>

namespace isoglass {
namespace {

TEST(Timeline, StillHasOneFrameAtTheStart) {
    const Timeline still;
    EXPECT_EQ(still.frameCount(), 1);
    EXPECT_EQ(still.position(0), 0);
}

TEST(Timeline, FramesAreEvenAndTheLastIsOneStepBeforeTheEnd) {
    Timeline time;
    time.duration = 4;
    time.fps = 25;
    ASSERT_EQ(time.frameCount(), 100);
    EXPECT_EQ(time.position(0), 0);
    EXPECT_EQ(time.position(50), 0.5);
    EXPECT_EQ(time.position(99), 99.0 / 100.0);
}

TEST(Timeline, FrameCountIsRoundedToTheNearest) {
    Timeline time;
    time.fps = 30;
    time.duration = 0.1;  // 0.1 * 30 is above 3 in double precision
    EXPECT_EQ(time.frameCount(), 3);
    time.duration = 0.12;  // 3.6
    EXPECT_EQ(time.frameCount(), 4);
    time.duration = 0.001;
    EXPECT_EQ(time.frameCount(), 1);
}

TEST(Placement, ScalesThenRotatesThenTranslates) {
    const Placement place{.translate = {10, 20, 30}, .rotate = {0, 0, 2, 90}, .scale = {2, 3, 4}};
    const glm::dvec3 world(worldFromSeries(place) * glm::dvec4(1, 1, 1, 1));
    // (2,3,4) turned by 90 degrees about z is (-3,2,4). Rounding: a few operations on numbers below 64.
    EXPECT_LT(glm::length(world - glm::dvec3(7, 22, 34)), 8 * 64 * 2.3e-16);
}

TEST(Placement, WithoutRotationIsExactAndNeedsNoAxis) {
    const Placement place{.translate = {500000.25, -3, 0}, .rotate = {0, 0, 0, 0}, .scale = {1, 1, -0.5}};
    EXPECT_EQ(worldFromSeries(place) * glm::dvec4(1, 2, 3, 1), glm::dvec4(500001.25, -1, -1.5, 1));
}

TEST(Color, EndsOfTheCurveAreExact) {
    EXPECT_EQ(linearFromHex("#000000"), LinearColor(0));
    EXPECT_EQ(linearFromHex("#ffffff"), LinearColor(1));
}

TEST(Color, BothPiecesOfTheCurveAreUsed) {
    const auto color = linearFromHex("#0A0Bff");
    ASSERT_TRUE(color);
    EXPECT_FLOAT_EQ(color->x, 10 / 255.0f / 12.92f);  // 10/255 = 0.0392 is below the knee at 0.04045
    EXPECT_FLOAT_EQ(color->y, std::pow((11 / 255.0f + 0.055f) / 1.055f, 2.4f));
}

TEST(Color, EveryByteSurvivesTheRoundTrip) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    for (int value = 0; value < 256; ++value) {
        const std::string byte{kDigits[value / 16], kDigits[value % 16]};
        const std::string hex = "#" + byte + "00" + byte;
        ASSERT_TRUE(linearFromHex(hex)) << hex;
        EXPECT_EQ(hexFromLinear(*linearFromHex(hex)), hex);
    }
}

TEST(Color, OtherTextsAreNoColors) {
    for (const char* text :
         {"", "#fff", "e04030", "#e0403", "#e040300", "#e0403g", "#-10000", "red", "#+10000"}) {
        EXPECT_FALSE(linearFromHex(text)) << text;
    }
}

TEST(Color, DefaultsAreTheHexCodesThatTheirCommentsSay) {
    EXPECT_EQ(linearFromHex("#e7e7e7"), Surface{}.color);
    EXPECT_EQ(linearFromHex("#101418"), ImageSettings{}.background);
}

TEST(IsoDate, DatesAreRecognised) {
    for (const char* text : {"0000-01-01", "2024-02-30", "1999-12-31T23:59", "2001-09-09T01:46:40"}) {
        EXPECT_TRUE(isIsoDate(text)) << text;
    }
}

TEST(IsoDate, OtherTextsAreNot) {
    for (const char* text :
         {"", "2024", "2024-1-1", "2024-00-10", "2024-13-01", "2024-01-00", "2024-01-32", "2024-01-01T",
          "2024-01-01T24:00", "2024-01-01T10:60", "2024-01-01T10:00:60", "2024-01-01 10:00", "2024/01/01",
          "2024-01-01T10:00:00Z", "20x4-01-01", "-024-01-01"}) {
        EXPECT_FALSE(isIsoDate(text)) << text;
    }
}

}  // namespace
}  // namespace isoglass
