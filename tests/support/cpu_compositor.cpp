#include "support/cpu_compositor.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isoglass::test {

std::optional<TriangleHit> intersectTriangle(const Ray& ray, const std::array<glm::dvec3, 3>& corner) {
    constexpr double kTolerance = 0x1p-40;
    const glm::dvec3 ab = corner[1] - corner[0];
    const glm::dvec3 ac = corner[2] - corner[0];
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return std::nullopt;
    const glm::dvec3 fromFirst = ray.origin - corner[0];
    const glm::dvec3 q = glm::cross(fromFirst, ab);
    const double u = glm::dot(fromFirst, p) / determinant;
    const double v = glm::dot(ray.direction, q) / determinant;
    const double distance = glm::dot(ac, q) / determinant;
    if (u < -kTolerance || v < -kTolerance || u + v > 1 + kTolerance || distance <= 0) return std::nullopt;
    return TriangleHit{distance, determinant < 0, {1 - u - v, u, v}};
}

Ray pixelRay(const CameraView& camera, double x, double y) {
    const ViewAxes axes = viewAxes(camera);
    const double tangent = std::tan(glm::radians(camera.fovDegrees) / 2);
    const double right = (2 * x - camera.size.x) / camera.size.y * tangent;
    const double up = (1 - 2 * y / camera.size.y) * tangent;
    return {camera.eye, glm::normalize(axes.forward + axes.right * right + axes.up * up)};
}

glm::dvec3 compose(const std::vector<Fragment>& fragments, const glm::dvec3& background,
                   TransparencyMethod method) {
    double opaqueDistance = std::numeric_limits<double>::infinity();
    glm::dvec3 behind = background;
    for (const Fragment& fragment : fragments) {
        if (fragment.opacity < 1 || fragment.distance >= opaqueDistance) continue;
        opaqueDistance = fragment.distance;
        behind = fragment.color;
    }
    double emissionLimit = opaqueDistance;
    for (const Fragment& fragment : fragments) {
        if (method == TransparencyMethod::fourPass && fragment.opacity < 1 && fragment.backFace) {
            emissionLimit = std::min(emissionLimit, fragment.distance);
        }
    }
    double transmittance = 1;
    glm::dvec3 emission(0);
    for (const Fragment& fragment : fragments) {
        if (fragment.opacity >= 1 || fragment.distance > opaqueDistance) continue;
        transmittance *= 1 - fragment.opacity;
        if (fragment.distance <= emissionLimit) emission += fragment.opacity * fragment.color;
    }
    return behind * transmittance + emission;
}

glm::dvec3 shade(const glm::dvec3& color, const glm::dvec3& normal, const glm::dvec3& toEye,
                 const Lighting& lighting) {
    const double cosine = std::abs(glm::dot(glm::normalize(normal), glm::normalize(toEye)));
    return color * (lighting.ambient + lighting.diffuse * cosine) +
           lighting.specular * std::pow(cosine, double(lighting.shininess));
}

}  // namespace isoglass::test
