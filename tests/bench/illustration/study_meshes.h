#pragma once

#include "mesh/surface_mesh.h"

namespace isoglass {

/// A surface everywhere: the gyroid over 6 periods, of about a million vertices.
SurfaceMesh makeGyroid();

/// A gearbox, which is no iso-surface, of about 17 thousand vertices without its shaft: a casing with thick
/// walls and a round opening, and a train of six gears in it; and the shaft of one of them.
SurfaceMesh makeGearbox();
SurfaceMesh makeShaft();

}  // namespace isoglass
