#pragma once

#include "mesh/surface_mesh.h"
#include "surface/extract.h"
#include "volume/lattice.h"

#include <vector>

namespace isoglass {

/// The field at each vertex of a mesh that lives in the same coordinates: linear in each axis' index between
/// samples and between the key frames, so exact at the crossings of a lattice of its own. NaN outside the
/// lattice and where a sample that counts is missing. Throws
/// Error for a lattice with heights. Pure; the values do not depend on `threads`.
std::vector<float> sampleAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                    int threads = 0);

/// The same of the change from the first key frame to the second, of which both must be there.
std::vector<float> changeAtVertices(const SurfaceMesh& mesh, const Lattice& lattice, const TimedField& field,
                                    int threads = 0);

/// Mean curvature of the surface at each vertex, 1 / length: half the divergence of the unit normal, positive
/// where the surface bends away from the normal (1 / r on a sphere). The normal is taken as linear on every
/// triangle; a vertex gets the mean over its triangles, weighted by area. 0 where no triangle has an area.
std::vector<float> meanCurvature(const SurfaceMesh& mesh);

}  // namespace isoglass
