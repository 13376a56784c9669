#include "scene/scene.h"

#include "scene/color_map.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace isoglass {

std::int64_t Timeline::frameCount() const {
    return std::max<std::int64_t>(1, std::llround(duration * fps));
}

double Timeline::position(std::int64_t frame) const {
    return static_cast<double>(frame) / static_cast<double>(frameCount());
}

glm::dmat4 worldFromSeries(const Placement& place) {
    const glm::dvec3 axis(place.rotate);
    glm::dmat4 matrix = glm::translate(glm::dmat4(1), place.translate);
    if (place.rotate.w != 0) matrix = glm::rotate(matrix, glm::radians(place.rotate.w), glm::normalize(axis));
    return glm::scale(matrix, place.scale);
}

void colorByLevel(Scene& scene) {
    constexpr double kHighestLevel = 4;
    const auto names = colorMapNames();
    const auto rainbow = static_cast<std::size_t>(std::ranges::find(names, "cet-r2") - names.begin());
    for (Volume& volume : scene.volumes) {
        for (Surface& surface : volume.surfaces)
            surface.fieldColor =
                FieldColor{.by = FieldColor::By::level, .map = rainbow, .low = 0, .high = kHighestLevel};
    }
}

}  // namespace isoglass
