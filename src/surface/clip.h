#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace isoglass {

/// A plane that cuts a surface: where a x + b y + c z + d >= 0, in the series' world units, is kept.
struct CutPlane {
    glm::dvec4 plane{0, 0, 1, 0};  ///< a, b, c, d; the normal is not zero
    bool cap = true;               ///< fill what is inside on the cut

    double distance(const glm::dvec3& position) const {
        return glm::dot(glm::dvec3(plane), position) + plane.w;
    }
};

}  // namespace isoglass
