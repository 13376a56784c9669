#pragma once

#include <glm/vec3.hpp>

namespace isoglass {

/// From where a surface will be seen, in the coordinates of its series.
struct View {
    glm::dvec3 eye{0};
    /// Pixels that a length of 1 at distance 1 covers: image height / (2 tan(fov / 2)).
    double pixelsPerUnit = 1;
};

}  // namespace isoglass
