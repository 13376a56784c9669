#include "app/view/camera_control.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isoglass {

namespace {

constexpr double kHighestDegrees = 89.9;
constexpr double kMargin = 1.05;

ViewAxes axesOf(const CameraPose& pose, const Lens& lens) {
    return viewAxes({.eye = pose.eye, .target = pose.target, .up = lens.up, .fovDegrees = lens.fovDegrees});
}

double tangentOfHalfHeight(const Lens& lens) {
    return std::tan(glm::radians(lens.fovDegrees) / 2);
}

/// Height of what is seen at the target's distance.
double heightAtTarget(const CameraPose& pose, const Lens& lens) {
    return 2 * glm::length(pose.target - pose.eye) * tangentOfHalfHeight(lens);
}

glm::dvec3 rotated(const glm::dvec3& vector, double radians, const glm::dvec3& axis) {
    return glm::dvec3(glm::rotate(glm::dmat4(1), radians, axis) * glm::dvec4(vector, 0));
}

}  // namespace

CameraPose orbited(const CameraPose& pose, const Lens& lens, glm::dvec2 drag) {
    if (drag == glm::dvec2(0)) return pose;
    const glm::dvec3 up = glm::normalize(lens.up);
    const glm::dvec3 arm = pose.eye - pose.target;
    const glm::dvec2 turn = drag * std::numbers::pi;
    const double rise = glm::dot(arm, up);
    const double elevation = std::atan2(rise, glm::length(arm - rise * up));
    // A pose that is already higher may stay there.
    const double highest = std::max(glm::radians(kHighestDegrees), std::abs(elevation));
    const double wanted = std::clamp(elevation + turn.y, -highest, highest);
    const glm::dvec3 level = axesOf(pose, lens).right;
    const glm::dvec3 tilted = rotated(arm, elevation - wanted, level);
    return {pose.target + rotated(tilted, -turn.x, up), pose.target};
}

CameraPose panned(const CameraPose& pose, const Lens& lens, glm::dvec2 drag) {
    if (drag == glm::dvec2(0)) return pose;
    const ViewAxes axes = axesOf(pose, lens);
    const glm::dvec3 shift = heightAtTarget(pose, lens) * (drag.y * axes.up - drag.x * axes.right);
    return {pose.eye + shift, pose.target + shift};
}

CameraPose zoomed(const CameraPose& pose, const Lens& lens, glm::dvec2 at, double factor) {
    const ViewAxes axes = axesOf(pose, lens);
    const glm::dvec3 fixed = pose.target + heightAtTarget(pose, lens) * (at.x * axes.right - at.y * axes.up);
    return {fixed + factor * (pose.eye - fixed), fixed + factor * (pose.target - fixed)};
}

CameraPose fitted(const Bounds& box, const Lens& lens, const glm::dvec3& forward, double aspect) {
    const glm::dvec3 middle = (box.low + box.high) * 0.5;
    const glm::dvec3 half = (box.high - box.low) * 0.5;
    const glm::dvec3 direction = glm::normalize(forward);
    const ViewAxes axes = axesOf({middle - direction, middle}, lens);
    const double tangentY = tangentOfHalfHeight(lens);
    const double tangentX = tangentY * aspect;
    double distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const glm::dvec3 arm = side * half;
        const double needed = std::max(std::abs(glm::dot(arm, axes.right)) / tangentX,
                                       std::abs(glm::dot(arm, axes.up)) / tangentY);
        distance = std::max(distance, needed * kMargin - glm::dot(arm, axes.forward));
    }
    if (!(distance > 0)) distance = 1;
    return {middle - distance * direction, middle};
}

}  // namespace isoglass
