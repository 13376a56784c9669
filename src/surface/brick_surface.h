#pragma once

#include "surface/brick_field.h"
#include "surface/index_space.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isoglass {

/// Kinds of lattice edges that carry vertices: along x, y, z, and the body diagonal of a cell.
inline constexpr int kEdgeKinds = 4;

/// What the surface does in one brick, small enough to keep for all touched bricks between the passes.
///
/// A brick owns the edges whose lower end is one of its own samples, and the vertices on them; they are
/// numbered by row (x, y), then kind, then z.
struct BrickRecord {
    glm::ivec3 brick;
    std::uint32_t firstVertex = 0;    ///< in the mesh; set by the scan
    std::uint32_t firstTriangle = 0;  ///< in the mesh; set by the scan
    std::uint16_t vertexCount = 0;
    std::uint16_t triangleCount = 0;
    std::uint32_t lostCells = 0;
    /// Row x*9 + y, bit z: sample is inside, for 0 <= x, y, z <= 8.
    std::array<std::uint16_t, 81> inside;
    /// Row x*8 + y, bit z: the surface crosses the cell.
    std::array<std::uint8_t, 64> cells;
    /// Row x*8 + y, kind, bit z: the edge carries a vertex.
    std::array<std::array<std::uint8_t, kEdgeKinds>, 64> edges;
    /// Vertices of the brick before row x*8 + y.
    std::array<std::uint16_t, 64> rowStart;
};

/// Vertices as they are made, before they get their place in the mesh.
struct VertexBuffer {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

/// Finds the crossed cells and edges of a gathered brick and counts vertices and triangles.
void classifyBrick(const IndexSpace& space, glm::ivec3 brick, const BrickField& field, float iso,
                   BrickRecord& record);

/// Appends the brick's vertices in their order. `heights` are the gathered world z of the samples, null where
/// the axis table of `space` says it.
void makeVertices(const IndexSpace& space, const BrickRecord& record, const BrickField& field,
                  const BrickField* heights, float iso, VertexBuffer& out);

/// Mesh indices of the vertices on the edges of one brick's cells.
class EdgeVertices {
  public:
    /// `neighbours` as for `writeTriangles`; a null `neighbours[0]` is a brick without vertices of its own.
    explicit EdgeVertices(const std::array<const BrickRecord*, 8>& neighbours);

    /// Of the vertex on edge `edge` of the cell (local, 0..7), an axis edge or the body diagonal, which must
    /// carry one.
    std::uint32_t at(glm::ivec3 cell, int edge) const;

  private:
    std::array<std::uint32_t, 9 * 9 * 9 * kEdgeKinds> indices_;
};

/// Writes the brick's triangles to `out` (3 * triangleCount indices). `neighbours[k]` is the record of
/// the next brick along x (bit 0 of k), y (bit 1), z (bit 2), or null where the surface does not touch
/// it; `neighbours[0]` is the brick itself.
void writeTriangles(const std::array<const BrickRecord*, 8>& neighbours, bool mirrored,
                    std::span<std::uint32_t> out);

}  // namespace isoglass
