#pragma once

#include "mesh/surface_mesh.h"

namespace isoglass::test {

/// The mesh with vertices of equal position (bit by bit, 0 and -0 alike) made one: what a program sees
/// that knows positions only. Where samples equal the iso-value, different vertices share a position
/// and the welded mesh need not be a manifold any more.
SurfaceMesh weldByPosition(const SurfaceMesh& mesh);

}  // namespace isoglass::test
