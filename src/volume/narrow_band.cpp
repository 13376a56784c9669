#include "volume/narrow_band.h"

#include "volume/sparse_grid.h"

#include <openvdb/tools/LevelSetSphere.h>

namespace isoglass {

std::shared_ptr<const KeyFrame> makeNarrowBandSphere(int samples, double radiusVoxels,
                                                     double halfWidthVoxels) {
    const auto radius = static_cast<float>(radiusVoxels);
    const auto centre = static_cast<float>(0.5 * (samples - 1));
    const auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        radius, openvdb::Vec3f(centre), 1.0f, static_cast<float>(halfWidthVoxels));
    return makeKeyFrame(*grid, glm::ivec3(samples), glm::bvec3(false), /*inactiveIsMissing=*/false);
}

}  // namespace isoglass
