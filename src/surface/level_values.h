#pragma once

#include "mesh/surface_mesh.h"
#include "surface/extract.h"
#include "volume/lattice.h"

#include <vector>

namespace isoglass {

/// The level of detail at each vertex of a mesh that was extracted with the same arguments: that of the cells
/// and the weight with which the next level is blended in, so that 1.25 is a quarter of the way from level 1
/// to level 2. 0 where the mesh has full resolution. Continuous as the sizes of cells are, but for the choice
/// of the nearest sample; to look at a mesh, not to compute with it. Pure.
std::vector<float> levelAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                   const ExtractOptions& options);

}  // namespace isoglass
