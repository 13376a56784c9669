#pragma once

#include "mesh/surface_mesh.h"
#include "render/camera.h"
#include "render/frame_description.h"

#include <glm/vec3.hpp>

#include <array>
#include <optional>
#include <vector>

namespace isoglass::test {

/// Where a pixel's ray meets a surface.
struct Fragment {
    double distance;  ///< along the ray
    bool backFace;
    std::size_t draw;  ///< index of the surface
    glm::dvec3 color;  ///< after shading, linear
    double opacity;
    std::size_t triangle = 0;  ///< index within the surface, the order in which it is drawn
};

/// A ray in double precision, `direction` of length 1.
struct Ray {
    glm::dvec3 origin, direction;
};

/// Where a ray meets a triangle.
struct TriangleHit {
    double distance;  ///< along the ray, above 0
    bool backFace;    ///< the ray sees the triangle's corners clockwise
    glm::dvec3 barycentric;
};

/// Plane and edge functions in double (Moeller and Trumbore 1997). Both triangles beside an edge take a
/// ray through it: the tolerance is 2^-40 of the triangle, so that none slips between them.
std::optional<TriangleHit> intersectTriangle(const Ray& ray, const std::array<glm::dvec3, 3>& corner);

/// Ray through a point of the image in pixels from its upper left corner; pixel (x,y) has its center at
/// (x + 0.5, y + 0.5).
Ray pixelRay(const CameraView& camera, double x, double y);

/// The closed forms of the methods: `threePass` B prod(1-a_i) + sum a_i c_i, `fourPass`
/// with the sum over the fragments up to the nearest back face, `exact` the fragments over each other by
/// depth, `peel` the nearest `layers` of them, `twoPass` over each other in the order of draws and
/// triangles. Fragments in any order; those behind the nearest opaque one do not count.
glm::dvec3 compose(const std::vector<Fragment>& fragments, const glm::dvec3& background,
                   TransparencyMethod method, int layers = 4);

/// Color of a surface lit from the eye, by the formula of FrameDescription::lighting.
glm::dvec3 shade(const glm::dvec3& color, const glm::dvec3& normal, const glm::dvec3& toEye,
                 const Lighting& lighting);

/// Opacity of a fragment by the draw's model. `gradient` is the field's, in the world; below 1 for every
/// shell, because it is drawn among the semi-transparent surfaces whatever its opacity.
double opacityOf(const SurfaceDraw& draw, const glm::dvec3& gradient, const glm::dvec3& view);

/// A surface that the ground truth draws: its mesh and how the frame shows it.
struct TruthSurface {
    SurfaceMesh mesh;
    SurfaceDraw draw;
};

}  // namespace isoglass::test
