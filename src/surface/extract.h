#pragma once

#include "mesh/surface_mesh.h"
#include "surface/clip.h"
#include "surface/view.h"
#include "volume/key_frame.h"
#include "volume/lattice.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace isoglass {

/// The field at one time: linear between two key frames, f = a + fraction * (b - a).
struct TimedField {
    std::shared_ptr<const KeyFrame> a;
    std::shared_ptr<const KeyFrame> b;  ///< may be null where `fraction` is 0
    float fraction = 0;                 ///< in [0,1]; 0 takes `a` alone and 1 `b` alone, bit by bit
};

struct ExtractOptions {
    /// The surface separates f >= iso (inside) from the rest; compared as float, like the samples.
    float iso = 0;
    bool insideIsBelow = false;  ///< inside is f <= iso instead
    /// From where the mesh will be seen, and what of it; full resolution where not given, where it asks for
    /// none less, and where the lattice has heights. What is seen of the mesh does not depend on the bricks
    /// that are left out (`View::planes`); vertices beside them may stay without a triangle.
    std::optional<View> view = {};
    /// With a view: the mesh is one alone and not one of many in time, so that cells need not become finer
    /// where the iso-value passes a sample (see CellOptions::gate): about a seventh fewer triangles.
    bool still = false;
    int threads = 0;  ///< 0 takes all cores; the mesh does not depend on it
    /// What lies behind any of these is cut off. Bricks wholly behind one are not looked at. A mesh that is
    /// clipped or `closed` has full resolution, whatever the view wants. Error where the lattice has heights.
    std::vector<CutPlane> clip = {};
    /// Caps what is inside where the domain ends, along axes that are not periodic.
    bool closed = false;
};

struct ExtractStats {
    std::size_t bricks = 0;         ///< all bricks of the domain
    std::size_t touchedBricks = 0;  ///< those whose time-interpolated range holds the iso-value
    /// Cells that the surface would cross by their valid samples but for a missing one: holes in the mesh.
    std::size_t lostCells = 0;
    /// Hull of the bricks' time-interpolated ranges: the surface is empty when it does not hold the
    /// iso-value. Empty range (min > max) where no sample is valid.
    ValueRange range{};
    bool leftOut = false;  ///< bricks that the surface may touch were left out because they are not seen
};

struct Extraction {
    SurfaceMesh mesh;
    ExtractStats stats;
    /// What is inside on the cuts of `clip` and, for `closed`, at the domain's end: flat triangles with
    /// normals away from what is kept. Vertices are its own, because the surface's normals are others.
    SurfaceMesh caps{};
    /// For each vertex of `caps`: the vertex of `mesh` at the same place, bit by bit, or for points that are
    /// not on the surface a number from `mesh.vertexCount()` on. Equal numbers are the same point.
    std::vector<std::uint32_t> capIdentity{};
};

/// Surface and caps as one mesh, joined by identity: closed where `clip` caps all its planes, the domain's
/// end is `closed` and no sample is missing.
SurfaceMesh joinCaps(const Extraction& extraction);

/// Whether the mesh for these options may have cells larger than those of the lattice.
bool hasDetail(const Lattice& lattice, const ExtractOptions& options);

/// Extracts one iso-surface at full resolution by compact Kuhn cells: the six
/// tetrahedra of a cell decide the topology, the vertices lie on axis edges.
///
/// A vertex stands for one lattice edge, so the mesh is an oriented 2-manifold by vertex index whatever
/// the samples are; its boundary lies where the domain ends or samples are missing or a plane clips. Where of
/// the four cells around an edge only two opposite ones have all samples, the edge has a vertex for each of
/// them. Positions are world coordinates by the axis tables of `lattice`, or by the heights that the key
/// frames bring where it has them, linear in time like the field; normals come from central differences in
/// world space (one-sided beside the domain's end and missing samples). Zero-area triangles, where samples
/// equal the iso-value, stay. Cost follows the bricks that the surface touches.
///
/// Pure: any number of calls may run at once. The same arguments give the same bytes for any `threads`.
/// Both key frames must be of `lattice`, and have heights where it has them.
Extraction extractSurface(const Lattice& lattice, const TimedField& field, const ExtractOptions& options);

}  // namespace isoglass
