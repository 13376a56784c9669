#pragma once

#include "mesh/surface_mesh.h"

namespace isoglass {

/// Gives a mesh normals from its triangles: at each vertex the sum of the area vectors of those around its
/// position, whether they share the vertex or not.
///
/// Triangles whose planes differ by more than `creaseDegrees` from a corner's own do not count there; where
/// that makes normals differ the vertex is split, behind the others, so that edges stay sharp. Values at
/// vertices are copied with them. Corners of triangles without area take what is around them;
/// so do those of a vertex with more than 1000 triangles, which is not split.
void addNormals(SurfaceMesh& mesh, double creaseDegrees = 45);

}  // namespace isoglass
