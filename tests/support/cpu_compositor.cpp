#include "support/cpu_compositor.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

double opacityOf(const SurfaceDraw& draw, const glm::dvec3& gradient, const glm::dvec3& view) {
    if (!draw.shell) return draw.opacity;
    const double length = glm::length(gradient);
    const double cosine = length > 0 ? glm::dot(gradient / length, view) : 0;
    return std::min(shellOpacity(*draw.shell, cosine, length), std::nextafter(1.0, 0.0));
}

Ray pixelRay(const CameraView& camera, double x, double y) {
    const ViewAxes axes = viewAxes(camera);
    const double tangent = std::tan(glm::radians(camera.fovDegrees) / 2);
    const double right = (2 * x - camera.size.x) / camera.size.y * tangent;
    const double up = (1 - 2 * y / camera.size.y) * tangent;
    return {camera.eye, glm::normalize(axes.forward + axes.right * right + axes.up * up)};
}

namespace {

/// Light in front, and how much of what is behind comes through.
struct Front {
    glm::dvec3 emission{0};
    double transmittance = 1;
};

/// `visible` are the semi-transparent fragments in front of what is opaque.
Front sums(const std::vector<Fragment>& visible, bool cutAtBackFace) {
    double limit = std::numeric_limits<double>::infinity();
    for (const Fragment& fragment : visible) {
        if (cutAtBackFace && fragment.backFace) limit = std::min(limit, fragment.distance);
    }
    Front front;
    for (const Fragment& fragment : visible) {
        front.transmittance *= 1 - fragment.opacity;
        if (fragment.distance <= limit) front.emission += fragment.opacity * fragment.color;
    }
    return front;
}

Front inOrder(const std::vector<Fragment>& nearestFirst) {
    Front front;
    for (const Fragment& fragment : nearestFirst) {
        front.emission += front.transmittance * fragment.opacity * fragment.color;
        front.transmittance *= 1 - fragment.opacity;
    }
    return front;
}

Front composeFront(std::vector<Fragment> visible, TransparencyMethod method, int layers) {
    using enum TransparencyMethod;
    if (method == threePass || method == fourPass) return sums(visible, method == fourPass);
    if (method == twoPass) {
        // What is drawn later lies over what was drawn before.
        std::sort(visible.begin(), visible.end(), [](const Fragment& a, const Fragment& b) {
            return std::pair(a.draw, a.triangle) > std::pair(b.draw, b.triangle);
        });
        return inOrder(visible);
    }
    std::stable_sort(visible.begin(), visible.end(),
                     [](const Fragment& a, const Fragment& b) { return a.distance < b.distance; });
    if (method == peel) visible.resize(std::min(visible.size(), static_cast<std::size_t>(layers)));
    return inOrder(visible);
}

}  // namespace

glm::dvec3 compose(const std::vector<Fragment>& fragments, const glm::dvec3& background,
                   TransparencyMethod method, int layers) {
    double opaqueDistance = std::numeric_limits<double>::infinity();
    glm::dvec3 behind = background;
    for (const Fragment& fragment : fragments) {
        if (fragment.opacity < 1 || fragment.distance >= opaqueDistance) continue;
        opaqueDistance = fragment.distance;
        behind = fragment.color;
    }
    std::vector<Fragment> visible;
    for (const Fragment& fragment : fragments) {
        if (fragment.opacity < 1 && fragment.distance <= opaqueDistance) visible.push_back(fragment);
    }
    const Front front = composeFront(std::move(visible), method, layers);
    return behind * front.transmittance + front.emission;
}

glm::dvec3 shade(const glm::dvec3& color, const glm::dvec3& normal, const glm::dvec3& toEye,
                 const Lighting& lighting) {
    const double cosine = std::abs(glm::dot(glm::normalize(normal), glm::normalize(toEye)));
    return color * (lighting.ambient + lighting.diffuse * cosine) +
           lighting.specular * std::pow(cosine, double(lighting.shininess));
}

}  // namespace isoglass::test
