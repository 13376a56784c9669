#pragma once

#include "mesh/surface_mesh.h"
#include "support/mesh_boundary.h"
#include "support/random_fields.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

// Where a mesh on a unit lattice (samples at whole numbers from 0, no periodic axis) may have a boundary.

namespace isoglass::test {

using MeshEdge = std::array<std::uint32_t, 2>;

/// True where both ends of the edge lie on one plane of the domain's end. Vertices there have the plane's
/// coordinate exactly, because the lattice edge that carries them does not leave it.
inline bool liesOnTheEnd(const SurfaceMesh& mesh, MeshEdge edge, glm::ivec3 cells) {
    const glm::vec3 a = mesh.positions[edge[0]];
    const glm::vec3 b = mesh.positions[edge[1]];
    for (int k = 0; k < 3; ++k) {
        const auto last = static_cast<float>(cells[k]);
        if ((a[k] == 0 && b[k] == 0) || (a[k] == last && b[k] == last)) return true;
    }
    return false;
}

/// True where a cell that touches the middle of the edge lacks a sample (NaN).
inline bool liesBesideMissing(const SurfaceMesh& mesh, MeshEdge edge, glm::ivec3 dims,
                              std::span<const float> samples) {
    const glm::vec3 middle = 0.5f * (mesh.positions[edge[0]] + mesh.positions[edge[1]]);
    // Vertices are rounded to float: far more than their rounding, far less than a cell.
    constexpr float kHair = 1e-4f;
    glm::ivec3 first;
    glm::ivec3 last;
    for (int k = 0; k < 3; ++k) {
        first[k] = std::max(0, static_cast<int>(std::floor(middle[k] - kHair)));
        last[k] = std::min(dims[k] - 1, static_cast<int>(std::floor(middle[k] + kHair)) + 1);
    }
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                if (std::isnan(samples[sampleAt(dims, {x, y, z})])) return true;
            }
        }
    }
    return false;
}

}  // namespace isoglass::test
