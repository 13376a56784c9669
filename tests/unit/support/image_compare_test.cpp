#include "support/image_compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace isoglass::test {
namespace {

/// A disc with a soft shade on a plain background: a silhouette, and smooth inside.
LinearImage disc(glm::dvec2 center) {
    LinearImage image{{64, 48}, {}};
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double r = std::hypot(x + 0.5 - center.x, y + 0.5 - center.y) / 16;
            image.pixels.emplace_back(r < 1 ? glm::vec3(0.9, 0.4, 0.1) * float(1 - 0.5 * r * r)
                                            : glm::vec3(0.2f));
        }
    }
    return image;
}

/// Pixels that a displacement of one pixel can bring across the disc's edge.
Raster<std::uint8_t> rim(glm::dvec2 center) {
    Raster<std::uint8_t> mask{{64, 48}, {}};
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            mask.pixels.push_back(std::abs(std::hypot(x + 0.5 - center.x, y + 0.5 - center.y) - 16) <= 1);
        }
    }
    return mask;
}

constexpr glm::dvec2 kCenter(32, 24);
/// What comparisons of the engine's pictures allow at most.
constexpr ImageLimits kLimits{.threshold = 1e-3, .mean = 1e-3, .changedShare = 0.02, .largest = 1e-3};

TEST(ImageCompare, EqualPicturesDoNotDiffer) {
    const ImageDifference d = compareImages(disc(kCenter), disc(kCenter));
    EXPECT_EQ(d.mean, 0);
    EXPECT_EQ(d.largest, 0);
    EXPECT_EQ(d.changed, 0u);
    EXPECT_EQ(d.pixels, 64u * 48u);
    EXPECT_EQ(differenceBeyond({}, "equal", disc(kCenter), disc(kCenter)), "");
}

TEST(ImageCompare, AShiftByOnePixelFailsEveryLimit) {
    const LinearImage shifted = disc(kCenter + glm::dvec2(1, 0));
    const ImageDifference d = compareImages(shifted, disc(kCenter), rim(kCenter), kLimits.threshold);
    EXPECT_GT(d.mean, kLimits.mean);
    EXPECT_GT(d.changedShare(), kLimits.changedShare);
    EXPECT_GT(d.largest, kLimits.largest) << "also inside, away from the rim";
    const std::string message = differenceBeyond(kLimits, "shifted", shifted, disc(kCenter), rim(kCenter));
    EXPECT_NE(message.find("shifted: mean"), std::string::npos) << message;
    EXPECT_NE(message.find("shifted-difference.png"), std::string::npos) << message;
}

TEST(ImageCompare, FindsTheOnePixelThatDiffers) {
    LinearImage image = disc(kCenter);
    image.at(40, 20).g += 0.25f;
    const ImageDifference d = compareImages(image, disc(kCenter));
    EXPECT_EQ(d.changed, 1u);
    EXPECT_EQ(d.largestAt, glm::ivec2(40, 20));
    EXPECT_NEAR(d.largest, 0.25, 1e-6);
    EXPECT_NEAR(d.mean, 0.25 / (64 * 48), 1e-9);
}

TEST(ImageCompare, MaskedPixelsCountAsChangedButNotForTheLargest) {
    LinearImage image = disc(kCenter);
    Raster<std::uint8_t> mask{image.size, std::vector<std::uint8_t>(image.pixels.size())};
    image.at(5, 7) = glm::vec3(1);
    mask.at(5, 7) = 1;
    const ImageDifference d = compareImages(image, disc(kCenter), mask);
    EXPECT_EQ(d.changed, 1u);
    EXPECT_EQ(d.masked, 1u);
    EXPECT_EQ(d.largest, 0);
    EXPECT_NE(differenceBeyond({.mean = 1, .largest = 1}, "masked", image, disc(kCenter), mask), "");
    EXPECT_EQ(
        differenceBeyond({.mean = 1, .changedShare = 1.0 / (64 * 48)}, "masked", image, disc(kCenter), mask),
        "");
}

TEST(ImageCompare, ANumberThatIsNoneIsAnInfiniteDifference) {
    LinearImage image = disc(kCenter);
    image.at(3, 4).b = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isinf(compareImages(image, disc(kCenter)).largest));
    EXPECT_TRUE(std::isinf(compareImages(disc(kCenter), image).largest));
}

TEST(ImageCompare, DifferentSizesAreAMistake) {
    EXPECT_THROW(compareImages(disc(kCenter), LinearImage{{64, 47}, std::vector<glm::vec3>(64 * 47)}),
                 std::invalid_argument);
}

TEST(ImageCompare, TheMapIsBlackWhereEqualAndWhiteWhereChanged) {
    LinearImage image = disc(kCenter);
    image.at(40, 20).g += 0.25f;
    Raster<std::uint8_t> mask{image.size, std::vector<std::uint8_t>(image.pixels.size())};
    mask.at(1, 1) = 1;
    const Image map = differenceMap(image, disc(kCenter), mask, 1e-3);
    EXPECT_EQ(map.at(40, 20), (Rgba8{255, 255, 255, 255}));
    EXPECT_EQ(map.at(39, 20), (Rgba8{0, 0, 0, 255}));
    EXPECT_EQ(map.at(1, 1), (Rgba8{0, 0, 255, 255}));
}

/// The sRGB curve by IEC 61966-2-1: 0.5 of the code range is 0.21404 of the light.
TEST(ImageCompare, BytesAreDecodedToLinearLight) {
    const LinearImage linear = linearOf({{3, 1}, {{0, 128, 255, 255}, {10, 10, 10, 0}, {11, 11, 11, 255}}});
    EXPECT_EQ(linear.pixels[0].r, 0);
    EXPECT_NEAR(linear.pixels[0].g, 0.2158605, 1e-6);
    EXPECT_EQ(linear.pixels[0].b, 1);
    EXPECT_NEAR(linear.pixels[1].r, 10 / 255.0 / 12.92, 1e-8);
    EXPECT_NEAR(linear.pixels[2].r, std::pow((11 / 255.0 + 0.055) / 1.055, 2.4), 1e-8);
}

}  // namespace
}  // namespace isoglass::test
