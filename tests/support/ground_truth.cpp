#include "support/ground_truth.h"

#include "basis/parallel.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace isoglass::test {
namespace {

/// A triangle in the world, and the pixels whose rays may meet it.
struct WorldTriangle {
    std::array<glm::dvec3, 3> corner;
    std::array<glm::dvec3, 3> normal;
    std::array<std::uint32_t, 3> vertex;
    std::size_t surface;
    std::size_t index;  ///< of the triangle within the surface
    bool mirrored;
    glm::ivec2 low, high;  ///< pixels, both ends included
};

/// Pixels around a triangle's picture, one to spare on every side; the whole image where a corner lies
/// beside or behind the eye.
void boundPixels(const CameraView& camera, WorldTriangle& triangle) {
    const ViewAxes axes = viewAxes(camera);
    const double tangent = std::tan(glm::radians(camera.fovDegrees) / 2);
    triangle.low = glm::ivec2(0);
    triangle.high = camera.size - 1;
    glm::dvec2 low(1e300), high(-1e300);
    for (const glm::dvec3& corner : triangle.corner) {
        const glm::dvec3 fromEye = corner - camera.eye;
        const double depth = glm::dot(fromEye, axes.forward);
        if (depth <= 1e-9 * glm::length(fromEye)) return;
        const glm::dvec2 pixel = glm::dvec2(camera.size) / 2.0 +
                                 glm::dvec2(glm::dot(fromEye, axes.right), -glm::dot(fromEye, axes.up)) *
                                     (camera.size.y / (2 * tangent * depth));
        low = glm::min(low, pixel);
        high = glm::max(high, pixel);
    }
    triangle.low = glm::ivec2(glm::clamp(low - 2.0, glm::dvec2(0), glm::dvec2(camera.size)));
    triangle.high = glm::ivec2(glm::clamp(high + 1.0, glm::dvec2(-1), glm::dvec2(camera.size - 1)));
}

std::vector<WorldTriangle> worldTriangles(const CameraView& camera,
                                          const std::vector<TruthSurface>& surfaces) {
    std::vector<WorldTriangle> all;
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const SurfaceMesh& mesh = surfaces[s].mesh;
        const glm::dmat4& toWorld = surfaces[s].draw.worldFromSeries;
        const glm::dmat3 normalToWorld = glm::transpose(glm::inverse(glm::dmat3(toWorld)));
        for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
            WorldTriangle triangle;
            triangle.surface = s;
            triangle.index = t / 3;
            triangle.mirrored = glm::determinant(glm::dmat3(toWorld)) < 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t v = mesh.triangles[t + i];
                triangle.vertex[i] = v;
                triangle.corner[i] =
                    glm::dvec3(toWorld * glm::dvec4(mesh.origin + glm::dvec3(mesh.positions[v]), 1));
                triangle.normal[i] = normalToWorld * glm::dvec3(mesh.normals[v]);
            }
            boundPixels(camera, triangle);
            all.push_back(triangle);
        }
    }
    return all;
}

struct TracedFragment {
    Fragment fragment;
    std::array<std::uint32_t, 3> vertex;
};

/// Hits of neighbouring triangles at the edge or corner that they share.
bool isSameHit(const TracedFragment& a, const TracedFragment& b) {
    if (a.fragment.draw != b.fragment.draw || a.fragment.backFace != b.fragment.backFace) return false;
    if (std::abs(a.fragment.distance - b.fragment.distance) > 1e-9 * a.fragment.distance) return false;
    return std::ranges::find_first_of(a.vertex, b.vertex) != a.vertex.end();
}

class RowTracer {
  public:
    RowTracer(const FrameDescription& frame, const std::vector<TruthSurface>& surfaces,
              const std::vector<WorldTriangle>& triangles, int row)
        : frame_(frame), surfaces_(surfaces) {
        for (const WorldTriangle& triangle : triangles) {
            if (triangle.low.y <= row && row <= triangle.high.y) row_.push_back(&triangle);
        }
    }

    /// Fragments of the ray through (x, y), nearest first; `column` is the pixel around it.
    std::vector<Fragment> trace(double x, double y, int column) const {
        const Ray ray = pixelRay(frame_.camera, x, y);
        std::vector<TracedFragment> traced;
        for (const WorldTriangle* triangle : row_) {
            if (column < triangle->low.x || column > triangle->high.x) continue;
            const auto hit = intersectTriangle(ray, triangle->corner);
            if (!hit) continue;
            glm::dvec3 normal(0);
            for (int i = 0; i < 3; ++i) normal += hit->barycentric[i] * triangle->normal[i];
            const SurfaceDraw& draw = surfaces_[triangle->surface].draw;
            traced.push_back({{hit->distance, hit->backFace != triangle->mirrored, triangle->surface,
                               shade(draw.color, normal, -ray.direction, frame_.lighting),
                               opacityOf(draw, normal, ray.direction), triangle->index},
                              triangle->vertex});
        }
        std::ranges::stable_sort(traced, {}, [](const auto& t) { return t.fragment.distance; });
        std::vector<Fragment> fragments;
        for (std::size_t i = 0; i < traced.size(); ++i) {
            const bool again = std::any_of(traced.begin(), traced.begin() + i, [&](const auto& earlier) {
                return isSameHit(earlier, traced[i]);
            });
            if (!again) fragments.push_back(traced[i].fragment);
        }
        return fragments;
    }

  private:
    const FrameDescription& frame_;
    const std::vector<TruthSurface>& surfaces_;
    std::vector<const WorldTriangle*> row_;
};

bool meetTheSame(const std::vector<Fragment>& a, const std::vector<Fragment>& b) {
    return std::ranges::equal(a, b, [](const Fragment& f, const Fragment& g) {
        return f.draw == g.draw && f.backFace == g.backFace;
    });
}

}  // namespace

std::size_t TruthImage::silhouettePixels() const {
    return static_cast<std::size_t>(std::ranges::count(silhouette.pixels, std::uint8_t{1}));
}

TruthImage renderTruth(const FrameDescription& frame, const std::vector<TruthSurface>& surfaces,
                       const Composer& compose, const TruthOptions& options) {
    const glm::ivec2 size = frame.camera.size;
    const std::size_t pixels = static_cast<std::size_t>(size.x) * size.y;
    TruthImage truth;
    truth.color = {size, std::vector<glm::vec3>(pixels)};
    truth.silhouette = {size, std::vector<std::uint8_t>(pixels)};
    std::vector<std::size_t> deepest(size.y);
    const std::vector<WorldTriangle> triangles = worldTriangles(frame.camera, surfaces);
    const double r = options.silhouetteRadius;
    parallelFor(size.y, 1, options.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t row = begin; row < end; ++row) {
            const int y = static_cast<int>(row);
            const RowTracer tracer(frame, surfaces, triangles, y);
            for (int x = 0; x < size.x; ++x) {
                const std::vector<Fragment> fragments = tracer.trace(x + 0.5, y + 0.5, x);
                truth.color.at(x, y) = glm::vec3(compose(fragments));
                deepest[row] = std::max(deepest[row], fragments.size());
                for (const glm::dvec2 offset :
                     {glm::dvec2(-r, -r), glm::dvec2(r, -r), glm::dvec2(-r, r), glm::dvec2(r, r)}) {
                    const auto around = tracer.trace(x + 0.5 + offset.x, y + 0.5 + offset.y, x);
                    if (!meetTheSame(fragments, around)) truth.silhouette.at(x, y) = 1;
                }
            }
        }
    });
    truth.deepest = size.y > 0 ? std::ranges::max(deepest) : 0;
    return truth;
}

Composer composerOf(const FrameDescription& frame) {
    return [background = glm::dvec3(frame.background), method = frame.method, layers = frame.layers](
               const auto& fragments) { return compose(fragments, background, method, layers); };
}

}  // namespace isoglass::test
