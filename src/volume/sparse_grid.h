#pragma once

#include "volume/brick_fates.h"
#include "volume/key_frame.h"

#include <glm/vec3.hpp>
#include <openvdb/openvdb.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

// Between OpenVDB trees and key frames. Private to the room: it includes OpenVDB.

namespace isoglass {

/// Builds the tree of one key frame from dense samples (x fastest): what is missing (NaN, infinity, of
/// magnitude above kLargestValue) stays inactive, a brick that lies wholly in the domain, has no missing
/// sample and spans at most 2 * `tolerance` becomes an active tile; `fates` (one a brick, x fastest; may be
/// empty) overrules that.
openvdb::FloatGrid::Ptr makeSparseGrid(glm::ivec3 dims, std::span<const float> samples, double tolerance,
                                       std::span<const BrickFate> fates = {});

/// Builds the tree of a key frame, without its heights: what is missing is inactive. Read back it has the
/// same samples in the same bricks.
openvdb::FloatGrid::Ptr makeSparseGrid(const KeyFrame& frame);

/// Copies the samples of `grid` into a key frame, with `heights`. Index (0,0,0) of the tree is sample
/// (0,0,0).
std::shared_ptr<const KeyFrame> makeKeyFrame(const openvdb::FloatGrid& grid, glm::ivec3 dims,
                                             glm::bvec3 periodic, bool inactiveIsMissing,
                                             std::shared_ptr<const KeyFrame> heights = nullptr);

}  // namespace isoglass
