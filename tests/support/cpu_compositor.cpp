#include "support/cpu_compositor.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace isoglass::test {
namespace {

struct Hit {
    double distance;
    bool backFace;
    glm::dvec3 barycentric;
};

/// Plane and edge functions in double (Moeller and Trumbore 1997).
std::optional<Hit> intersectTriangle(const Ray& ray, const glm::dvec3& a, const glm::dvec3& b,
                                     const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return std::nullopt;
    const glm::dvec3 fromA = ray.origin - a;
    const glm::dvec3 q = glm::cross(fromA, ab);
    const double u = glm::dot(fromA, p) / determinant;
    const double v = glm::dot(ray.direction, q) / determinant;
    const double distance = glm::dot(ac, q) / determinant;
    if (u < 0 || v < 0 || u + v > 1 || distance <= 0) return std::nullopt;
    return Hit{distance, determinant < 0, {1 - u - v, u, v}};
}

void intersectSurface(const Ray& ray, const TruthSurface& surface, std::size_t index,
                      const Lighting& lighting, std::vector<Fragment>& fragments) {
    const SurfaceMesh& mesh = surface.mesh;
    const glm::dmat4& toWorld = surface.draw.worldFromSeries;
    const glm::dmat3 linear(toWorld);
    const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(linear));
    const bool mirrored = glm::determinant(linear) < 0;
    const auto world = [&](std::uint32_t vertex) {
        return glm::dvec3(toWorld * glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[vertex]), 1));
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        const std::uint32_t* v = &mesh.triangles[t];
        const auto hit = intersectTriangle(ray, world(v[0]), world(v[1]), world(v[2]));
        if (!hit) continue;
        glm::dvec3 normal(0);
        for (int i = 0; i < 3; ++i) normal += hit->barycentric[i] * glm::dvec3(mesh.normals[v[i]]);
        const glm::dvec3 color = shade(surface.draw.color, normalToWorld * normal, -ray.direction, lighting);
        fragments.push_back(
            {hit->distance, hit->backFace != mirrored, index, color, double(surface.draw.opacity)});
    }
}

}  // namespace

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

std::vector<Fragment> intersect(const Ray& ray, const std::vector<TruthSurface>& surfaces,
                                const Lighting& lighting) {
    std::vector<Fragment> fragments;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        intersectSurface(ray, surfaces[i], i, lighting, fragments);
    }
    std::sort(fragments.begin(), fragments.end(),
              [](const Fragment& a, const Fragment& b) { return a.distance < b.distance; });
    return fragments;
}

}  // namespace isoglass::test
