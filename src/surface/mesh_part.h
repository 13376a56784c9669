#pragma once

#include "mesh/surface_mesh.h"

#include <glm/vec3.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace isoglass {

/// Which vertex it is, wherever it is made: the finest lattice edge that carries the crossing, or a cut at
/// the domain's end. Equal keys always come with equal bits of position and normal.
struct VertexKey {
    std::uint64_t high = 0;
    std::uint64_t low = 0;

    friend auto operator<=>(const VertexKey&, const VertexKey&) = default;
};

/// The edge from vertex `low` of `level` in `direction` (bits x, y, z). Levels below 16, coordinates below
/// 2^19.
constexpr VertexKey edgeKey(int level, glm::ivec3 low, int direction) {
    const auto part = [](int value) { return static_cast<std::uint64_t>(value); };
    return {0,
            part(level) << 60 | part(low.x) << 41 | part(low.y) << 22 | part(low.z) << 3 | part(direction)};
}

/// Where the side between two vertices is cut by the domain's end along `axis`; the same for both orders.
VertexKey cutKey(VertexKey a, VertexKey b, int axis);

/// A part of a mesh with indices of its own.
struct MeshPart {
    /// A vertex that other bricks may make, too.
    struct Shared {
        VertexKey key;
        std::uint32_t vertex;
    };

    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> triangles;
    std::vector<Shared> shared;
    std::size_t lostCells = 0;
};

/// Joins parts by key into one mesh: vertices and triangles in the order of the parts, of equal vertices the
/// first. The same for any number of threads. Throws std::length_error beyond 2^32 vertices or triangles.
SurfaceMesh joinParts(std::vector<MeshPart>& parts, glm::dvec3 origin, int threads);

}  // namespace isoglass
