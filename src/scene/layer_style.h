#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace isoglass {

inline constexpr int kMostStyleLayers = 16;

/// What is seen of the layers of an iso-surface: the crossings of its iso-value that a ray meets one after
/// the other. Z. Nagy and R. Klein, "Depth-Peeling for Texture-Based Volume Rendering", 2003, sections 3
/// and 4.
struct LayerStyle {
    enum class Show {
        nth,          ///< layer `count` alone
        blend,        ///< layers `first` to `count`, blended equally
        composed,     ///< the same, each with its colour and opacity, front to back
        silhouettes,  ///< of the same, the nearest one a pixel: hidden ones are lighter
    };

    std::string volume = {};  ///< name; empty is the first. The first of its surfaces is the one in layers
    Show show = Show::composed;
    int count = 3;  ///< 1 to kMostStyleLayers
    int first = 1;  ///< of those that are blended, composed or have silhouettes; at most `count`
    std::vector<glm::vec3> colors =
        {};  ///< of layers 1, 2, ..., linear; the last one stays. Empty: see layerColor
    std::vector<float> opacities = {};  ///< of `composed`, likewise; empty: 0.4 each
    double step = 0.5;                  ///< between samples along a ray, in cells; above 0
    /// `silhouettes`: largest |cos| of the angle between view and gradient that counts as one.
    double silhouette = 0.25;

    friend bool operator==(const LayerStyle&, const LayerStyle&) = default;
};

/// Colour of layer `layer` (from 0) for a surface of colour `surface`: silhouettes without colours of their
/// own go from black to light grey; everything else has the surface's colour.
glm::vec3 layerColor(const LayerStyle& style, int layer, const glm::vec3& surface);
/// Opacity of a layer of `composed`.
float layerOpacity(const LayerStyle& style, int layer);

}  // namespace isoglass
