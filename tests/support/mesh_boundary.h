#pragma once

#include "mesh/surface_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace isoglass::test {

/// The edges that lie in one triangle, as vertex indices.
inline std::vector<std::array<std::uint32_t, 2>> boundaryEdges(const SurfaceMesh& mesh) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax(mesh.triangles[t + i], mesh.triangles[t + (i + 1) % 3]);
            edges.push_back({low, high});
        }
    }
    std::ranges::sort(edges);
    std::vector<std::array<std::uint32_t, 2>> single;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        if (end == begin + 1) single.push_back(edges[begin]);
    }
    return single;
}

}  // namespace isoglass::test
