#pragma once

#include "render/image.h"
#include "scene/scene.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace isoglass {

/// A picture that covers a part of the image, exactly as it is; `at` is its upper left corner in pixels.
struct Overlay {
    Image image;
    glm::ivec2 at{0};

    friend bool operator==(const Overlay&, const Overlay&) = default;
};

/// One colour bar of a legend: the map's colours from `low` at the bottom to `high` on top.
struct LegendBar {
    std::size_t map = 0;
    double low = 0;
    double high = 1;

    friend bool operator==(const LegendBar&, const LegendBar&) = default;
};

/// Colour bars side by side with numbers, for the right edge of an image; nothing where there are none or the
/// image is too small to read them (below 120 pixels high, or where they would cover half of its width). The
/// numbers lie at round values; the panel has the background's colour.
std::vector<Overlay> makeLegend(const std::vector<LegendBar>& bars, glm::ivec2 imageSize,
                                const LinearColor& background);

/// Round values (1, 2 or 5 times a power of ten apart) from `low` to `high`, at most `most` of them.
std::vector<double> roundTicks(double low, double high, int most);

/// Draws digits, signs, points and `e` in cells of 6 x 8 times `scale` pixels; other characters are blank.
void drawText(Image& image, glm::ivec2 at, std::string_view text, const Rgba8& color, int scale);

}  // namespace isoglass
