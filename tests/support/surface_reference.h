#pragma once

#include "mesh/surface_mesh.h"
#include "volume/lattice.h"

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>

namespace isoglass {

/// A vertex' place, the lattice edge from sample (x,y,z) in `direction` (bits x, y, z). A pinched edge, of
/// whose four cells only two diagonally opposite ones have all samples, has two vertices: the `second`
/// belongs to the cell that lies before the edge along the first of the other two axes.
struct LatticeEdge {
    int x;
    int y;
    int z;
    int direction;
    bool second = false;

    friend auto operator<=>(const LatticeEdge&, const LatticeEdge&) = default;
};

/// An iso-surface by edge identity, made without bricks, masks or sharing of work: every cell by itself,
/// every vertex by its edge. Slow and plain; what it shares with the engine is the cell table alone.
struct ReferenceSurface {
    struct Vertex {
        glm::dvec3 position;  ///< world
        glm::dvec3 normal;    ///< minus the gradient; the edge's direction where that is zero
        bool byEdge = false;  ///< the gradient was zero
    };
    /// Turned so that the smallest edge comes first; counter-clockwise seen from outside.
    using Triangle = std::array<LatticeEdge, 3>;

    std::map<LatticeEdge, Vertex> vertices;
    std::set<Triangle> triangles;
    /// Cells that lack a sample while the others lie on both sides.
    std::size_t lostCells = 0;
    std::size_t pinchedEdges = 0;  ///< those with two vertices
};

/// `samples` are dense, x fastest, NaN = missing.
ReferenceSurface extractReference(const Lattice& lattice, std::span<const float> samples, float iso,
                                  bool insideIsBelow = false);

/// What differs between a mesh and the reference, or empty: vertices, triangles, positions within
/// `positionTolerance`, normals within `normalTolerance` (both world units, any component).
///
/// The mesh carries no keys; its vertices come brick by brick (x fastest), in a brick by x, y, kind of
/// edge (x, y, z, body diagonal) and z of the lower end, and after those its second vertices likewise.
std::string differenceFromReference(const SurfaceMesh& mesh, const ReferenceSurface& reference,
                                    double positionTolerance, double normalTolerance);

}  // namespace isoglass
