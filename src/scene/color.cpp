#include "scene/color.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace isoglass {

namespace {

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

std::optional<LinearColor> linearFromHex(std::string_view hex) {
    if (hex.size() != 7 || hex[0] != '#') return std::nullopt;
    LinearColor color;
    for (int channel = 0; channel < 3; ++channel) {
        const char* begin = hex.data() + 1 + 2 * channel;
        unsigned value = 0;
        const auto [end, error] = std::from_chars(begin, begin + 2, value, 16);
        if (error != std::errc() || end != begin + 2) return std::nullopt;
        color[channel] = static_cast<float>(linearFromSrgb(value / 255.0));
    }
    return color;
}

std::string hexFromLinear(const LinearColor& color) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex = "#";
    for (int channel = 0; channel < 3; ++channel) {
        const double encoded = srgbFromLinear(std::clamp(static_cast<double>(color[channel]), 0.0, 1.0));
        const auto value = static_cast<unsigned>(std::lround(encoded * 255));
        hex += kDigits[value / 16];
        hex += kDigits[value % 16];
    }
    return hex;
}

}  // namespace isoglass
