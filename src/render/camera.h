#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <optional>

namespace isoglass {

/// A perspective view of the world.
struct CameraView {
    glm::dvec3 eye{3, 2, 2.5};
    glm::dvec3 target{0};
    /// Where it is parallel to the view, y takes its place: looking straight down, north is up.
    glm::dvec3 up{0, 0, 1};
    double fovDegrees = 30;      ///< vertical, between 0 and 180
    glm::ivec2 size{1280, 720};  ///< of the image in pixels

    friend bool operator==(const CameraView&, const CameraView&) = default;
};

/// Orthonormal directions of the view in world axes.
struct ViewAxes {
    glm::dvec3 right, up, forward;
};

/// Throws Error where the view is not defined: eye and target coincide, a number is not finite, the angle
/// of view is not between 0 and 180 degrees.
ViewAxes viewAxes(const CameraView& camera);

/// The planes a x + b y + c z + d >= 0, in the world, that bound what a picture can show: its four sides,
/// each moved outwards by a pixel (a sample may lie anywhere in its pixel) and by `margin` times the
/// picture's width or height, and the one through the eye. Normals have length 1. Errors as `viewAxes`.
std::array<glm::dvec4, 5> viewPlanes(const CameraView& camera, double margin);

/// An axis-aligned box.
struct Bounds {
    glm::dvec3 low, high;

    void include(const Bounds& other);

    friend bool operator==(const Bounds&, const Bounds&) = default;
};

/// The box around an affinely mapped box.
Bounds transformed(const glm::dmat4& toFromBox, const Bounds& box);

/// Distance of the near plane along the view axis: as far as it can be without cutting what is drawn
/// inside the view, but at least 1e-9 of the farthest point's distance. 1 where nothing is drawn. It does
/// not depend on where the eye looks.
double nearDistance(const CameraView& camera, const std::optional<Bounds>& drawnWorld);

/// Reversed perspective with the far plane at infinity: depth is near/distance, whose float precision is
/// relative (N. Reed, "Depth Precision Visualized"). Input: world axes, origin at the eye.
glm::dmat4 clipFromEye(const CameraView& camera, double nearDistance);

/// What the shaders need to place a mesh; computed in double and rounded to float once, so that neither
/// the eye nor the mesh suffers from being far from the world's origin.
struct MeshMatrices {
    glm::mat4 clipFromMesh;
    glm::mat4 eyeFromMesh;     ///< world axes, origin at the eye
    glm::mat3 normalFromMesh;  ///< inverse transpose up to a positive factor, largest element 1
    float gradientScale;       ///< length of the world gradient for a transformed normal of length 1
    bool mirrored;             ///< the placement turns counter-clockwise into clockwise
};

MeshMatrices meshMatrices(const glm::dmat4& clipFromEye, const glm::dvec3& eyeWorld,
                          const glm::dmat4& worldFromSeries, const glm::dvec3& meshOrigin);

}  // namespace isoglass
