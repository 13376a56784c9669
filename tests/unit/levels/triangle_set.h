#pragma once

#include "mesh/surface_mesh.h"

#include <algorithm>
#include <array>
#include <vector>

namespace isoglass::test {

using Corners = std::array<std::array<float, 3>, 3>;

/// Triangles by position, each from its smallest corner on, sorted: equal for equal surfaces whatever the
/// order of vertices and triangles.
inline std::vector<Corners> trianglesOf(const SurfaceMesh& mesh) {
    std::vector<Corners> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::vec3 p = mesh.positions[mesh.triangles[t + i]];
            corners[i] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        triangles.push_back(corners);
    }
    std::ranges::sort(triangles);
    return triangles;
}

}  // namespace isoglass::test
