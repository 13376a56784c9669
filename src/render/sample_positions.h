#pragma once

#include <glm/vec2.hpp>

namespace isoglass {

/// Where picture `index` of `count` that are averaged takes its samples: the move from the center of the
/// cell of a sample, in cells, at most half a cell along each axis. One picture takes the center. The
/// points of a Hammersley set, whose mean is the center.
glm::dvec2 samplePosition(int index, int count);

}  // namespace isoglass
