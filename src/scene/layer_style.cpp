#include "scene/layer_style.h"

#include <algorithm>

namespace isoglass {

namespace {

constexpr float kUsualOpacity = 0.4f;
/// Linear light of the most hidden silhouette without a colour of its own.
constexpr float kLightest = 0.6f;

}  // namespace

glm::vec3 layerColor(const LayerStyle& style, int layer, const glm::vec3& surface) {
    if (!style.colors.empty())
        return style.colors[std::min(static_cast<std::size_t>(layer), style.colors.size() - 1)];
    if (style.show != LayerStyle::Show::silhouettes) return surface;
    return glm::vec3(kLightest * static_cast<float>(layer) /
                     static_cast<float>(std::max(style.count - 1, 1)));
}

float layerOpacity(const LayerStyle& style, int layer) {
    if (style.opacities.empty()) return kUsualOpacity;
    return style.opacities[std::min(static_cast<std::size_t>(layer), style.opacities.size() - 1)];
}

}  // namespace isoglass
