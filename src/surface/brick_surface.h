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

/// An axis edge of a brick whose vertex is there twice.
struct PinchedEdge {
    std::uint8_t x;  ///< lower end, local sample
    std::uint8_t y;
    std::uint8_t z;
    std::uint8_t kind;  ///< 0 to 2
};

/// What the surface does in one brick, small enough to keep for all touched bricks between the passes.
///
/// A brick owns the edges whose lower end is one of its own samples, and the vertices on them; they are
/// numbered by row (x, y), then kind, then z. After them come the second vertices of pinched edges: where
/// only two diagonally opposite cells around an axis edge have all their samples, each of them gets a vertex
/// of its own, so that their fans do not meet in one.
struct BrickRecord {
    glm::ivec3 brick;
    std::uint32_t firstVertex = 0;    ///< in the mesh; set by the scan
    std::uint32_t firstTriangle = 0;  ///< in the mesh; set by the scan
    std::uint16_t vertexCount = 0;    ///< with the second ones
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
    /// Pinched edges, in the order of their second vertices; empty but beside missing samples.
    std::vector<PinchedEdge> pinched;
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
    friend void writeTriangles(const std::array<const BrickRecord*, 8>& neighbours, bool mirrored,
                               std::span<std::uint32_t> out);

    /// At local samples 0 .. 8, by edge kind. The second half is for cells that take the second vertex of a
    /// pinched edge, and is filled where there is one.
    std::array<std::uint32_t, 2 * 9 * 9 * 9 * kEdgeKinds> indices_;
    const int* edgeSlots_;  ///< places of a cell's edges in `indices_`, relative to the cell
};

/// Writes the brick's triangles to `out` (3 * triangleCount indices). `neighbours[k]` is the record of
/// the next brick along x (bit 0 of k), y (bit 1), z (bit 2), or null where the surface does not touch
/// it; `neighbours[0]` is the brick itself.
void writeTriangles(const std::array<const BrickRecord*, 8>& neighbours, bool mirrored,
                    std::span<std::uint32_t> out);

}  // namespace isoglass
