#pragma once

#include "volume/key_frame.h"

#include <filesystem>
#include <memory>

namespace isoglass {

/// Signed distance, in voxels, to a sphere in the middle of `samples`^3 samples, exact within
/// `halfWidthVoxels` of the sphere and +-halfWidthVoxels (negative inside) elsewhere; nothing is missing.
///
/// Memory follows the sphere's area, not the domain, so it holds lattices that dense samples could not.
/// The sphere and its band must lie inside the domain.
std::shared_ptr<const KeyFrame> makeNarrowBandSphere(int samples, double radiusVoxels,
                                                     double halfWidthVoxels);

/// Writes the same as a series of one key frame, at time 0, on a lattice of voxels. Throws Error.
void writeNarrowBandSphere(const std::filesystem::path& out, int samples, double radiusVoxels,
                           double halfWidthVoxels);

}  // namespace isoglass
