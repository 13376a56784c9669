#pragma once

#include "render/camera.h"
#include "scene/scene.h"

#include <glm/vec2.hpp>

namespace isoglass {

// How the mouse moves the camera: pure functions from pose to pose. Distances on the screen are in heights
// of the window, x to the right and y downwards. A distance of zero gives the pose as it is.

/// The lens that a pose looks through.
struct Lens {
    glm::dvec3 up{0, 0, 1};
    double fovDegrees = 30;  ///< vertical
};

/// Turns the eye about the target so that what is seen follows a drag: half a turn for the window's height.
/// It stops 0.1 degrees before it looks along `up`.
CameraPose orbited(const CameraPose& pose, const Lens& lens, glm::dvec2 drag);

/// Moves eye and target so that what lies at the target's distance follows the drag.
CameraPose panned(const CameraPose& pose, const Lens& lens, glm::dvec2 drag);

/// Multiplies the distance to the target by `factor`, which is above 0; what lies at the target's distance
/// under `at`, measured from the window's middle, stays there.
CameraPose zoomed(const CameraPose& pose, const Lens& lens, glm::dvec2 at, double factor);

/// Where a camera that looks along `forward` at the middle of the box stands so that the box fills a picture
/// of width / height `aspect` but for a margin of a twentieth. `forward` is not along `lens.up`; a box
/// without size is seen from distance 1.
CameraPose fitted(const Bounds& box, const Lens& lens, const glm::dvec3& forward, double aspect);

}  // namespace isoglass
