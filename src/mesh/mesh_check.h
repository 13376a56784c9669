#pragma once

#include "mesh/surface_mesh.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>

namespace isoglass {

/// What the triangles say by vertex index alone; positions are not looked at.
struct MeshTopology {
    std::size_t boundaryEdges = 0;        ///< in one triangle
    std::size_t nonManifoldEdges = 0;     ///< in more than two triangles
    std::size_t misorientedEdges = 0;     ///< walked in the same direction by both their triangles
    std::size_t degenerateTriangles = 0;  ///< name a vertex twice; left out of everything else
    /// The triangles around the vertex are not one fan, open or closed.
    std::size_t nonManifoldVertices = 0;
    std::size_t unreferencedVertices = 0;  ///< in no triangle
    std::size_t components = 0;            ///< pieces joined by shared vertices
    /// Referenced vertices - edges + triangles: 2 for each sphere, 0 for a torus, 1 for a disk.
    std::ptrdiff_t eulerNumber = 0;

    /// Every point has a neighbourhood like a disk or, at the boundary, a half disk, and the triangles
    /// agree on which side is outside.
    bool isOrientedManifold() const {
        return nonManifoldEdges == 0 && misorientedEdges == 0 && nonManifoldVertices == 0 &&
               degenerateTriangles == 0;
    }
    bool isClosed() const { return boundaryEdges == 0; }

    friend bool operator==(const MeshTopology&, const MeshTopology&) = default;
};

/// Checks a mesh whose indices are below its vertex count; O(n log n) for n triangles, about 100 bytes of
/// memory a triangle, single-threaded.
MeshTopology checkTopology(const SurfaceMesh& mesh);

/// What the positions say.
struct MeshMeasures {
    double area = 0;
    /// Volume enclosed, positive where the winding is counter-clockwise seen from outside. Means
    /// something for closed meshes only.
    double volume = 0;
    /// Smallest and largest corner relative to `origin`; 0 for a mesh without finite vertices.
    std::array<glm::dvec3, 2> bounds{glm::dvec3(0), glm::dvec3(0)};
    std::size_t nonFiniteVertices = 0;
    std::size_t zeroAreaTriangles = 0;

    friend bool operator==(const MeshMeasures&, const MeshMeasures&) = default;
};

/// Measures in double precision, relative to `mesh.origin`; triangles with non-finite vertices are left
/// out of area and volume.
MeshMeasures measure(const SurfaceMesh& mesh);

}  // namespace isoglass
