#include "scene/color.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace isoglass {

namespace {

/// Two hex digits.
std::optional<unsigned> hexByte(std::string_view digits) {
    unsigned value = 0;
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, value, 16);
    if (error != std::errc() || end != last) return std::nullopt;
    return value;
}

void appendHexByte(std::string& hex, double share) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    const auto value = static_cast<unsigned>(std::lround(std::clamp(share, 0.0, 1.0) * 255));
    hex += kDigits[value / 16];
    hex += kDigits[value % 16];
}

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
        const auto value = hexByte(hex.substr(1 + 2 * static_cast<std::size_t>(channel), 2));
        if (!value) return std::nullopt;
        color[channel] = static_cast<float>(linearFromSrgb(*value / 255.0));
    }
    return color;
}

std::string hexFromLinear(const LinearColor& color) {
    std::string hex = "#";
    for (int channel = 0; channel < 3; ++channel) {
        appendHexByte(hex, srgbFromLinear(std::clamp(static_cast<double>(color[channel]), 0.0, 1.0)));
    }
    return hex;
}

std::optional<Backdrop> backdropFromText(std::string_view text) {
    if (text == "transparent") return Backdrop{LinearColor(0), 0};
    const bool hasAlpha = text.size() == 9;
    const auto color = linearFromHex(hasAlpha ? text.substr(0, 7) : text);
    const auto alpha = hasAlpha ? hexByte(text.substr(7)) : 255u;
    if (!color || !alpha) return std::nullopt;
    return Backdrop{*color, static_cast<float>(*alpha / 255.0)};
}

std::string textFromBackdrop(const Backdrop& backdrop) {
    std::string text = hexFromLinear(backdrop.color);
    if (backdrop.opacity < 1) appendHexByte(text, backdrop.opacity);
    return text;
}

}  // namespace isoglass
