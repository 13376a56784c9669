#pragma once

#include "mesh/surface_mesh.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace isoglass::test {

/// Distance of a point from a triangle, also one without area (Ericson, "Real-Time Collision Detection",
/// 2005, section 5.1.5).
double distanceToTriangle(glm::dvec3 point, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// Answers how far points are from a mesh.
class MeshDistance {
  public:
    /// `cellSize` of the search grid: about the size of a triangle, not smaller. The mesh must outlive it.
    MeshDistance(const SurfaceMesh& mesh, double cellSize);

    /// Infinite where nothing lies within `reach`.
    double at(glm::dvec3 point, double reach) const;

  private:
    glm::ivec3 cellOf(glm::dvec3 point) const;

    const SurfaceMesh& mesh_;
    double cellSize_;
    glm::dvec3 low_{0};
    glm::ivec3 dims_{0};
    std::vector<std::vector<std::uint32_t>> cells_;  ///< first indices of the triangles that touch each
};

/// Largest distance of a vertex or the middle of a triangle of either mesh from the other; infinite where one
/// has a piece farther than `reach` from the other.
double surfaceDistance(const SurfaceMesh& a, const SurfaceMesh& b, double cellSize, double reach);

}  // namespace isoglass::test
