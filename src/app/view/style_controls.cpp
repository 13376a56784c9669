#include "app/view/style_controls.h"

#include "app/text.h"
#include "scene/color.h"
#include "scene/scene_file.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace isoglass {

namespace {

using Style = IllustrativeStyle;

/// A number that grows and shrinks by equal steps between two limits.
struct NumberParameter {
    std::string_view name;
    float& (*value)(Style&);
    float step, low, high;
};

constexpr std::array kNumbers{
    NumberParameter{"alpha", [](Style& s) -> float& { return s.alpha; }, 0.05f, 0, 1},
    NumberParameter{"beta", [](Style& s) -> float& { return s.beta; }, 0.05f, 0, 1},
    NumberParameter{"depth_threshold", [](Style& s) -> float& { return s.depthThreshold; }, 0.5f, 0.5f, 1e6f},
    NumberParameter{"normal_threshold", [](Style& s) -> float& { return s.normalThreshold; }, 0.02f, -4, 4},
    NumberParameter{"hatch_angle", [](Style& s) -> float& { return s.hatchAngle; }, 5, -360, 360},
    NumberParameter{"hatch_size", [](Style& s) -> float& { return s.hatchSize; }, 0.5f, 1, 1024},
    NumberParameter{"hatch_cross", [](Style& s) -> float& { return s.hatchCross; }, 0.05f, 0, 1},
    NumberParameter{"light x", [](Style& s) -> float& { return s.light.x; }, 0.1f, -1, 1},
    NumberParameter{"light y", [](Style& s) -> float& { return s.light.y; }, 0.1f, -1, 1},
    NumberParameter{"light z", [](Style& s) -> float& { return s.light.z; }, 0.1f, -1, 1},
};

/// A colour, changed to the next of the palette.
struct ColorParameter {
    std::string_view name;
    glm::vec3& (*value)(Style&);
};

constexpr std::array kColors{ColorParameter{"paper", [](Style& s) -> glm::vec3& { return s.paper; }},
                             ColorParameter{"front", [](Style& s) -> glm::vec3& { return s.front; }},
                             ColorParameter{"back", [](Style& s) -> glm::vec3& { return s.back; }}};

constexpr std::array<std::string_view, 9> kPalette{"#000000", "#404040", "#a0a0a0", "#f5f4f0", "#ffffff",
                                                   "#c42020", "#1f5fbf", "#1c8a4a", "#d98a00"};

/// A light without a direction is none: it then stays as it was.
void change(const NumberParameter& parameter, int steps, Style& style) {
    Style changed = style;
    // Only the direction of the light counts.
    const glm::vec3 light = glm::abs(style.light);
    changed.light /= std::max({light.x, light.y, light.z, 1.0f});
    float& value = parameter.value(changed);
    const float places = std::round(value / parameter.step) + static_cast<float>(steps);
    const float wanted = std::clamp(places * parameter.step, parameter.low, parameter.high);
    // A value beyond the limits is not pulled back against the key.
    if ((wanted - value) * static_cast<float>(steps) <= 0) return;
    value = wanted;
    if (changed.light == glm::vec3(0)) return;
    changed.beta = std::min(changed.beta, changed.alpha);
    style = changed;
}

void change(const ColorParameter& parameter, int steps, Style& style) {
    const auto same = [&](std::string_view hex) { return *linearFromHex(hex) == parameter.value(style); };
    const auto at = std::ranges::find_if(kPalette, same) - kPalette.begin();
    const auto count = static_cast<std::ptrdiff_t>(kPalette.size());
    const auto next = at == count ? 0 : (at + steps + count) % count;
    parameter.value(style) = *linearFromHex(kPalette[static_cast<std::size_t>(next)]);
}

}  // namespace

StyleControls::StyleControls(const Scene& scene)
    : available_(!scene.layers),
      on_(scene.illustrative.has_value()),
      style_(scene.illustrative.value_or(IllustrativeStyle())) {}

bool StyleControls::type(char32_t character) {
    if (!available_) return false;
    if (character == U'i') {
        on_ = !on_;
        parameter_.reset();
        return true;
    }
    if (!on_) return false;
    constexpr std::size_t kCount = kNumbers.size() + kColors.size();
    if (character == U'n' || character == U'N') {
        const std::size_t step = character == U'n' ? 1 : kCount - 1;
        parameter_ = parameter_ ? (*parameter_ + step) % kCount : step == 1 ? 0 : kCount - 1;
        return true;
    }
    const int steps = character == U'+' || character == U'=' ? 1 : character == U'-' ? -1 : 0;
    if (steps == 0 || !parameter_) return false;
    if (*parameter_ < kNumbers.size()) {
        change(kNumbers[*parameter_], steps, style_);
    } else {
        change(kColors[*parameter_ - kNumbers.size()], steps, style_);
    }
    return true;
}

std::optional<IllustrativeStyle> StyleControls::shown() const {
    return on_ ? std::optional(style_) : std::nullopt;
}

std::string StyleControls::notice() const {
    if (!on_ || !parameter_) return {};
    Style style = style_;
    std::string text;
    if (*parameter_ < kNumbers.size()) {
        const NumberParameter& parameter = kNumbers[*parameter_];
        const double shown = std::round(static_cast<double>(parameter.value(style)) * 1000) / 1000;
        text = std::string(parameter.name) + ' ' + formatNumber(shown);
    } else {
        const ColorParameter& parameter = kColors[*parameter_ - kNumbers.size()];
        text = std::string(parameter.name) + ' ' + hexFromLinear(parameter.value(style));
    }
    return text + "   (+ and - change it, n goes on to the next, p prints the style)";
}

std::string StyleControls::sceneText() const {
    return "\"style\": " + toJson(style_);
}

}  // namespace isoglass
