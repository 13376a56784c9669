#include "scene/color_map.h"

#include "scene/color.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace isoglass {
namespace {

TEST(ColorMaps, AreWholeAndHaveNamesOfTheirOwn) {
    std::set<std::string_view> names;
    for (const ColorMapTable& table : kColorMapTables) {
        EXPECT_EQ(table.digits.size(), 6 * kColorMapSize) << table.name;
        EXPECT_TRUE(names.insert(table.name).second) << table.name;
    }
    EXPECT_EQ(kColorMapTables[0].name, "viridis");
}

TEST(ColorMaps, HaveTheEndsThatTheirAuthorsPublished) {
    const auto ends = [](std::size_t map) {
        const auto colors = colorMap(map);
        return hexFromLinear(colors.front()) + hexFromLinear(colors.back());
    };
    EXPECT_EQ(ends(0), "#440154#fde725");  // viridis
    EXPECT_EQ(ends(1), "#000000#ffffff");  // grey, 0 to 100 % lightness
    EXPECT_EQ(ends(2), "#000000#ffffff");  // fire, 0 to 100 %
}

/// CIE 1976 lightness of a linear sRGB colour.
double lightness(const LinearColor& c) {
    const double y = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
}

/// What makes the sequential maps perceptually uniform: equal steps of the value are equal steps of
/// lightness.
TEST(ColorMaps, SequentialOnesRiseEvenlyInLightness) {
    for (const std::size_t map : {0u, 1u, 2u, 3u}) {
        const auto colors = colorMap(map);
        const double first = lightness(colors.front());
        const double span = lightness(colors.back()) - first;
        EXPECT_GT(span, 70) << kColorMapTables[map].name;
        for (std::size_t i = 0; i < kColorMapSize; ++i) {
            // viridis is even in another space (CAM02-UCS) and off by up to 4 of 76 here; 8-bit colours
            // round by less than 1.
            EXPECT_NEAR(lightness(colors[i]), first + span * i / (kColorMapSize - 1.0), 5)
                << kColorMapTables[map].name << " " << i;
        }
    }
}

TEST(ColorMaps, AreLinearBetweenTheirColoursAndStillOutside) {
    const auto colors = colorMap(0);
    EXPECT_EQ(colorAt(colors, -3), colors.front());
    EXPECT_EQ(colorAt(colors, 0), colors.front());
    EXPECT_EQ(colorAt(colors, 1), colors.back());
    EXPECT_EQ(colorAt(colors, 9), colors.back());
    const LinearColor between = colorAt(colors, 100.25 / 255);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(between[k], colors[100][k] + 0.25f * (colors[101][k] - colors[100][k]), 1e-7);
}

}  // namespace
}  // namespace isoglass
