#include "render/camera.h"

#include "base/error.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace isoglass {
namespace {

constexpr double kSmallestNearShare = 1e-9;

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const CameraView& camera) {
    if (!isFinite(camera.eye) || !isFinite(camera.target) || !isFinite(camera.up)) {
        throw Error("a coordinate is not finite", "camera");
    }
    if (camera.eye == camera.target) {
        throw Error("eye and target coincide, so the view has no direction", "camera", "move one of them");
    }
    if (!(camera.fovDegrees > 0 && camera.fovDegrees < 180)) {
        throw Error("the angle of view is " + std::to_string(camera.fovDegrees) + " degrees", "camera",
                    "choose one between 0 and 180");
    }
}

double tangentOfHalfHeight(const CameraView& camera) {
    return std::tan(glm::radians(camera.fovDegrees) / 2);
}

double aspect(const CameraView& camera) {
    return static_cast<double>(camera.size.x) / camera.size.y;
}

/// Cosine of the angle between the view axis and the image's corner.
double cosineOfCorner(const CameraView& camera) {
    const double y = tangentOfHalfHeight(camera);
    const double x = y * aspect(camera);
    return 1 / std::sqrt(1 + x * x + y * y);
}

/// Rows that `m` would have in writing.
glm::dmat4 fromRows(const glm::dvec4& x, const glm::dvec4& y, const glm::dvec4& z, const glm::dvec4& w) {
    return glm::transpose(glm::dmat4(x, y, z, w));
}

/// Inverse transpose times the determinant; defined for every matrix.
glm::dmat3 cofactors(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

double largestElement(const glm::dmat3& m) {
    double largest = 0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
    }
    return largest;
}

}  // namespace

ViewAxes viewAxes(const CameraView& camera) {
    check(camera);
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    glm::dvec3 side = glm::cross(forward, camera.up);
    // Below a millionth of a radian the direction of the side is rounding.
    if (!(glm::length(side) > 1e-6 * glm::length(camera.up))) side = glm::cross(forward, glm::dvec3(0, 1, 0));
    if (!(glm::length(side) > 1e-6)) side = glm::cross(forward, glm::dvec3(0, 0, 1));
    const glm::dvec3 right = glm::normalize(side);
    return {right, glm::cross(right, forward), forward};
}

std::array<glm::dvec4, 5> viewPlanes(const CameraView& camera, double margin) {
    const ViewAxes axes = viewAxes(camera);
    const double height = tangentOfHalfHeight(camera);
    // Half the picture is 1; a pixel of it is 2 / size.
    const glm::dvec2 reach = 1.0 + 2.0 * (margin + 1.0 / glm::dvec2(camera.size));
    const glm::dvec3 x = axes.forward * (height * aspect(camera) * reach.x);
    const glm::dvec3 y = axes.forward * (height * reach.y);
    const auto through = [&](const glm::dvec3& inward) {
        const glm::dvec3 normal = glm::normalize(inward);
        return glm::dvec4(normal, -glm::dot(normal, camera.eye));
    };
    return {through(x - axes.right), through(x + axes.right), through(y - axes.up), through(y + axes.up),
            through(axes.forward)};
}

void Bounds::include(const Bounds& other) {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
}

Bounds transformed(const glm::dmat4& toFromBox, const Bounds& box) {
    const glm::dvec3 center = (box.low + box.high) * 0.5;
    const glm::dvec3 half = (box.high - box.low) * 0.5;
    const glm::dvec3 mapped = glm::dvec3(toFromBox * glm::dvec4(center, 1));
    const glm::dvec3 reach = glm::abs(glm::dvec3(toFromBox[0])) * half.x +
                             glm::abs(glm::dvec3(toFromBox[1])) * half.y +
                             glm::abs(glm::dvec3(toFromBox[2])) * half.z;
    return {mapped - reach, mapped + reach};
}

double nearDistance(const CameraView& camera, const std::optional<Bounds>& drawnWorld) {
    if (!drawnWorld) return 1;
    const glm::dvec3 toLow = drawnWorld->low - camera.eye;
    const glm::dvec3 toHigh = drawnWorld->high - camera.eye;
    const double farthest = glm::length(glm::max(glm::abs(toLow), glm::abs(toHigh)));
    const double nearest = glm::length(glm::max(glm::max(toLow, -toHigh), glm::dvec3(0)));
    if (farthest == 0) return 1;
    // A point seen at the image's corner is nearer along the axis than in a straight line; 1 % covers the
    // rounding of positions to float.
    return std::max(0.99 * nearest * cosineOfCorner(camera), kSmallestNearShare * farthest);
}

glm::dmat4 clipFromEye(const CameraView& camera, double nearDistance) {
    const ViewAxes axes = viewAxes(camera);
    const double focal = 1 / tangentOfHalfHeight(camera);
    return fromRows(glm::dvec4(axes.right * (focal / aspect(camera)), 0), glm::dvec4(axes.up * focal, 0),
                    glm::dvec4(0, 0, 0, nearDistance), glm::dvec4(axes.forward, 0));
}

MeshMatrices meshMatrices(const glm::dmat4& clipFromEye, const glm::dvec3& eyeWorld,
                          const glm::dmat4& worldFromSeries, const glm::dvec3& meshOrigin) {
    glm::dmat4 eyeFromMesh = worldFromSeries;
    eyeFromMesh[3] = worldFromSeries * glm::dvec4(meshOrigin, 1) - glm::dvec4(eyeWorld, 0);
    const glm::dmat3 linear(worldFromSeries);
    const double determinant = glm::determinant(linear);
    glm::dmat3 normals = cofactors(linear);
    const double largest = largestElement(normals);
    if (largest > 0) normals *= (determinant < 0 ? -1 : 1) / largest;
    return {glm::mat4(clipFromEye * eyeFromMesh), glm::mat4(eyeFromMesh), glm::mat3(normals),
            determinant != 0 ? static_cast<float>(largest / std::abs(determinant)) : 0.0f, determinant < 0};
}

}  // namespace isoglass
