#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace isoglass {

/// From where a surface will be seen, and how fine it has to be.
struct View {
    glm::dvec3 eye{0};  ///< in the coordinates of the series
    /// World length of a unit along each axis of the series: distances are measured in the world, whose
    /// axes the placement of the series may stretch.
    glm::dvec3 worldPerUnit{1};
    /// Pixels that a length of 1 at distance 1 covers: image height / (2 tan(fov / 2)).
    double pixelsPerUnit = 1;
    /// Largest cell size on the screen in pixels, away from the eye in any direction; 0 asks for full
    /// resolution. At most about a fourteenth of `pixelsPerUnit` acts, since detail may not change faster
    /// over the lattice than levels can.
    double cellPixels = 0;
    /// Largest displacement of the surface on the screen in pixels; takes the place of `cellPixels` where it
    /// is above 0. An estimate from the data, see ErrorSizes.
    double errorPixels = 0;

    /// What lies behind any of these, a x + b y + c z + d < 0 in the coordinates of the series, is not seen.
    /// Bricks wholly behind one are left out of meshes that are neither clipped nor closed nor have heights.
    std::vector<glm::dvec4> planes = {};

    bool wantsDetail() const { return cellPixels > 0 || errorPixels > 0; }
};

}  // namespace isoglass
