#include "render/legend.h"

#include "scene/color_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace isoglass {

namespace {

constexpr int kGlyphWidth = 6;
constexpr int kGlyphHeight = 8;
constexpr int kBarWidth = 10;
constexpr int kGap = 4;
constexpr int kSmallestHeight = 120;

/// Rows from the top, five bits each, the highest one on the left.
struct Glyph {
    char name;
    std::array<std::uint8_t, 7> rows;
};

constexpr std::array<Glyph, 14> kGlyphs = {{
    {'0', {0x0e, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0e}},
    {'1', {0x04, 0x0c, 0x04, 0x04, 0x04, 0x04, 0x0e}},
    {'2', {0x0e, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1f}},
    {'3', {0x1f, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0e}},
    {'4', {0x02, 0x06, 0x0a, 0x12, 0x1f, 0x02, 0x02}},
    {'5', {0x1f, 0x10, 0x1e, 0x01, 0x01, 0x11, 0x0e}},
    {'6', {0x06, 0x08, 0x10, 0x1e, 0x11, 0x11, 0x0e}},
    {'7', {0x1f, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08}},
    {'8', {0x0e, 0x11, 0x11, 0x0e, 0x11, 0x11, 0x0e}},
    {'9', {0x0e, 0x11, 0x11, 0x0f, 0x01, 0x02, 0x0c}},
    {'-', {0x00, 0x00, 0x00, 0x1f, 0x00, 0x00, 0x00}},
    {'+', {0x00, 0x04, 0x04, 0x1f, 0x04, 0x04, 0x00}},
    {'.', {0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x0c}},
    {'e', {0x00, 0x00, 0x0e, 0x11, 0x1f, 0x10, 0x0e}},
}};

Rgba8 srgb(const LinearColor& color) {
    const glm::dvec3 c = glm::clamp(glm::dvec3(color), 0.0, 1.0);
    const auto encode = [](double v) {
        const double s = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
        return static_cast<std::uint8_t>(std::lround(255 * s));
    };
    return {encode(c.x), encode(c.y), encode(c.z), 255};
}

std::string numberText(double value, double step) {
    char text[32];
    // Far from 1 as a power of ten, else with the digits that tell ticks apart.
    const double largest = std::max(std::abs(value), step);
    if (largest >= 1e5 || step < 1e-4) {
        std::snprintf(text, sizeof text, "%.3g", value);
    } else {
        const int digits = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
        std::snprintf(text, sizeof text, "%.*f", digits, value);
    }
    return text;
}

struct Tick {
    double value;
    std::string text;
};

std::vector<Tick> ticksOf(const LegendBar& bar, int most) {
    const std::vector<double> values = roundTicks(bar.low, bar.high, most);
    const double step = values.size() > 1 ? values[1] - values[0] : std::abs(bar.high - bar.low);
    std::vector<Tick> ticks;
    for (const double value : values) ticks.push_back({value, numberText(value, step)});
    return ticks;
}

void fill(Image& image, glm::ivec2 low, glm::ivec2 high, const Rgba8& color) {
    for (int y = std::max(0, low.y); y < std::min(image.size.y, high.y); ++y) {
        for (int x = std::max(0, low.x); x < std::min(image.size.x, high.x); ++x) image.at(x, y) = color;
    }
}

struct Layout {
    int scale, barHeight, top;
};

void drawBar(Image& panel, int left, const LegendBar& bar, const std::vector<Tick>& ticks,
             const Layout& layout, const Rgba8& ink) {
    const auto colors = colorMap(bar.map);
    const int scale = layout.scale;
    const int right = left + kBarWidth * scale;
    for (int y = 0; y < layout.barHeight; ++y) {
        const double position = 1 - (y + 0.5) / layout.barHeight;
        fill(panel, {left, layout.top + y}, {right, layout.top + y + 1}, srgb(colorAt(colors, position)));
    }
    for (const Tick& tick : ticks) {
        const double position = (tick.value - bar.low) / (bar.high - bar.low);
        const int y = layout.top + static_cast<int>(std::lround((1 - position) * (layout.barHeight - 1)));
        fill(panel, {right, y}, {right + 3 * scale, y + scale}, ink);
        drawText(panel, {right + kGap * scale, y - kGlyphHeight * scale / 2 + scale}, tick.text, ink, scale);
    }
}

}  // namespace

std::vector<double> roundTicks(double low, double high, int most) {
    if (low > high) std::swap(low, high);
    const double span = high - low;
    if (!(span > 0) || most < 2) return {low};
    double power = std::pow(10, std::floor(std::log10(span / most)));
    double step = power;
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0}) {
        step = factor * power;
        // A hair of the step decides what counts as an end.
        const double count = std::floor(high / step + 1e-9) - std::ceil(low / step - 1e-9) + 1;
        if (count <= most) break;
    }
    std::vector<double> ticks;
    for (double i = std::ceil(low / step - 1e-9); i <= std::floor(high / step + 1e-9); ++i)
        ticks.push_back(i * step + 0.0);
    return ticks;
}

void drawText(Image& image, glm::ivec2 at, std::string_view text, const Rgba8& color, int scale) {
    for (const char name : text) {
        const auto glyph = std::ranges::find(kGlyphs, name, &Glyph::name);
        for (int y = 0; glyph != kGlyphs.end() && y < 7; ++y) {
            for (int x = 0; x < 5; ++x) {
                if (!(glyph->rows[static_cast<std::size_t>(y)] >> (4 - x) & 1)) continue;
                const glm::ivec2 low = at + glm::ivec2(x, y) * scale;
                fill(image, low, low + scale, color);
            }
        }
        at.x += kGlyphWidth * scale;
    }
}

std::vector<Overlay> makeLegend(const std::vector<LegendBar>& bars, glm::ivec2 imageSize,
                                const LinearColor& background) {
    if (bars.empty() || imageSize.y < kSmallestHeight) return {};
    Layout layout;
    layout.scale = std::max(1, imageSize.y / 360);
    layout.barHeight = imageSize.y * 6 / 10;
    layout.top = (kGap + kGlyphHeight / 2) * layout.scale;
    const int most = std::clamp(layout.barHeight / ((kGlyphHeight + 3) * layout.scale), 2, 6);
    std::vector<std::vector<Tick>> ticks;
    std::vector<int> lefts;
    int width = kGap * layout.scale;
    for (const LegendBar& bar : bars) {
        ticks.push_back(ticksOf(bar, most));
        std::size_t longest = 0;
        for (const Tick& tick : ticks.back()) longest = std::max(longest, tick.text.size());
        lefts.push_back(width);
        width += (kBarWidth + 2 * kGap + kGlyphWidth * static_cast<int>(longest)) * layout.scale;
    }
    if (width > imageSize.x / 2) return {};
    Overlay legend;
    legend.image.size = {width, layout.barHeight + 2 * layout.top};
    legend.image.pixels.assign(
        static_cast<std::size_t>(legend.image.size.x) * static_cast<std::size_t>(legend.image.size.y),
        srgb(background));
    const bool isDark = glm::dot(background, LinearColor(0.2126f, 0.7152f, 0.0722f)) < 0.18f;
    const Rgba8 ink = isDark ? Rgba8{230, 230, 230, 255} : Rgba8{20, 20, 20, 255};
    for (std::size_t i = 0; i < bars.size(); ++i)
        drawBar(legend.image, lefts[i], bars[i], ticks[i], layout, ink);
    legend.at = {imageSize.x - width, (imageSize.y - legend.image.size.y) / 2};
    return {legend};
}

}  // namespace isoglass
