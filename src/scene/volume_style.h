#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <string>
#include <vector>

namespace isoglass {

/// The light of cuts: within `thickness` of a cut what is left is lit by the cut's normal as well,
/// g = E + w S_surface + (1 - w) S_volume ("impregnation", section 5.2 of the paper below). Distances are
/// world lengths from the nearest surface of the planes and solids that clip; exact for planes, boxes, and
/// spheres and cylinders that are scaled evenly, else to the first order.
struct CutLight {
    /// w by the distance: 1; falling evenly to 0; falling to 0 with slopes of 0 at both ends.
    enum class Weight { step, ramp, smooth };

    double thickness = 0;  ///< above 0
    Weight weight = Weight::ramp;

    friend bool operator==(const CutLight&, const CutLight&) = default;
};

/// A volume as a medium that glows and absorbs: the emission-absorption model of D. Weiskopf, K. Engel and T.
/// Ertl, "Interactive Clipping Techniques for Texture-Based Volume Visualization and Volume Shading", 2003,
/// section 5.1.
struct VolumeStyle {
    struct ColorPoint {
        double value = 0;
        glm::vec3 color{1};  ///< linear

        friend bool operator==(const ColorPoint&, const ColorPoint&) = default;
    };
    struct OpacityPoint {
        double value = 0;
        float opacity = 0;  ///< of a way of one `unit` through that value, 0 to 1

        friend bool operator==(const OpacityPoint&, const OpacityPoint&) = default;
    };

    std::string volume = {};  ///< name; empty is the first
    /// By increasing value, linear in between, and constant beyond the ends; at least one.
    std::vector<ColorPoint> colors = {};
    std::vector<OpacityPoint> opacities = {};  ///< likewise
    /// World length that the opacities are meant for; a hundredth of the volume's diagonal where not given.
    std::optional<double> unit = {};
    double step = 0.5;                 ///< between samples along a ray, in cells; above 0
    bool lit = true;                   ///< by the gradient; else the colours are light of their own
    std::optional<CutLight> cut = {};  ///< only where `lit`

    friend bool operator==(const VolumeStyle&, const VolumeStyle&) = default;
};

/// Colour, and opacity of a unit, of a value.
glm::vec4 transferAt(const VolumeStyle& style, double value);

}  // namespace isoglass
